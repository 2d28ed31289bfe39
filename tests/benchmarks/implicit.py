#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Implicit and quasi-static compactions against explicit ones: python3 tests/benchmarks/implicit.py [--seeds 5]

Needs the built plugin (PYTHONPATH=build/py). Packings of examples/compaction.py, CPU times as ratios measured in one run:
stress at solid fraction 0.95 over several seeds at 1 m/s; the whole compaction at 0.01 m/s and without inertia, against
explicit steps at ten times that speed, times ten; nearly incompressible grains; memory.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "build" / "py"


class Run:
    """One compaction: `cpu` [s], `peak` memory [MB], rows of its csv as `table`."""

    def __init__(self, folder, *arguments):
        out = tempfile.mkdtemp(dir=folder)
        environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(PACKAGE), os.environ.get("PYTHONPATH", "")]))
        command = ["yade", "-n", "-j1", "-x", str(ROOT / "examples" / "compaction.py"), "--no-figures", "--out", out,
                   *map(str, arguments)]
        with open(os.path.join(out, "log"), "w+") as log:
            process = subprocess.Popen(command, env=environment, stdout=log, stderr=log, stdin=subprocess.DEVNULL)
            _, status, usage = os.wait4(process.pid, 0)
            if status:
                log.seek(0)
                sys.exit(f"{' '.join(command)} failed:\n{log.read()[-2000:]}")
        with open(os.path.join(out, "summary.json")) as file:
            self.cpu = json.load(file)["cost"]["cpu_s"]
        self.peak = usage.ru_maxrss / 1024
        with open(os.path.join(out, "compaction.csv")) as file:
            self.table = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]

    def stress(self, fraction):
        """Mean of both walls at a solid fraction, on the line between two rows [Pa]."""
        for one, other in zip(self.table, self.table[1:]):
            if one["solid_fraction"] <= fraction < other["solid_fraction"]:
                share = (fraction - one["solid_fraction"]) / (other["solid_fraction"] - one["solid_fraction"])
                mean = [(row["stress_bottom_Pa"] + row["stress_top_Pa"]) / 2 for row in (one, other)]
                return mean[0] + share * (mean[1] - mean[0])
        return math.nan


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--grains", type=int, default=300)
    parser.add_argument("--points", type=int, default=124)
    parser.add_argument("--at-once", type=int, default=2, help="runs side by side")
    options = parser.parse_args()
    size = ["--grains", options.grains, "--points", options.points]
    small = ["--grains", 20, "--points", 60, "--until", 0.95, "--quasistatic"]
    seeds = range(1, options.seeds + 1)
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(options.at_once) as pool:
        def start(*arguments):
            return pool.submit(Run, folder, *arguments)

        slow = {"explicit": start(*size, "--speed", 0.1), "0.01 m/s": start(*size, "--speed", 0.01, "--integrator", "implicit"),
                "quasi-static": start(*size, "--quasistatic")}
        fast = {name: [start(*size, "--seed", seed, *words) for seed in seeds]
                for name, words in (("explicit", []), ("implicit", ["--integrator", "implicit"]))}
        stiff = {ratio: [start(*small, "--seed", seed, "--lambda", ratio * 1.26e6) for seed in seeds] for ratio in (48, 1e4)}

        stresses = {name: [run.result().stress(0.95) for run in runs] for name, runs in fast.items()}
        costs = {name: statistics.mean(run.result().cpu for run in runs) for name, runs in fast.items()}
        bias = [b / a - 1 for a, b in zip(stresses["explicit"], stresses["implicit"])]
        print(f"1 m/s, steps of 0.2 % strain, {options.seeds} seeds: stress at 0.95 explicit "
              f"{statistics.mean(stresses['explicit']) / 1e3:.0f} kPa, implicit "
              f"{statistics.mean(stresses['implicit']) / statistics.mean(stresses['explicit']) - 1:+.1%} "
              f"(single seeds {min(bias):+.1%} to {max(bias):+.1%}); CPU {costs['implicit'] / costs['explicit']:.1f} times "
              f"{costs['explicit']:.1f} s")
        explicit = 10 * slow["explicit"].result().cpu
        print(f"0.01 m/s, whole compaction: explicit {explicit:.0f} CPU s (ten times that at 0.1 m/s)")
        for name in ("0.01 m/s", "quasi-static"):
            run = slow[name].result()
            print(f"  {name}: {run.cpu:.0f} CPU s, {explicit / run.cpu:.1f} times less; peak {run.peak:.0f} MB; "
                  f"penetration {max(row['max_penetration_over_R'] for row in run.table):.1e} R, contact residual "
                  f"{max(row['solver_residual'] for row in run.table):.1e}")
        costs = {ratio: statistics.mean(run.result().cpu for run in runs) for ratio, runs in stiff.items()}
        print(f"lambda / mu = 1e4, 20 grains, quasi-static: {costs[1e4] / costs[48]:.1f} times the {costs[48]:.2f} CPU s of 48")


main()
