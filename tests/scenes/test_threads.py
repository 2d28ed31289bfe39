# SPDX-License-Identifier: GPL-2.0-or-later
"""The same csv, to the last digit, for one thread and for two; --threads and yade -j mean the same."""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402


def rows_without_cpu_time(folder, run):
    """The lines of the csv, as lists of words, without that column."""
    with open(os.path.join(folder, run, "compaction.csv"), encoding="ascii") as file:
        lines = [line.strip().split(",") for line in file]
    place = lines[0].index("cpu_s")
    return [line[:place] + line[place + 1:] for line in lines]


def one_and_two_threads_agree(checks):
    options = ["--grains", "30", "--points", "60", "--until", "0.88", "--friction", "0.3", "--wall-friction", "0.2"]
    with Folder() as folder:
        runs = {"one": run_example(folder, "compaction.py", "--out", "one", *options, threads=1),
                "two": run_example(folder, "compaction.py", "--out", "two", *options, threads=2),
                "again": run_example(folder, "compaction.py", "--out", "again", "--threads", "2", *options)}
        for name, run in runs.items():
            checks.that(f"run {name}", run.returncode == 0, said(run))
        one = rows_without_cpu_time(folder, "one")
        checks.that("rows", len(one) > 50)
        checks.that("-j2 gives the same digits", rows_without_cpu_time(folder, "two") == one)
        checks.that("--threads 2 gives the same digits", rows_without_cpu_time(folder, "again") == one)
        with open(os.path.join(folder, "again", "summary.json"), encoding="utf-8") as file:
            checks.that("--threads 2 ran two threads", json.load(file)["cost"]["threads"] == 2)


run_tests(one_and_two_threads_agree)
