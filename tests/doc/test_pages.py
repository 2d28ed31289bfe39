#!/usr/bin/python3.11
# SPDX-License-Identifier: GPL-2.0-or-later
"""Sphinx builds doc/ and the reference without a warning; formulas and roles are nowhere left as they were written; every class
and attribute of the plugin, and every function that a scene gets, has its place in the reference."""
import glob
import html
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ["SOFTGRAIN_BUILD"]
NAMES = """
import inspect, sys, yade.wrapper, softgrain
from softgrain import _softgrain
for name in _softgrain.classes:
    members = [member for member in vars(getattr(yade.wrapper, name)) if not member.startswith("_")]
    print("name", *(f"{name}.{member}" for member in members), name)
print("name", *("softgrain." + name for name in softgrain.__all__ if inspect.isfunction(getattr(softgrain, name))))
"""


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def shown(page):
    """The text of a page without formulas, code and scripts."""
    text = re.sub(r"<(script|style|pre|code).*?</\1>", "", read(page), flags=re.S)
    text = re.sub(r'<(span|div) class="math.*?</\1>', "", text, flags=re.S)
    return html.unescape(re.sub(r"<[^>]+>", "", text))


def names(folder):
    scene = os.path.join(folder, "names.py")
    with open(scene, "w", encoding="utf-8") as file:
        file.write(NAMES)
    said = subprocess.run(["yade", "-n", "-x", scene], capture_output=True, text=True, check=True,
                          env=dict(os.environ, PYTHONPATH=os.path.join(BUILD, "py"))).stdout
    return [name for line in said.splitlines() if line.startswith("name ") for name in line.split()[1:]]


built = subprocess.run(["/usr/bin/python3.11", os.path.join(ROOT, "doc", "sphinx", "build.py"), BUILD], capture_output=True,
                       text=True, check=False)
if built.returncode != 0:
    sys.exit(built.stdout + built.stderr)
faults = []
pages = glob.glob(os.path.join(BUILD, "doc", "html", "**", "*.html"), recursive=True)
for made in glob.glob(os.path.join(ROOT, "doc", "*.md")):
    name = os.path.basename(made)[:-3]
    if not any(page.endswith(f"/{name}.html") for page in pages):
        faults.append(f"{name}.md has no page")
for page in pages:
    faults += [f"{os.path.basename(page)}: {line.strip()}" for line in shown(page).splitlines()
               if re.search(r"\$|:yref:|:ydefault:|\\frac|\{math", line)]
reference = "".join(read(os.path.join(BUILD, "doc", "html", "reference", name + ".html")) for name in ("classes", "functions"))
wanted = names(os.path.join(BUILD, "doc"))
faults += [f"{name} is not in the reference" for name in wanted if f'id="{name}"' not in reference]
print(*faults, sep="\n")
print(f"{len(pages) + len(wanted) - len(faults)} passed, {len(faults)} failed")
sys.exit(1 if faults or len(wanted) < 100 else 0)
