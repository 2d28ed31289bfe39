# SPDX-License-Identifier: GPL-2.0-or-later
"""What runs leave: units, parameters, versions, the command that repeats them; load_run() inside YADE and outside."""
import os
import shlex
import subprocess
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402
from softgrain import InputError, load_run, save_run  # noqa: E402
from softgrain.records import read_json, read_table, write_json  # noqa: E402

QUICK = ("--grains", "8", "--points", "40", "--until", "0.68", "--friction", "0.2", "--seed", "5", "--no-figures")
OUTSIDE = """
import numpy, softgrain
run = softgrain.load_run("run")
print(repr(run), run.seed, run.units["stress_bottom_Pa"], run["strain"].mean() > 0, run.versions["yade"], len(run.shots) > 1)
for name in ("softDisc", "snapshot"):
    try:
        getattr(softgrain, name)
    except ImportError as error:
        print(error)
softgrain.movie("run", "run.gif")
"""


def a_run_can_be_read_and_repeated(checks):
    with Folder() as folder:
        first = run_example(folder, "compaction.py", "--out", "run", "--force", *QUICK)
        checks.that("a run", first.returncode == 0, said(first))
        out = os.path.join(folder, "run")
        run = load_run(out)
        table = read_table(os.path.join(out, "compaction.csv"))
        checks.that("its columns", set(run.table) == set(table) and all(numpy.array_equal(run[name], table[name], equal_nan=True) for name in table))
        checks.that("what it is", (run.name, run.finished, run.seed, run.parameters["friction"], len(run)) == ("compaction", True, 5, 0.2, len(table["strain"])),
                    run)
        checks.that("versions", {"softgrain", "yade", "python", "numpy", "machine"} <= set(run.versions))
        units = {"time_s": "s", "strain": "-", "stress_top_Pa": "Pa", "kinetic_J": "J/m", "min_J": "-", "max_penetration_over_R": "-"}
        checks.that("units", all(run.units[name] == unit for name, unit in units.items()), run.units)
        checks.raises("a column that is not there", InputError, ["'stress'", "'strain'"], lambda: run["stress"])
        words = shlex.split(run.command)
        checks.that("the command leaves out how it was run", words[:3] == ["yade", "-n", "-x"] and "--force" not in words, run.command)
        os.rename(out, os.path.join(folder, "before"))
        subprocess.run(words, cwd=folder, capture_output=True, check=False)
        again, before = load_run(out), load_run(os.path.join(folder, "before"))
        checks.that("and repeats it to the last digit", all(numpy.array_equal(again[name], before[name], equal_nan=True)
                                                            for name in before.table if name != "cpu_s"))
        outside(checks, folder)
        os.remove(os.path.join(out, "summary.json"))
        run = load_run(out)
        checks.that("a run that is not finished", not run.finished and run.parameters == before.parameters and run.command == before.command
                    and run.seed == 5, run)
        broken(checks, out)


def outside(checks, folder):
    """In plain python3."""
    reader = subprocess.run(["/usr/bin/python3", "-c", OUTSIDE], cwd=folder, capture_output=True, text=True, check=False)
    lines = reader.stdout.splitlines()
    checks.that("load_run and movie outside of YADE", reader.returncode == 0 and len(lines) == 3, said(reader))
    checks.that("read", "run compaction" in lines[0] and " 5 Pa True 2023.02a True" in lines[0], lines[0])
    checks.that("what is missing there is said", all("softDisc" in lines[1] and "inside YADE" in line for line in lines[1:]), lines)
    checks.that("a movie", os.path.getsize(os.path.join(folder, "run.gif")) > 5000)
    star = subprocess.run(["/usr/bin/python3", "-c", "from softgrain import *"], cwd=folder, capture_output=True, text=True, check=False)
    checks.that("a scene run by python3 is told so", "works inside YADE only" in star.stderr, star.stderr)
    wrong = subprocess.run(["/usr/bin/python3", "-c", "import softgrain; softgrain.softDisk"], capture_output=True, text=True, check=False)
    checks.that("what is nowhere", "module 'softgrain' has no attribute 'softDisk'" in wrong.stderr, wrong.stderr)


def broken(checks, out):
    path = os.path.join(out, "checkpoint.json")
    record = read_json(path)
    checks.raises("no run", InputError, ["holds no run"], lambda: load_run(os.path.dirname(out)))
    for what, content in (("no json", "{"), ("a list", "[]"), ("of something else", '{"a": 1}')):
        with open(path, "w", encoding="ascii") as file:
            file.write(content)
        checks.raises(what, InputError, [path], lambda: load_run(out))
    write_json(path, record, nan=True)
    with open(os.path.join(out, "compaction.csv"), "a", encoding="ascii") as file:
        file.write("1,2\n")
    checks.raises("a damaged csv", InputError, ["compaction.csv", "damaged"], lambda: load_run(out))
    os.remove(os.path.join(out, "compaction.csv"))
    checks.raises("no csv", InputError, ["compaction.csv"], lambda: load_run(out))


def data_of_ones_own(checks):
    with Folder() as folder:
        out = os.path.join(folder, "mine")
        columns = {"time_s": [0.0, 1.0], "force_N_m": numpy.array([2.0, 1 / 3]), "count": [1, 2], "torque": [0.5, float("nan")]}
        save_run(out, columns, "fall", units={"torque": "N"}, seed=3, radius=1e-3, material="gel")
        run = load_run(out)
        checks.that("columns", numpy.allclose(run["force_N_m"], columns["force_N_m"], rtol=1e-9) and numpy.isnan(run["torque"][1]))
        checks.that("units", run.units == {"time_s": "s", "force_N_m": "N/m", "count": "-", "torque": "N"}, run.units)
        checks.that("record", (run.name, run.seed, run.parameters) == ("fall", 3, {"radius": 1e-3, "material": "gel"}), run.record)
        checks.that("the script", run.command.startswith("yade -n -x ") and "test_data.py" in run.command, run.command)
        for what, words, work in (
                ("lengths", ["1, 2 rows"], lambda: save_run(out, {"a": [1], "b": [1, 2]})),
                ("nothing", ["no rows"], lambda: save_run(out, {})),
                ("a unit of nothing", ["torc", "is no column"], lambda: save_run(out, {"a": [1]}, units={"torc": "N"})),
                ("units of nothing", ["tork, torque", "are no columns"],
                 lambda: save_run(out, {"a": [1]}, units={"torque": "N", "tork": "N"})),
                ("what json cannot hold", ["json"], lambda: save_run(out, {"a": [1]}, thing=object())),
                ("a folder", ["/proc/none"], lambda: save_run("/proc/none", {"a": [1]}))):
            checks.raises(what, InputError, words, work)


run_tests(a_run_can_be_read_and_repeated, data_of_ones_own)
