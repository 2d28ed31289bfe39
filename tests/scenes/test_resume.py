# SPDX-License-Identifier: GPL-2.0-or-later
"""A run that was interrupted or killed and resumed equals the uninterrupted one to the last digit."""
import json
import os
import random
import signal
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_signalled, run_tests, said  # noqa: E402
from softgrain.records import read_table  # noqa: E402

SEED = int(sys.argv[sys.argv.index("--seed") + 1]) if "--seed" in sys.argv else random.randrange(10**6)
RUNS = {"compaction": ["--grains", "25", "--points", "60", "--until", "0.85", "--seed", "3"],
        "squeeze": ["--points", "124", "--squeeze", "0.2", "--speed", "0.05"],
        "rigid_compaction": ["--grains", "40", "--speed", "0.3"], "drum": ["--quick"], "heavy_ball": ["--quick"],
        "mixed_packing": ["--grains", "20", "--rigid-fractions", "0", "0.5", "--friction", "0.2"]}
ROW, CHECKPOINT = "softgrain.records.Table.append", "softgrain.runs.write_json"     # the latter once the scene is saved
OFTEN = ["--checkpoint-seconds", "0.001"]


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


def resumed_equals_uninterrupted(checks, name, signal_number, call, of=ROW, more=(), tolerance=0):
    what = f"{name} {' '.join(more)}, {signal_number.name} at call {call} of {of}"
    with Folder() as folder:
        whole = run_example(folder, f"{name}.py", "--out", "whole", *RUNS[name], *more)
        checks.that(f"{what}: whole run", whole.returncode == 0, said(whole))
        parts = run_signalled(folder, [(of, call, signal_number)], f"{name}.py", "--out", "parts", *OFTEN, *RUNS[name], *more)
        if signal_number == signal.SIGKILL:
            checks.that(f"{what}: killed", parts.returncode == -signal_number, said(parts))
        else:
            checks.that(f"{what}: says how to go on", parts.returncode == 130 and "--resume" in parts.stderr, said(parts))
        checks.that(f"{what}: not finished", not os.path.exists(os.path.join(folder, "parts", "summary.json")))
        refused = run_example(folder, f"{name}.py", "--out", "parts", *RUNS[name], *more)
        checks.that(f"{what}: not overwritten", refused.returncode == 2 and "--resume" in refused.stderr, said(refused))
        resumed = run_example(folder, f"{name}.py", "--out", "parts", "--resume")
        checks.that(f"{what}: resumed", resumed.returncode == 0, said(resumed))
        tables = [read_table(os.path.join(folder, part, f"{name}.csv")) for part in ("whole", "parts")]
        worst = differences(*tables)
        checks.that(f"{what}: equals the whole run", max(worst.values()) <= tolerance, worst)
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


def compaction_killed_within_a_checkpoint(checks):
    resumed_equals_uninterrupted(checks, "compaction", signal.SIGKILL, 2, CHECKPOINT)


def squeeze_interrupted(checks):
    resumed_equals_uninterrupted(checks, "squeeze", signal.SIGINT, 5)


def rigid_discs_terminated(checks):
    resumed_equals_uninterrupted(checks, "rigid_compaction", signal.SIGTERM, 30, more=["--law", "cd"])


def rigid_discs_by_yades_law_terminated(checks):
    """YADE sums forces in another order once a scene is loaded, and chaos doubles that round-off about every few hundred steps; so the
    interruption comes early, while few discs touch."""
    resumed_equals_uninterrupted(checks, "rigid_compaction", signal.SIGTERM, 10, more=["--law", "yade"], tolerance=1e-6)


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
        parts = run_signalled(folder, [(ROW, 21, signal.SIGUSR1), (ROW, 40, signal.SIGKILL)], "compaction.py", "--out", "parts",
                              "--checkpoint-seconds", "1000", "--threads", "2", *options)
        checks.that("killed", parts.returncode == -signal.SIGKILL, said(parts))
        with open(os.path.join(folder, "parts", "checkpoint.json"), encoding="utf-8") as file:
            rows = json.load(file)["rows"]
        checks.that("SIGUSR1 writes a checkpoint, and the run goes on", rows == 21, rows)
        resumed = run_example(folder, "compaction.py", "--out", "parts", "--resume", "--threads", "1")
        checks.that("resumed", resumed.returncode == 0, said(resumed))
        worst = differences(*[read_table(os.path.join(folder, part, "compaction.csv")) for part in ("whole", "parts")])
        checks.that("equals the whole run", max(worst.values()) == 0, worst)


print(f"seed {SEED}")
run_tests(compaction_terminated, compaction_killed, compaction_killed_within_a_checkpoint, squeeze_interrupted,
          rigid_discs_terminated, rigid_discs_by_yades_law_terminated, mixed_packing_terminated, drum_killed, heavy_ball_interrupted,
          a_signal_asks_for_a_checkpoint, a_finished_run_goes_on_to_a_higher_end)
