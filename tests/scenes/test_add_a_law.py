#!/usr/bin/python3.11
# SPDX-License-Identifier: GPL-2.0-or-later
"""A page of doc/ that adds a law, followed to the letter in a copy of the sources: its files are written and its commands run.
Of the build, only what the page changes is compiled, by the commands of the build tree in SOFTGRAIN_BUILD, and linked with the
rest of it.

    test_add_a_law.py doc/PAGE.md
"""
import filecmp
import os
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ["SOFTGRAIN_BUILD"]


def blocks(page):
    """Code blocks of a page: (language, text, the file that the line above names or None)."""
    found = re.findall(r"(?:^`([\w/.]+)`\n\n)?^```(\w+)\n(.*?)^```$", page, re.M | re.S)
    return [(language, text, name or None) for name, language, text in found]


def run(command, folder):
    done = subprocess.run(command, shell=True, cwd=folder, capture_output=True, text=True,
                          env=dict(os.environ, PYTHONDONTWRITEBYTECODE="1"))
    if done.returncode != 0:
        sys.exit(f"failed: {command}\n{done.stdout}{done.stderr}")
    return done.stdout


def changed(copy):
    """Sources that are new or others in the copy."""
    found = [os.path.join(where, name) for where, _, names in os.walk(os.path.join(copy, "pkg")) for name in names]
    paths = sorted(os.path.relpath(path, copy) for path in found if path.endswith(".cpp"))
    return [path for path in paths if not os.path.exists(os.path.join(ROOT, path))
            or not filecmp.cmp(os.path.join(ROOT, path), os.path.join(copy, path), shallow=False)]


def build(copy):
    """What a build of the copy would make anew: the objects of changed sources and the plugin."""
    commands = run("ninja -t commands _softgrain", BUILD).splitlines()

    def command_of(output):
        return next(line for line in commands if f" -o {output} " in line)

    objects = []
    for source in changed(copy):
        target = "softgrain_core" if source.startswith("pkg/core") else "_softgrain"
        like = source if os.path.exists(os.path.join(ROOT, source)) else "pkg/yade/NeoHookeanMat.cpp"
        made = os.path.join(copy, os.path.basename(source) + ".o")
        command = command_of(f"CMakeFiles/{target}.dir/{like}.o")
        command = command.replace(f"CMakeFiles/{target}.dir/{like}.o", made).replace(like, source)
        run(command.replace(ROOT + "/pkg", copy + "/pkg").replace(" -O3 ", " -O1 -w "), BUILD)  # for time
        objects.append(made)
    package = os.path.join(copy, "build", "py", "softgrain")
    shutil.copytree(os.path.join(BUILD, "py", "softgrain"), package, ignore=shutil.ignore_patterns("__pycache__", "*.so"))
    link = command_of("py/softgrain/_softgrain.so")
    run(link.replace(" -o py/softgrain/_softgrain.so ", f" -o {package}/_softgrain.so {' '.join(objects)} "), BUILD)


def follow(page, copy):
    """Returns what the last command said."""
    said = ""
    for language, text, name in blocks(page):
        if name:
            with open(os.path.join(copy, name), "x", encoding="utf-8") as file:
                file.write(text)
        elif text.startswith("cmake "):
            build(copy)
        elif language == "sh":
            said = run(text, copy)
    return said


with open(os.path.join(ROOT, sys.argv[1]), encoding="utf-8") as file:
    PAGE = file.read()
with tempfile.TemporaryDirectory(prefix="softgrain-law-") as folder:
    shutil.copytree(os.path.join(ROOT, "pkg"), os.path.join(folder, "pkg"))
    SAID = follow(PAGE, folder)
    print(SAID)
    met = os.environ.get("SOFTGRAIN_MESSAGES")      # see scene_testing.py
    if met:
        os.makedirs(met, exist_ok=True)
        with open(os.path.join(met, os.path.basename(sys.argv[1]) + ".txt"), "w", encoding="utf-8") as file:
            file.write(SAID)
    if "closed form" not in SAID:
        sys.exit("the page no longer ends with its check")
