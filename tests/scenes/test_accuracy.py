# SPDX-License-Identifier: GPL-2.0-or-later
"""Presets deliver the error they name and refuse what they cannot; a study computes every run once."""
import os
import sys

from yade import O

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, run_example, run_tests, said  # noqa: E402
from softgrain import (  # noqa: E402
    MooneyRivlinMat, NeoHookeanMat, SoftTimeStepper, measures, presets, softCloud, softDisc, softEngines, work_precision)
from softgrain.checks import InputError  # noqa: E402
from softgrain.options import Options  # noqa: E402
from softgrain.study import Job, Study  # noqa: E402

REFERENCE = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(sys.argv[0]))), "verification", "reference",
                         "A_plates_{}.csv")


def presets_deliver_the_error_they_name(checks):
    """On one grain, with an orientation of the grid that the study did not try."""
    with Folder() as folder:
        for name, error in presets.table()["names"].items():
            for material in ("nh", "mr"):
                run = run_example(folder, "squeeze.py", "--accuracy", name, "--material", material, "--speed", "0.2",
                                  "--angle", "0.3", "--out", f"{name}-{material}")
                checks.that(f"{name}, {material}", run.returncode == 0, said(run))
                found = work_precision.of_grain(os.path.join(folder, f"{name}-{material}"),
                                                REFERENCE.format(material.upper()))["force_worst_error"]
                print(f"{name}, {material}: promised {error:.3f}, found {found:.4f}")
                checks.that(f"{name}, {material}: within what it promises", found <= error, found)


def the_cheapest_setting_is_taken(checks):
    table = presets.table()
    costs = [chosen["packing_cpu_s"] for chosen in table["settings"]]
    errors = [chosen["error"] for chosen in table["settings"]]
    checks.that("costs rise", costs == sorted(costs))
    checks.that("errors fall", errors == sorted(errors, reverse=True))
    checks.that("every name is within reach", min(table["names"].values()) >= errors[-1])
    for chosen in table["settings"]:
        checks.that("its own error", presets.settings("test", chosen["error"]) == chosen)
    checks.that("names", [presets.settings("test", name) for name in table["names"]]
                == [presets.settings("test", error) for error in table["names"].values()])


def builders_take_an_accuracy(checks):
    chosen = presets.settings("test", "draft")
    for body in (softDisc((0, 0), 1e-3, NeoHookeanMat(), accuracy="draft"),
                 softCloud(4e-3, 6, material=MooneyRivlinMat(), accuracy="draft")[0][0]):
        checks.that("points", body.shape.points == chosen["points"])
        checks.close_to("spacing", body.shape.surfaceSpacing, chosen["surface_spacing"], 1e-12)
    checks.that("without one", softDisc((0, 0), 1e-3, NeoHookeanMat()).shape.points == 276)
    O.reset()
    O.engines = softEngines(accuracy="draft")
    checks.close_to("tolerance", measures.softIntegrator().tolerance, chosen["tolerance"], 1e-12)
    stepper = next(engine for engine in O.engines if isinstance(engine, SoftTimeStepper))
    checks.close_to("time step", stepper.safety, chosen["safety"], 1e-12)


def nonsense_is_refused(checks):
    def disc(**more):
        return lambda: softDisc((0, 0), 1e-3, NeoHookeanMat(), **more)

    for what, words, work in (
            ("points beside it", ["points", "accuracy"], disc(accuracy="fine", points=60)),
            ("spacing beside it", ["surfaceSpacing", "accuracy"], disc(accuracy=0.1, surfaceSpacing=1.0)),
            ("no name", ["'good'", "'standard'"], disc(accuracy="good")),
            ("below zero", ["accuracy", "-0.1"], disc(accuracy=-0.1)),
            ("out of reach", ["1e-09", "finest"], disc(accuracy=1e-9)),
            ("tolerance beside it", ["tolerance", "accuracy"], lambda: softEngines(accuracy=0.1, tolerance=1e-3)),
            ("dt beside it", ["dt", "accuracy"], lambda: softEngines(accuracy=0.1, dt=1e-7))):
        checks.raises(what, InputError, words, work)


def a_study_computes_every_run_once(checks):
    with Folder() as folder:
        options = Options(out=os.path.join(folder, "study"), force=False, resume=False, checkpoint_seconds=20.0, given=set())
        squeeze, read = os.path.join(EXAMPLES, "squeeze.py"), []

        def reader(points):
            def values(run):
                read.append(points)
                return {"rows": len(os.listdir(run))}
            return values

        def jobs(*counts):
            return [Job({"points": n}, squeeze, ["--quick", "--points", n], reader(n), n) for n in counts]

        study = Study("study", options, ["points", "rows", "status"])
        study.compute(jobs(60, 2), at_once=2)
        rows = {row["points"]: row for row in study.rows()}
        checks.that("two rows", set(rows) == {2, 60}, rows)
        checks.that("done", rows[60]["status"] == "done" and rows[60]["rows"] > 1, rows)
        checks.that("a run without a result says why", "points" in rows[2]["status"], rows)
        options.resume = True
        again = Study("study", options, ["points", "rows", "status"])
        again.compute(jobs(60, 2, 124), at_once=2)
        checks.that("only the new one is computed", read == [60, 124] and len(again.rows()) == 3, read)
        checks.that("nothing is left but the study", sorted(os.listdir(study.folder)) == ["checkpoint.json", "study.csv"])


run_tests(presets_deliver_the_error_they_name, the_cheapest_setting_is_taken, builders_take_an_accuracy,
          nonsense_is_refused, a_study_computes_every_run_once)
