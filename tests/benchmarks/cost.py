#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""What a compaction costs, as ratios measured in one run: python3 tests/benchmarks/cost.py [--grains 100] [--large 1000]

Needs the built plugin (bash examples/run.sh builds it; PYTHONPATH=build/py). Prints a table with nanoseconds per
material point and step of the bulk (forces and motion), nanoseconds per local contact problem, the share of each stage
and of YADE, and the ratio of the wall-clock times with one thread and two; then the growth of the cost with the number
of grains, per unit of wall travel in grain diameters. Repeats every case and quotes medians: machines are noisy.
"""
import argparse
import json
import os
import pathlib
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
PACKAGE = HERE.parents[1] / "build" / "py"


def measure(grains, points, threads, start, stop, repeats, seed=1):
    """Median over the repeats of every counter of scene.py."""
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join([str(PACKAGE), os.environ.get("PYTHONPATH", "")]))
    command = ["yade", "-n", f"-j{threads}", "-x", str(HERE / "scene.py"), *map(str, (grains, points, start, stop, seed))]
    results = []
    for _ in range(repeats):
        output = subprocess.run(command, env=environment, capture_output=True, text=True, stdin=subprocess.DEVNULL)
        lines = [line for line in output.stdout.splitlines() if line.startswith("RESULT ")]
        if not lines:
            sys.exit(f"{' '.join(command)} gave no result:\n{output.stdout[-500:]}{output.stderr[-2000:]}")
        results.append(json.loads(lines[0][len("RESULT "):]))
    return {key: statistics.median(result[key] for result in results) for key in results[0]}


def row(points, options):
    one, two = (measure(options.grains, points, threads, options.start, options.stop, options.repeats) for threads in (1, 2))
    point_steps = one["steps"] * one["points"] * options.grains
    stages = [one[f"stage{i}"] for i in range(4)]
    shares = [stage / one["wall"] for stage in stages] + [1 - sum(stages) / one["wall"]]
    print(f"{one['points']:6.0f} {1e9 * (stages[0] + stages[3]) / point_steps:12.2f} "
          f"{1e9 * stages[2] / one['contact_iterations']:16.1f}   "
          + " ".join(f"{share:7.1%}" for share in shares)
          + f" {one['wall'] / two['wall']:9.2f} {one['cpu']:8.2f} {one['peak_MB']:8.0f}", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--grains", type=int, default=100, help="grains in the table")
    parser.add_argument("--large", type=int, default=1000, help="grains to compare a tenth of them with; 0: leave out")
    parser.add_argument("--points", type=int, nargs="+", default=[60, 124, 276, 556], help="material points a grain")
    parser.add_argument("--start", type=float, default=0.80, help="solid fraction at which the clock starts")
    parser.add_argument("--stop", type=float, default=0.95, help="solid fraction at which it stops")
    parser.add_argument("--repeats", type=int, default=3)
    options = parser.parse_args()

    print(f"{options.grains} grains, solid fraction {options.start} to {options.stop}, median of {options.repeats}")
    print("points  ns/point-step  ns/contact-iter   forces  gather  solver  motion    yade  2 threads    cpu s  peak MB")
    for points in options.points:
        row(points, options)
    if options.large:
        few, many = (measure(count, 124, 1, options.start, options.start + 0.02, options.repeats)
                     for count in (options.large // 10, options.large))
        per_travel = [case["cpu"] / (case["travel"] / case["mean_diameter"]) for case in (few, many)]
        print(f"{options.large} grains cost {per_travel[1] / per_travel[0]:.1f} times {options.large // 10}, "
              f"per wall travel in grain diameters (124 points)")


if __name__ == "__main__":
    main()
