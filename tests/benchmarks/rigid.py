#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid discs by Contact Dynamics, by YADE's own law and by Siconos, as ratios of CPU time measured in one run:
python3 tests/benchmarks/rigid.py [--grains 3000]

Needs the built plugin (PYTHONPATH=build/py) and python3-siconos. The scene is that of examples/rigid_compaction.py up to
--until: with Contact Dynamics at two tolerances, with YADE's Cundall-Strack at two stiffnesses. Siconos solves the contact problems
of single steps on the way, written out as matrices, by its Gauss-Seidel to the residual that ours has reached.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PACKAGE = ROOT / "build" / "py"


def yade(script, *arguments):
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(PACKAGE), os.environ.get("PYTHONPATH", "")]))
    run = subprocess.run(["yade", "-n", "-j1", "-x", str(script), *arguments], env=environment, capture_output=True,
                         text=True, stdin=subprocess.DEVNULL)
    if run.returncode:
        sys.exit(f"{script} {' '.join(arguments)} failed:\n{run.stdout[-500:]}{run.stderr[-2000:]}")
    return run.stdout


def compaction(options, folder, name, *arguments):
    out = os.path.join(folder, name)
    yade(ROOT / "examples" / "rigid_compaction.py", "--grains", str(options.grains), "--until", str(options.until),
         "--friction", str(options.friction), "--no-figures", "--out", out, *arguments)
    with open(os.path.join(out, "summary.json")) as file:
        summary = json.load(file)
    with open(os.path.join(out, "rigid_compaction.csv")) as file:
        rows = list(csv.DictReader(file))
    return {"cpu": summary["cost"]["cpu_s"], "steps": summary["cost"]["steps"],
            "deepest": max(float(row["max_penetration_over_R"]) for row in rows),
            "solid_fraction": float(rows[-1]["solid_fraction"])}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--grains", type=int, default=3000)
    parser.add_argument("--until", type=float, default=0.78, help="solid fraction at the end")
    parser.add_argument("--friction", type=float, default=0.3)
    options = parser.parse_args()
    cases = {"Contact Dynamics, 1e-3": ["--law", "cd"], "Contact Dynamics, 1e-2": ["--law", "cd", "--tolerance", "1e-2"],
             "Cundall-Strack, 5e8 Pa": [], "Cundall-Strack, 5e7 Pa": ["--stiffness", "5e7"]}
    print(f"{options.grains} discs to solid fraction {options.until}, friction {options.friction}")
    print(f"{'':24} {'cpu s':>8} {'ratio':>7} {'steps':>8} {'deepest / R':>12}")
    first = None
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, arguments) in enumerate(cases.items()):
            result = compaction(options, folder, str(number), *arguments)
            first = first or result["cpu"]
            print(f"{name:24} {result['cpu']:8.1f} {result['cpu'] / first:7.2f} {result['steps']:8d} "
                  f"{result['deepest']:12.2g}", flush=True)
    for line in yade(HERE / "rigid_siconos.py", str(options.grains), str(options.friction)).splitlines():
        if line.startswith("RESULT "):
            print(line[len("RESULT "):])


main()
