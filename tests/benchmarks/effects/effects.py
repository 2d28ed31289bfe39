#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What each effect costs where it is absent, present but zero, and active: python3 tests/benchmarks/effects/effects.py [--write]

Needs the built plugin (bash examples/run.sh builds it; PYTHONPATH=build/py) and valgrind. Compacts the same 24 discs with each
effect (scene.py), counts the instructions of YADE's steps alone with callgrind, takes the CPU time of the same steps, and prints a
table; --write puts it into doc/effects.md, between its marks.
"""
import argparse
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
PAGE = ROOT / "doc" / "effects.md"
BEGIN, END = "<!-- python3 tests/benchmarks/effects/effects.py --write -->\n", "<!-- end of the table -->"
EFFECTS = ("friction", "restitution", "adhesion", "gravity", "viscosity", "plasticity", "damping", "rigid until touched", "law of Ogden", "updated form",
           "adaptive step", "self-contact", "free rigid body")
GUESTS = ("self-contact", "free rigid body")  # against a scene with a body of the same place, their "zero"
WITHOUT_ZERO = ("updated form", "adaptive step")


def run(prefix, cases):
    """What scene.py tells of the cases."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", PYTHONDONTWRITEBYTECODE="1",
                       PYTHONPATH=os.pathsep.join([str(ROOT / "build" / "py"), os.environ.get("PYTHONPATH", "")]))
    command = [*prefix, "/usr/bin/python3", "/usr/bin/yade", "-n", "-x", str(HERE / "scene.py"), *cases]
    output = subprocess.run(command, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
    results = [json.loads(line[len("RESULT "):]) for line in output.stdout.splitlines() if line.startswith("RESULT ")]
    if len(results) != len(cases):
        sys.exit(f"{' '.join(command)} gave {len(results)} results:\n{output.stdout[-500:]}{output.stderr[-2000:]}")
    return dict(zip(cases, results))


def instructions(cases):
    """Of the steps of each case. Counts are dumped, and begin anew, at every O.reset(), the first of them before any case."""
    with tempfile.TemporaryDirectory() as folder:
        out = os.path.join(folder, "counts")
        run(["valgrind", "--tool=callgrind", "--collect-atstart=no", "--toggle-collect=yade::Scene::moveToNextTimeStep()",
             "--dump-before=yade::Omega::reset()", f"--callgrind-out-file={out}"], cases)
        return {case: int(re.search(r"^totals: (\d+)", pathlib.Path(f"{out}.{number}").read_text(), re.M)[1])
                for number, case in enumerate(cases, 2)}


def table(counts, times, steps):
    """The rows, and what is out of bounds."""
    rows, problems = [], []
    for effect in EFFECTS:
        zero = f"{effect}, zero"
        of = zero if effect in GUESTS else "bare"
        idle = "" if effect in WITHOUT_ZERO or effect in GUESTS else f"{100 * (counts[zero] / counts['bare'] - 1):+.2f} %"
        rows.append(f"| {effect} | {idle} | {counts[effect] / counts[of]:.3f} | {times[effect] / times[of]:.2f} | "
                    f"{steps[effect] / steps[of]:.2f} |")
        if idle and effect not in ("plasticity", "law of Ogden") and abs(counts[zero] / counts["bare"] - 1) > 5e-3:
            problems.append(f"{effect}: {idle} where it is zero")
    return rows, problems


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--repeats", type=int, default=5, help="of the times, of which the median counts")
    parser.add_argument("--write", action="store_true", help="put the table into doc/effects.md")
    options = parser.parse_args()
    cases = ["bare"] + [case for effect in EFFECTS for case in (f"{effect}, zero", effect)
                        if case != f"{effect}, zero" or effect not in WITHOUT_ZERO]
    counts = instructions(cases)
    repeats = [run([], cases) for _ in range(options.repeats)]
    times = {case: statistics.median(repeat[case]["cpu"] for repeat in repeats) for case in cases}
    rows, problems = table(counts, times, {case: repeats[0][case]["steps"] for case in cases})
    text = "\n".join(["| effect | zero: instructions | active: instructions | CPU time | steps |", "|---|---|---|---|---|", *rows])
    print(f"bare: {counts['bare'] / 1e6:.1f} million instructions, {times['bare']:.3f} s\n{text}")
    if options.write:
        page = PAGE.read_text(encoding="utf-8")
        before, rest = page.split(BEGIN)
        PAGE.write_text(f"{before}{BEGIN}\n{text}\n\n{END}{rest.split(END)[1]}", encoding="utf-8")
    if problems:
        sys.exit("over 0.5 % without being asked for: " + "; ".join(problems))


if __name__ == "__main__":
    main()
