#!/usr/bin/python3.11
# SPDX-License-Identifier: GPL-2.0-or-later
"""Every command of README.md and doc/*.md is known to this test and holds good: examples are run in their short form, one block
after the other in one folder; of studies the options, of tests, builds and packages the names have to be there.
(Python blocks: tests/scenes/test_readme.py; pages that add laws: tests/scenes/test_add_a_law.py.)"""
import glob
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BUILD = os.environ["SOFTGRAIN_BUILD"]
PAGES = [os.path.join(ROOT, "README.md")] + sorted(page for page in glob.glob(os.path.join(ROOT, "doc", "*.md"))
                                                   if not page.endswith("_law.md"))
SHORT = {"compaction.py": "--quick --grains 20 --points 40 --until 0.75", "rigid_compaction.py": "--quick --grains 20",
         "squeeze.py": "--quick", "heavy_ball.py": "--quick", "figures.py": ""}
SHORTER = ("60       60 ", "20       40 ")                                 # grains and points of sweep.table
STUDIES = {"accuracy_cost.py", "packing_scatter.py", "soft_vs_rigid.py"}     # several runs each


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def run(command, folder):
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False,
                          env=dict(os.environ, PYTHONPATH=os.path.join(BUILD, "py")))


def complaint(command, folder):
    done = run(command, folder)
    return [] if done.returncode == 0 else [done.stderr[-500:]]


def example(words, folder):
    name, *options = words
    path = os.path.join(ROOT, "examples", name)
    if name in STUDIES:
        known = run(["yade", "-n", "-x", path, "--help"], folder).stdout
        return [f"{name} has no {word}" for word in options if word.startswith("--") and word not in known]
    command = ["/usr/bin/python3.11", path] if name == "figures.py" else ["yade", "-n", "-x", path]
    return complaint([*command, *options, *SHORT[name].split()], folder)


def sweep(words, folder):
    """yade-batch with a table of smaller packings."""
    *options, table, scene = words
    examples = os.path.join(ROOT, "examples")
    text = read(os.path.join(examples, table))
    with open(os.path.join(folder, table), "w", encoding="utf-8") as file:
        file.write(text.replace(*SHORTER))
    done = run(["yade-batch", "--log=%.log", *options, table, os.path.join(examples, scene)], folder)
    reader = re.search(r"^```python\n(import glob.*?)^```", read(os.path.join(ROOT, "doc", "data.md")), re.S | re.M)[1]
    told = run(["/usr/bin/python3.11", "-c", reader], folder)
    lines = len(re.findall(r"^\w+-\d ", text, re.M))
    return [] if len(told.stdout.splitlines()) == lines else [done.stderr[-500:] + told.stdout + told.stderr[-500:]]


def python(words, folder):
    return complaint(["/usr/bin/python3.11", *words], folder)


def run_by_ctest():
    """The text of all commands of ctest."""
    return json.dumps([test.get("command") for test in json.loads(run(["ctest", "--show-only=json-v1"], BUILD).stdout)["tests"]])


def test_script(words, _):
    path = os.path.join(ROOT, words[0])
    if not os.path.exists(path):
        return [f"{words[0]} is not there"]
    if words[0].endswith(".sh"):
        return [] if run(["bash", "-n", path], ROOT).returncode == 0 else [f"{words[0]} is no script"]
    aside = "benchmarks" in path or "reference" in path or words[0].endswith(("report.py", "_picture.py"))
    return [] if aside or path in run_by_ctest() else [f"{words[0]} is no test of ctest"]


def all_tests(words, _):
    wanted = words[words.index("-R") + 1] if "-R" in words else "."
    count = run(["ctest", "-N", "-R", wanted], BUILD).stdout.count("Test #")
    return [] if count else [f"no test matches {wanted}"]


def google_test(words, _):
    program = os.path.join(BUILD, os.path.relpath(words[0], "build"))
    if not os.path.exists(program):
        return [f"{words[0]} is not built"]
    patterns = words[1].partition("=")[2].split(":") if len(words) > 1 else ["*"]
    return [f"{words[0]} has no {pattern}" for pattern in patterns
            if "  " not in run([program, "--gtest_list_tests", f"--gtest_filter={pattern}"], BUILD).stdout]


def build(words, _):
    text = "".join(read(path) for path in glob.glob(ROOT + "/**/CMakeLists.txt", recursive=True))
    names = [word[2:].partition("=")[0] for word in words if word.startswith("-D")]
    targets = words[words.index("--target") + 1:] if "--target" in words else words[3:] if words[0] == "ninja" else []
    return [f"no CMakeLists.txt has {name}" for name in names + targets if not re.search(rf"\b{name}\b", text)
            and not name.startswith("core_")]


RULES = [   # what a command is like, what looks at the words in the group
    (r"(?:bash examples/run\.sh |yade -n -x examples/)(.*)", example), (r"bash tests/run\.sh(.*)", all_tests),
    (r"yade-batch (.*)", sweep), (r"python3 (-c .*)", python),
    (r"(?:yade -n -x|python3|bash) (tests/.*)", test_script), (r"(?:pvpython|xvfb-run .* yade -x --) (doc/.*)", test_script), (r"(build/tests/.*)", google_test),
    (r"((?:cmake|ninja) .*)", build)]
TRUSTED = ("apt-get install ", "export PYTHONPATH=", "(cd build", "cpack)", "cd examples")     # tests/install/test_install.py packs


def commands(page):
    """The commands of a page, with its variables put in."""
    variables = {"PWD": ROOT}
    for block in re.findall(r"^```sh\n(.*?)^```", page, re.S | re.M):
        for line in block.splitlines():
            line = re.sub(r"\$(\w+)", lambda name: variables[name[1]], re.sub(r"(^|\s+)# .*$|\s{2,}#.*$", "", line).strip())
            given = re.fullmatch(r'(\w+)=(?:"([^"]*)"|(\S+))', line)
            if given:
                variables[given[1]] = given[2] or given[3]
            elif line:
                yield from re.split(r" && ", re.sub(r"^PYTHONPATH=\S+ ", "", line))


def faults(command, page, folder):
    if command.startswith(TRUSTED):
        return []
    scene = re.fullmatch(r"yade -n -x (\w+\.py)", command)
    if scene:
        return [] if f"\n`{scene[1]}`\n\n```python" in page else [f"the page has no {scene[1]}"]
    for like, look in RULES:
        match = re.fullmatch(like, command.split(" > ")[0])
        if match:
            return look(shlex.split(match[1]), folder)
    return ["no rule of this test knows it"]


count, failed = 0, []
for path_ in PAGES:
    with tempfile.TemporaryDirectory(prefix="softgrain-doc-") as folder_:
        os.mkdir(os.path.join(folder_, "doc"))
        text_ = read(path_)
        for command_ in commands(text_):
            count += 1
            failed += [f"{os.path.basename(path_)}: {command_}: {fault}" for fault in faults(command_, text_, folder_)]
print(*failed, sep="\n")
print(f"{count - len(failed)} passed, {len(failed)} failed")
sys.exit(1 if failed or count < 40 else 0)
