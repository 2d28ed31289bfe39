#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid discs by Contact Dynamics, by YADE's own law and by Siconos, as ratios of CPU time measured in one run:
python3 tests/benchmarks/rigid_discs.py [--discs 3000] [--out rigid_discs]

Needs the built plugin (bash examples/run.sh builds it; PYTHONPATH=build/py), python3-siconos and python3-scipy. A loose cloud of discs
settles under gravity in a box without a lid, friction 0.3, no rebound: by Contact Dynamics (softEngines(functors=rigidContacts())), by
Cundall-Strack contacts of two stiffnesses, and by Siconos alone, its bodies, its contact detection, its time-stepping and its
Gauss-Seidel, with the time step and the tolerance of the first. CPU time is that of the steps. Then the contact problems of single
steps of the first are solved from no impulses, by us (CPU time of the whole step) and by Siconos' Gauss-Seidel to the same residual
(of its sweeps alone). Prints tables, and writes settling.csv and problems.csv into --out.
"""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
SCENES = HERE / "rigid_discs"
PACKAGE = HERE.parents[1] / "build" / "py"
STEP, TOLERANCE = "2e-4", "1e-3"            # of Contact Dynamics [s], [-]
STIFFNESSES, SHARE = ("1e7", "1e8"), "0.3"  # of Cundall-Strack [Pa]; its step [sqrt(mass of the smallest disc / stiffness)]
MOMENTS = (0.3, 0.5, 0.7, 0.9)              # of single steps [end of the scene]


def run(command):
    """The results that a scene prints."""
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1",
                       PYTHONPATH=os.pathsep.join([str(PACKAGE), os.environ.get("PYTHONPATH", "")]))
    done = subprocess.run([str(word) for word in command], env=environment, capture_output=True, text=True,
                          stdin=subprocess.DEVNULL)
    results = [json.loads(line[len("RESULT "):]) for line in done.stdout.splitlines() if line.startswith("RESULT ")]
    if done.returncode or not results and "cloud" not in command:
        sys.exit(f"{' '.join(map(str, command))} gave no result:\n{done.stdout[-500:]}{done.stderr[-2000:]}")
    return results


def yade(*arguments):
    return run(["yade", "-n", "-j1", "-x", SCENES / "scene.py", *arguments])


def settle(cloud, until):
    """Yields the name of each case and its result."""
    yield "Contact Dynamics", yade("cd", cloud, until, STEP, TOLERANCE)[0]
    for stiffness in STIFFNESSES:
        yield f"Cundall-Strack, {float(stiffness) / 1e6:g} MPa", yade("cs", cloud, until, stiffness, SHARE)[0]
    yield "Siconos", run(["/usr/bin/python3", SCENES / "siconos_scene.py", cloud, until, STEP, TOLERANCE])[0]


def write(path, rows):
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)))
        table.writeheader()
        table.writerows(rows)


def table_of_scenes(cases, path):
    print("| | CPU time | steps | sweeps a step | residual at the end | deepest overlap / R | at the end | solid fraction "
          "| mean speed m/s |\n|---|---|---|---|---|---|---|---|---|")
    rows = []
    for name, result in cases:
        rows.append({"case": name, "ratio": result["cpu_s"] / (rows[0]["cpu_s"] if rows else result["cpu_s"]), **result})
        solver = f"{result['sweeps']:.0f} | {result['residual']:.0e}" if "sweeps" in result else "- | -"
        print(f"| {name} | {rows[-1]['ratio']:.2f} | {result['steps']} | {solver} | {result['deepest']:.1e} | {result['last']:.1e} "
              f"| {result['solid_fraction']:.3f} | {result['speed']:.4f} |", flush=True)
        write(path, rows)
    print(f"CPU time of the first: {rows[0]['cpu_s']:.1f} s\n")


def table_of_problems(rows, path):
    print("| contacts | residual | our sweeps | Siconos' | its CPU time over ours | of a sweep and contact: ours ns | Siconos' ns |\n"
          "|---|---|---|---|---|---|---|")
    for row in rows:
        row["ratio"] = row["siconos_s"] / row["ours_s"]
        ours, its = (1e9 * row[f"{who}_s"] / (row[f"{who}_sweeps"] * row["contacts"]) for who in ("ours", "siconos"))
        print(f"| {row['contacts']} | {row['residual']:.1e} | {row['ours_sweeps']} | {row['siconos_sweeps']} | {row['ratio']:.1f} "
              f"| {ours:.0f} | {its:.0f} |")
    write(path, rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--discs", type=int, default=3000)
    parser.add_argument("--until", type=float, default=0.1, help="end [s]; 3000 discs lie still from 0.08 s on")
    parser.add_argument("--seed", type=int, default=1, help="of the cloud")
    parser.add_argument("--out", default="rigid_discs", help="folder of the csv files")
    options = parser.parse_args()
    out = pathlib.Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    cloud = out / "cloud.json"
    yade("cloud", options.discs, options.seed, cloud)
    print(f"{options.discs} discs, seed {options.seed}, {options.until} s")
    moments = [share * options.until for share in MOMENTS]
    table_of_problems(yade("problems", cloud, STEP, TOLERANCE, *moments), out / "problems.csv")
    table_of_scenes(settle(cloud, options.until), out / "settling.csv")


if __name__ == "__main__":
    main()
