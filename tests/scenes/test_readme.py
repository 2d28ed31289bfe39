# SPDX-License-Identifier: GPL-2.0-or-later
"""Every python block of README.md and doc/*.md runs as it stands in yade, and the files that they name are there."""
import glob
import os
import re
import subprocess
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, run_tests, said  # noqa: E402

ROOT = os.path.dirname(EXAMPLES)
PAGES = [page for page in [os.path.join(ROOT, "README.md"), *sorted(glob.glob(os.path.join(ROOT, "doc", "*.md")))]
         if not page.endswith("_law.md")]  # test_add_a_law.py follows these


def text_of(page):
    with open(page, encoding="utf-8") as file:
        return file.read()


def scenes_of(page):
    """The python blocks of a page; one without an import goes on with the one before."""
    scenes = []
    for block in re.findall(r"^```python\n(.*?)^```", text_of(page), re.S | re.M):
        if "from softgrain import *" in block:
            scenes.append("")
        scenes[-1] += block
    return scenes


def python_blocks_run(checks):
    blocks = [(page, block) for page in PAGES for block in scenes_of(page)]
    checks.that("README.md has a scene", any(page.endswith("README.md") for page, _ in blocks))
    for number, (page, block) in enumerate(blocks):
        with Folder() as folder:
            with open(os.path.join(folder, "scene.py"), "w", encoding="utf-8") as file:
                file.write(block)
            run = subprocess.run(["yade", "-n", "-x", "scene.py"], cwd=folder, capture_output=True, text=True, timeout=300,
                                 check=False)
            checks.that(f"block {number} of {os.path.basename(page)}", run.returncode == 0 and "rror" not in run.stderr,
                        said(run))


def named_files_are_there(checks):
    for page in PAGES:
        text, name = text_of(page), os.path.basename(page)
        for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
            if "://" not in link:
                checks.that(f"{name}: {link}", os.path.exists(os.path.join(os.path.dirname(page), link)))
        for path in re.findall(r"`((?:pkg|py|examples|tests|doc)/[\w./-]+)`", text):
            checks.that(f"{name}: {path}", os.path.exists(os.path.join(ROOT, path)))
        for script in re.findall(r"run\.sh (\w+\.py)", text):
            checks.that(f"{name}: {script}", os.path.exists(os.path.join(EXAMPLES, script)))


run_tests(python_blocks_run, named_files_are_there)
