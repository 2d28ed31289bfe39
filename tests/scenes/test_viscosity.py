# SPDX-License-Identifier: GPL-2.0-or-later
"""Viscosity of the solid inside the real yade: a disc that rebounds and vibrates loses what the integrator says, goes on after
saving, follows its material, and is refused where viscosity is not known. (Rates of decay: tests/verification.)"""
import os
import sys

import numpy
from yade import O
from yade.utils import wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, softDisc, softEngines  # noqa: E402
from softgrain.records import read_table  # noqa: E402

RADIUS, SPEED = 1e-3, 2.0


def run(steps):
    for _ in range(steps):
        O.step()


def rebound(viscosity, formulation="total", **engines):
    """A disc flies against a wall; the body of the disc."""
    O.reset()
    soft = O.materials.append(NeoHookeanMat(viscosity=viscosity, label="gel"))
    O.bodies.append(softDisc((0, 0), RADIUS, soft, points=124, velocity=(0, -SPEED), formulation=formulation))
    O.bodies.append(wall(-1.02 * RADIUS, axis=1, sense=1, material=FrictMat(frictionAngle=0)))
    O.engines = softEngines(**engines)
    return O.bodies[0]


def vibration(body):
    """Energy of the disc in its own frame [J/m]."""
    soft = measures.softIntegrator()
    return soft.kineticEnergy() + soft.elasticEnergy() - 0.5 * body.state.mass * body.state.vel.squaredNorm()


def free_vibration(checks):
    body = rebound(0.2)
    O.trackEnergy = True
    O.step()
    start = measures.heldOrLost(measures.softIntegrator())
    while body.state.pos[1] < 0.1 * RADIUS:
        run(50)
    soft = measures.softIntegrator()
    before, lost = vibration(body), soft.viscousDissipation
    missing = measures.heldOrLost(soft) / start - 1
    checks.that("energy balance after the rebound", abs(missing) < 5e-3, missing)
    checks.that("it vibrates", before > 0.02 * start, before / start)
    while vibration(body) > 0.1 * before and O.time < 0.1:
        run(50)
    gone, dissipated = before - vibration(body), soft.viscousDissipation - lost
    checks.that("what the vibration loses is dissipated", abs(dissipated / gone - 1) < 5e-3, dissipated / gone)
    energy = dict(O.energy.items())
    checks.close_to("O.energy", energy["softViscous"], soft.viscousDissipation, 1e-12 * start)
    checks.close_to("its sum", sum(value for name, value in energy.items() if name.startswith("soft")), start, 5e-3 * start)


def without_it_nothing_is_lost(checks):
    body = rebound(0)
    O.trackEnergy = True
    while body.state.pos[1] < 0.1 * RADIUS:
        run(50)
    before = vibration(body)
    run(2000)
    checks.close_to("the vibration goes on", vibration(body), before, 5e-3 * before)
    checks.that("no entry in O.energy", "softViscous" not in dict(O.energy.items()))


def goes_on_after_saving(checks):
    body = rebound(0.2)
    run(600)
    with Folder() as folder:
        path = os.path.join(folder, "scene.yade.gz")
        O.save(path, quiet=True)
        run(200)
        expected = arrays.points(body), measures.softIntegrator().viscousDissipation
        O.reset()
        O.load(path, quiet=True)
        run(200)
    checks.close_to("the material", O.bodies[0].material.viscosity, 0.2, 0)
    checks.close_to("places", abs(arrays.points(O.bodies[0]) - expected[0]).max(), 0, 1e-12 * RADIUS)
    checks.close_to("dissipation", measures.softIntegrator().viscousDissipation, expected[1], 1e-10 * expected[1])


def follows_its_material(checks):
    body = rebound(0)
    run(600)
    soft = measures.softIntegrator()
    checks.that("nothing dissipated", soft.viscousDissipation == 0)
    step = soft.criticalStep
    body.material.viscosity = 200
    run(1)
    checks.that("the stable step is shorter at once", soft.criticalStep < 0.5 * step and O.dt < soft.criticalStep,
                (step, soft.criticalStep, O.dt))
    run(100)
    checks.that("it dissipates", soft.viscousDissipation > 0)
    dissipated = soft.viscousDissipation
    body.material.viscosity = 0
    run(100)
    checks.that("and ends when it is taken away", soft.viscousDissipation - dissipated == 0 and soft.criticalStep > 0.9 * step)
    body.material.viscosity = -1
    for attempt in range(2):
        checks.raises(f"a negative one, attempt {attempt}", (RuntimeError, ValueError), ["#0", "viscosity", "-1"], O.step)


def refused(checks):
    body = rebound(0.2, integrator="implicit", dt=1e-5)
    for attempt in range(2):
        checks.raises(f"implicit, attempt {attempt}", RuntimeError, ["#0", "viscosity", "0.2", "SoftIntegrator"], O.step)
    body.material.viscosity = 0
    run(5)
    checks.that("mended", O.iter == 5)
    body = rebound(0.2, formulation="updated")
    for attempt in range(2):
        checks.raises(f"updated, attempt {attempt}", (RuntimeError, ValueError), ["#0", "viscosity", "0.2", "updated", "total"],
                      O.step)
    body.material.viscosity = 0
    run(5)
    checks.that("mended", O.iter == 5)


def examples(checks):
    with Folder() as folder:
        run = run_example(folder, "squeeze.py", "--quick", "--viscosity", "0.5", "--points", "60", "--squeeze", "0.1")
        checks.that("squeeze", "energy missing below 0.2 %" in run.stdout and run.returncode == 0, said(run))
        words = ["--grains", "10", "--points", "60", "--viscosity", "0.5", "--no-figures"]
        run = run_example(folder, "compaction.py", "--out", "whole", "--until", "0.72", *words)
        checks.that("compaction", run.returncode == 0, said(run))
        run_example(folder, "compaction.py", "--out", "parts", "--until", "0.7", *words)
        run = run_example(folder, "compaction.py", "--out", "parts", "--resume", "--until", "0.72")
        checks.that("resumed", run.returncode == 0, said(run))
        whole, parts = (read_table(os.path.join(folder, name, "compaction.csv")) for name in ("whole", "parts"))
        lost, work = whole["viscous_dissipation_J"][-1], whole["external_work_J"][-1]
        checks.that("a column of its own", lost > 0.05 * work, (lost, work))
        checks.that("energy balance", abs(whole["energy_residual_J"][-1]) < 5e-3 * work, whole["energy_residual_J"][-1] / work)
        same = numpy.allclose(parts["viscous_dissipation_J"], whole["viscous_dissipation_J"], rtol=1e-9, atol=0)
        checks.that("the same resumed", same)


run_tests(free_vibration, without_it_nothing_is_lost, goes_on_after_saving, follows_its_material, refused, examples)
