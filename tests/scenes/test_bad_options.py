# SPDX-License-Identifier: GPL-2.0-or-later
"""Bad options of the examples: one sentence on stderr, exit code 2, no traceback; nothing is overwritten."""
import contextlib
import io
import json
import os
import runpy
import sys

from yade import O

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, is_sentence, run_tests  # noqa: E402
from softgrain.records import digest, read_table, sealed  # noqa: E402

SMALL = ["--grains", "10", "--points", "60"]

# example, options, words that the sentence has to hold
BAD = [
    ("compaction", ["--grain", "3"], ["--grain", "--help"]),
    ("mixed_packing", ["--rigid-fractions", "0", "1.5"], ["--rigid-fractions", "1.5", "between 0 and 1"]),
    ("mixed_packing", ["--friction", "0", "0.1", "0.2", "0.3", "0.4"], ["--friction", "5 values", "four"]),
    ("funnel", ["--opening", "1"], ["--opening 1", "narrower"]),
    ("funnel", ["--slope", "88"], ["--slope 88", "85 degrees"]),
    ("drum", ["--spin", "0"], ["--spin", "0"]),
    ("heavy_ball", ["--grains", "0"], ["--grains", "0"]),
    ("compaction", ["--grains", "none"], ["--grains", "none"]),
    ("compaction", ["--grains", "0"], ["--grains", "0"]),
    ("compaction", ["--points", "5"], ["points", "5", "16"]),
    ("compaction", ["--speed", "-1"], ["--speed", "-1"]),
    ("compaction", ["--speed", "nan"], ["--speed", "nan"]),
    ("compaction", ["--mu", "-1e6"], ["--mu", "-1e6"]),
    ("compaction", ["--density", "0"], ["--density", "0"]),
    ("compaction", ["--friction", "-0.3"], ["--friction", "-0.3"]),
    ("compaction", ["--diameters", "2e-3", "1e-3"], ["diameters", "0.002"]),
    ("compaction", ["--diameters", "2e-3"], ["--diameters"]),
    ("compaction", ["--solid-fraction", "0.83"], ["0.83", "out of reach"]),
    ("compaction", ["--until", "0.6"], ["--until", "0.6", "0.65"]),
    ("compaction", ["--material", "rubber"], ["--material", "rubber"]),
    ("compaction", ["--seed", "-4"], ["--seed", "-4"]),
    ("compaction", ["--integrator", "backward"], ["backward", "implicit"]),
    ("compaction", ["--integrator", "implicit", "--theta", "0.4"], ["theta", "0.4", "0.5"]),
    ("compaction", ["--integrator", "explicit", "--quasistatic"], ["--quasistatic", "explicit", "implicit"]),
    ("compaction", ["--formulation", "eulerian"], ["eulerian", "total", "updated"]),
    ("compaction", ["--threads", "0"], ["--threads", "0"]),
    ("compaction", ["--out", "/proc/nowhere"], ["/proc/nowhere", "--out"]),
    ("compaction", ["--threads", "9999"], ["--threads", "9999", "cores"]),
    ("compaction", ["--out", ""], ["--out", "empty"]),
    ("compaction", ["--out", "/dev/null"], ["/dev/null", "--out"]),
    ("compaction", ["surplus"], ["surplus"]),
    # what the engines find in the first step
    ("compaction", [*SMALL, "--lambda", "-5e6"], ["lambda", "-5e+06", "grains"]),
    ("compaction", [*SMALL, "--material", "mr", "--c2", "-0.5e6"], ["c2", "grains"]),
    ("compaction", [*SMALL, "--dt", "1e-3"], ["0.001", "largest stable"]),
    ("compaction", [*SMALL, "--speed", "50"], ["--speed", "50", "steps"]),
    ("squeeze", ["--points", "60", "--speed", "50"], ["--speed", "50", "steps"]),
    ("squeeze", ["--points", "1000000"], ["points", "1000000", "100000"]),
    ("rigid_compaction", ["--grains", "10", "--dt", "1"], ["--dt", "1", "stable"]),
    ("squeeze", ["--accuracy", "good"], ["'good'", "'draft'"]),
    ("squeeze", ["--accuracy", "0.05", "--points", "60"], ["--points", "accuracy"]),
    ("compaction", ["--accuracy", "1e-9"], ["1e-09", "finest"]),
    ("compaction", ["--surface-spacing", "9"], ["surfaceSpacing", "9", "4"]),
    ("compaction", ["--safety", "1"], ["safety", "1"]),
    ("compaction", ["--tolerance", "0"], ["--tolerance", "0"]),
    ("compaction", ["--locking-cure", "maybe"], ["--locking-cure", "maybe"]),
    ("accuracy_cost", ["--seeds", "0"], ["--seeds", "0"]),
    ("accuracy_cost", ["--at-once", "none"], ["--at-once", "none"]),
    ("squeeze", ["--walls", "3"], ["--walls", "3"]),
    ("squeeze", ["--radius", "0"], ["--radius", "0"]),
    ("squeeze", ["--squeeze", "0.95"], ["--squeeze", "0.95"]),
    ("squeeze", ["--integrator", "explicit", "--quasistatic"], ["--quasistatic", "explicit", "implicit"]),
    ("rigid_compaction", ["--stiffness", "-1"], ["--stiffness", "-1"]),
    ("rigid_compaction", ["--damping", "1"], ["--damping", "1"]),
    ("rigid_compaction", ["--points", "60"], ["--points"]),
]


def run_inside(example, options):
    """Runs an example in this process: exit code, stdout, stderr."""
    arguments, out, err = sys.argv, io.StringIO(), io.StringIO()
    path = os.path.join(EXAMPLES, f"{example}.py")
    sys.argv = [path, *options]
    O.reset()
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            runpy.run_path(path, init_globals=dict(globals()), run_name="__main__")
        code = None
    except SystemExit as end:
        code = end.code
    finally:
        sys.argv = arguments
    return code, out.getvalue(), err.getvalue()


def bad_options_are_refused(checks):
    with Folder() as folder:
        for example, options, words in BAD:
            there = [] if "--out" in options else ["--out", os.path.join(folder, "bad")]
            code, out, err = run_inside(example, options + there)
            name = f"{example} {' '.join(options)}"
            checks.that(f"{name}: exit code 2", code == 2, f"exit code {code}, {out}{err}")
            missing = [word for word in words if word not in err]
            checks.that(f"{name}: one sentence", is_sentence(err.strip()) and not missing,
                        f"said {err!r}, lacks {missing}")
        checks.that("nothing is left", os.listdir(os.path.join(folder, "bad")) == [])


def help_is_there(checks):
    for example in ("compaction", "squeeze", "rigid_compaction", "soft_vs_rigid", "accuracy_cost", "mixed_packing", "heavy_ball",
                    "funnel", "drum"):
        code, out, _ = run_inside(example, ["--help"])
        checks.that(f"{example} --help", code == 0 and "--resume" in out and "--out" in out, out[:300])


def a_finished_run_is_not_overwritten(checks):
    with Folder() as folder:
        out = os.path.join(folder, "run")
        common = ["--out", out, "--grains", "8", "--until", "0.7"]
        code, _, err = run_inside("rigid_compaction", common)
        checks.that("a small run", code == 0, err)
        csv = os.path.join(out, "rigid_compaction.csv")
        with open(csv, encoding="ascii") as file:
            before = file.read()
        code, _, err = run_inside("rigid_compaction", common)
        checks.that("is not overwritten", code == 2 and "--force" in err and is_sentence(err.strip()), err)
        code, _, err = run_inside("squeeze", ["--out", out, "--resume"])
        checks.that("is not taken for one of another example", code == 2 and "rigid_compaction" in err, err)
        code, _, err = run_inside("rigid_compaction", [*common, "--resume", "--seed", "5"])
        checks.that("is not resumed with another seed", code == 2 and "--seed" in err, err)
        with open(csv, encoding="ascii") as file:
            checks.that("and is still what it was", file.read() == before)
        code, _, err = run_inside("rigid_compaction", [*common, "--force", "--seed", "5"])
        with open(csv, encoding="ascii") as file:
            checks.that("--force overwrites", code == 0 and file.read() != before, err)


def a_finished_run_survives_bad_options(checks):
    with Folder() as folder:
        out = os.path.join(folder, "run")
        common = ["--out", out, *SMALL, "--until", "0.66"]
        code, _, err = run_inside("compaction", common)
        checks.that("a small run", code == 0, err)
        before = sorted(os.listdir(out))
        code, _, err = run_inside("compaction", [*common, "--force", "--lambda", "-5e6"])
        checks.that("is not lost to --force with a bad value", code == 2 and sorted(os.listdir(out)) == before, err)


def spoiled_checkpoints_are_refused(checks):
    with Folder() as folder:
        out = os.path.join(folder, "run")
        code, _, err = run_inside("compaction", ["--out", out, *SMALL, "--until", "0.66"])
        checks.that("a small run", code == 0, err)
        with open(os.path.join(out, "checkpoint.json"), encoding="utf-8") as file:
            good = json.load(file)
        scene = os.path.join(out, good["scene"])

        def spoiled(what, words, file, content):
            with open(file, "wb") as opened:
                opened.write(content)
            code, _, err = run_inside("compaction", ["--out", out, "--resume", "--until", "0.7"])
            missing = [word for word in words if word not in err]
            checks.that(what, code == 2 and is_sentence(err.strip()) and not missing, f"{code}: {err!r}, lacks {missing}")

        def note(**changed):
            return json.dumps(sealed({**good, **changed})).encode()

        stored = os.path.join(out, "checkpoint.json")
        spoiled("of another softgrain", ["9.9", "version"], stored, note(versions={**good["versions"], "softgrain": "9.9"}))
        spoiled("no json", ["checkpoint.json", "--force"], stored, b"{")
        spoiled("a list", ["checkpoint.json", "--force"], stored, b"[]")
        spoiled("a scene that is not there", ["nowhere.yade", "--force"], stored, note(scene="nowhere.yade"))
        spoiled("more rows than the csv", ["compaction.csv", "1000", "--force"], stored, note(rows=1000))
        with open(stored, "wb") as file:
            file.write(note())
        spoiled("a scene that is none", [good["scene"], "--force"], scene, b"garbage")
        digests = [good["digests"][0], digest(b"garbage")]
        spoiled("a scene that is none, sealed", [good["scene"], "cannot be loaded", "--force"], stored, note(digests=digests))
        os.remove(stored)
        code, _, err = run_inside("compaction", ["--out", out, "--resume", "--until", "0.7"])
        checks.that("no checkpoint", code == 2 and "without its checkpoint" in err and is_sentence(err.strip()), err)


def a_run_that_breaks_down_leaves_its_rows(checks):
    """Squeezed far beyond what the grains can follow."""
    with Folder() as folder:
        out = os.path.join(folder, "run")
        code, text, err = run_inside("compaction", ["--out", out, *SMALL, "--until", "2"])
        words = ["step", "soft grain #", "folded over itself", "likely causes"]
        missing = [word for word in words if word not in err]
        checks.that("exit code 1 and one sentence", code == 1 and is_sentence(err.strip()) and not missing,
                    f"{code}: {err!r}, lacks {missing}")
        rows = len(read_table(os.path.join(out, "compaction.csv"))["strain"])
        checks.that("the rows before are there, and it says so", rows > 100 and f"{rows} rows" in text, text[-200:])
        checks.that("no summary", not os.path.exists(os.path.join(out, "summary.json")))


run_tests(bad_options_are_refused, help_is_there, a_finished_run_is_not_overwritten,
          a_finished_run_survives_bad_options, spoiled_checkpoints_are_refused, a_run_that_breaks_down_leaves_its_rows)
