# SPDX-License-Identifier: GPL-2.0-or-later
"""A run that was interrupted or killed and resumed equals the uninterrupted one to the last digit."""
import json
import os
import random
import signal
import sys
import time

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said, start_example  # noqa: E402
from softgrain.records import read_table  # noqa: E402

# A shared machine cannot be made to interrupt at the same step twice; so every column but the CPU time has to agree
# wherever the interruption falls: to the last digit, but for YADE's own law, which sums forces in another order once a scene is
# loaded. Chaos doubles that round-off about every few hundred steps; its run is short.
TOLERANCE = {"rigid_compaction": 1e-6}
SEED = int(sys.argv[sys.argv.index("--seed") + 1]) if "--seed" in sys.argv else random.randrange(10**6)
RUNS = {"compaction": ["--grains", "25", "--points", "60", "--until", "0.85", "--seed", "3"],
        "squeeze": ["--points", "124", "--squeeze", "0.2", "--speed", "0.05"],
        "rigid_compaction": ["--grains", "40", "--speed", "0.3"], "drum": ["--quick"], "heavy_ball": ["--quick"],
        "mixed_packing": ["--grains", "20", "--rigid-fractions", "0", "0.5", "--friction", "0.2"]}


def wait_for_rows(path, rows, process, seconds=60):
    """Waits until the csv has so many lines; false when the process ends before."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        try:
            with open(path, encoding="ascii") as file:
                if file.read().count("\n") > rows:
                    return True
        except OSError:
            pass
        if process.poll() is not None:
            return False
        time.sleep(0.01)
    return False


def differences(one, other):
    """Largest difference of each column but cpu_s, over the largest value of the column."""
    found = {}
    for column in one:
        if column == "cpu_s":
            continue
        a, b = one[column], other[column]
        if len(a) != len(b) or (numpy.isnan(a) != numpy.isnan(b)).any():
            found[column] = numpy.inf
        elif numpy.isfinite(a).any():
            found[column] = float(numpy.nanmax(abs(a - b)) / max(numpy.nanmax(abs(a)), 1e-12))
    return found


def resumed_equals_uninterrupted(checks, name, signal_number, rows):
    what = f"{name}, {signal_number.name} after {rows} rows"
    with Folder() as folder:
        whole = run_example(folder, f"{name}.py", "--out", "whole", *RUNS[name])
        checks.that(f"{what}: whole run", whole.returncode == 0, said(whole))
        process = start_example(folder, f"{name}.py", "--out", "parts", "--checkpoint-seconds", "0.05", *RUNS[name])
        csv = os.path.join(folder, "parts", f"{name}.csv")
        if not checks.that(f"{what}: reached", wait_for_rows(csv, rows, process), process.poll()):
            return
        process.send_signal(signal_number)
        _, stderr = process.communicate(timeout=60)
        if signal_number != signal.SIGKILL:
            checks.that(f"{what}: says how to go on", process.returncode == 130 and "--resume" in stderr, stderr)
        checks.that(f"{what}: not finished", not os.path.exists(os.path.join(folder, "parts", "summary.json")))
        refused = run_example(folder, f"{name}.py", "--out", "parts", *RUNS[name])
        checks.that(f"{what}: not overwritten", refused.returncode == 2 and "--resume" in refused.stderr, said(refused))
        resumed = run_example(folder, f"{name}.py", "--out", "parts", "--resume")
        checks.that(f"{what}: resumed", resumed.returncode == 0, said(resumed))
        tables = [read_table(os.path.join(folder, part, f"{name}.csv")) for part in ("whole", "parts")]
        worst = differences(*tables)
        checks.that(f"{what}: equals the whole run", max(worst.values()) <= TOLERANCE.get(name, 0), worst)
        summaries = []
        for part in ("whole", "parts"):
            with open(os.path.join(folder, part, "summary.json"), encoding="utf-8") as file:
                summaries.append(json.load(file))
        checks.that(f"{what}: same parameters", summaries[0]["parameters"] == summaries[1]["parameters"])
        steps = [summary["cost"]["steps"] for summary in summaries if "cost" in summary]
        checks.that(f"{what}: same number of steps", len(set(steps)) == 1 or name == "mixed_packing", steps)


def compaction_terminated(checks):
    resumed_equals_uninterrupted(checks, "compaction", signal.SIGTERM, 30)


def compaction_killed(checks):
    resumed_equals_uninterrupted(checks, "compaction", signal.SIGKILL, 60)


def squeeze_interrupted(checks):
    resumed_equals_uninterrupted(checks, "squeeze", signal.SIGINT, 5)


def rigid_compaction_terminated(checks):
    resumed_equals_uninterrupted(checks, "rigid_compaction", signal.SIGTERM, 10)


def mixed_packing_terminated(checks):
    resumed_equals_uninterrupted(checks, "mixed_packing", signal.SIGTERM, 10)


def a_finished_run_goes_on_to_a_higher_end(checks):
    with Folder() as folder:
        options = ["--grains", "20", "--points", "60"]
        first = run_example(folder, "compaction.py", "--until", "0.7", *options)
        more = run_example(folder, "compaction.py", "--resume", "--until", "0.75")
        whole = run_example(folder, "compaction.py", "--out", "whole", "--until", "0.75", *options)
        checks.that("three runs", not any(run.returncode for run in (first, more, whole)), said(more))
        tables = [read_table(os.path.join(folder, part, "compaction.csv")) for part in ("compaction", "whole")]
        worst = differences(*tables)
        checks.that("continued equals whole", max(worst.values()) == 0, worst)


def drum_killed(checks):
    resumed_equals_uninterrupted(checks, "drum", signal.SIGKILL, random.Random(SEED).randint(5, 190))


def heavy_ball_interrupted(checks):
    resumed_equals_uninterrupted(checks, "heavy_ball", signal.SIGINT, random.Random(SEED + 1).randint(5, 150))


def a_signal_asks_for_a_checkpoint(checks):
    """SIGUSR1; the run was begun with two threads and goes on with one."""
    with Folder() as folder:
        options = ["--grains", "40", "--points", "60", "--until", "0.9", "--no-figures"]
        whole = run_example(folder, "compaction.py", "--out", "whole", *options)
        checks.that("whole run", whole.returncode == 0, said(whole))
        process = start_example(folder, "compaction.py", "--out", "parts", "--checkpoint-seconds", "1000", "--threads", "2", *options)
        csv, checkpoint = (os.path.join(folder, "parts", name) for name in ("compaction.csv", "checkpoint.json"))
        checks.that("reached", wait_for_rows(csv, 20, process), process.poll())
        process.send_signal(signal.SIGUSR1)
        until = time.monotonic() + 30
        while rows_of(checkpoint) == 0 and time.monotonic() < until and process.poll() is None:
            time.sleep(0.005)
        rows = rows_of(checkpoint)
        checks.that("SIGUSR1 writes a checkpoint, and the run goes on", rows >= 20 and wait_for_rows(csv, rows + 1, process), rows)
        process.kill()
        process.communicate()
        resumed = run_example(folder, "compaction.py", "--out", "parts", "--resume", "--threads", "1")
        checks.that("resumed", resumed.returncode == 0, said(resumed))
        worst = differences(*[read_table(os.path.join(folder, part, "compaction.csv")) for part in ("whole", "parts")])
        checks.that("equals the whole run", max(worst.values()) == 0, worst)


def rows_of(checkpoint):
    with open(checkpoint, encoding="utf-8") as file:
        return json.load(file)["rows"]


print(f"seed {SEED}")
run_tests(compaction_terminated, compaction_killed, squeeze_interrupted, rigid_compaction_terminated,
          mixed_packing_terminated, drum_killed, heavy_ball_interrupted, a_signal_asks_for_a_checkpoint,
          a_finished_run_goes_on_to_a_higher_end)
