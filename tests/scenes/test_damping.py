# SPDX-License-Identifier: GPL-2.0-or-later
"""Numerical damping inside the real yade: a packing relaxes to rest, energies balance, 0 is none to the last bit, saved scenes
go on, refusals. (Decay of a mode: tests/verification.)"""
import os
import sys

from yade import O
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, softBox, softCloud, softDisc, softEngines  # noqa: E402

WIDTH = 5e-3


def run(steps):
    for _ in range(steps):
        O.step()


def packing(**engines):
    """Twelve discs, shaken: the ids of the walls."""
    O.reset()
    O.materials.append(NeoHookeanMat(lambda_=6e6, mu=1e6, frictionAngle=0.2, label="gel"))
    O.materials.append(FrictMat(frictionAngle=0.1, label="glass"))
    grains, height = softCloud(WIDTH, 12, diameters=(1.2e-3, 1.6e-3), material="gel", points=60, seed=4)
    O.bodies.append(grains)
    walls = O.bodies.append(softBox(WIDTH, height, "glass"))
    O.engines = softEngines(**engines)
    return walls


def pressed(fraction=0.95, **engines):
    walls = packing(**engines)
    top = O.bodies[walls[3]].state
    top.vel = (0, -4, 0)
    while measures.solidFraction(WIDTH * top.pos[1]) < fraction:
        run(20)
    top.vel = (0, 0, 0)
    return walls


def relaxes(checks):
    walls = pressed()
    run(4000)
    soft = measures.softIntegrator()
    undamped = soft.kineticEnergy() / soft.elasticEnergy()
    soft.damping = 0.3
    O.trackEnergy = True
    run(6000)
    damped = soft.kineticEnergy() / soft.elasticEnergy()
    checks.that("a packing left alone goes on", undamped > 1e-4, undamped)
    checks.that("damped it comes to rest", damped < 1e-6 * undamped, (undamped, damped))
    bottom, top = (abs(O.forces.f(walls[k])[1]) for k in (2, 3))
    checks.close_to("walls in balance", bottom, top, 0.15 * top)  # sides carry the rest by friction
    missing = measures.heldOrLost(soft) / soft.externalWork - 1
    checks.that("energy balance", abs(missing) < 2e-3, missing)
    energy = dict(O.energy.items())
    checks.close_to("O.energy", energy["softDamping"], soft.dampingDissipation, 1e-12 * soft.externalWork)
    checks.that("something was dissipated", soft.dampingDissipation > 0)


def none_is_absent(checks):
    found = []
    for engines in ({}, {"damping": 0}):
        pressed(0.8, **engines)
        O.trackEnergy = True
        run(10)
        found.append([arrays.points(body).tobytes() for body in measures.softBodies()])
        checks.that("no entry in O.energy", "softDamping" not in dict(O.energy.items()))
    checks.that("the same bits", found[0] == found[1])


def goes_on_after_saving(checks):
    pressed(0.85, damping=0.2)
    run(50)
    with Folder() as folder:
        path = os.path.join(folder, "scene.yade.gz")
        O.save(path, quiet=True)
        run(200)
        expected = [arrays.points(body) for body in measures.softBodies()], measures.softIntegrator().dampingDissipation
        O.reset()
        O.load(path, quiet=True)
        run(200)
    soft = measures.softIntegrator()
    checks.close_to("damping", soft.damping, 0.2, 0)
    off = max(abs(arrays.points(body) - points).max() for body, points in zip(measures.softBodies(), expected[0]))
    checks.close_to("places", off, 0, 1e-12 * WIDTH)
    checks.close_to("dissipation", soft.dampingDissipation, expected[1], 1e-10 * expected[1])


def refused(checks):
    for value in (-0.1, 1.0, float("nan")):
        checks.raises(f"softEngines, {value}", ValueError, ["damping"], lambda: softEngines(damping=value))
    checks.raises("implicit", ValueError, ["damping", "implicit"], lambda: softEngines(integrator="implicit", dt=1e-6, damping=0.2))
    packing(integrator="implicit", dt=1e-6)
    measures.softIntegrator().damping = 0.2
    checks.raises("implicit, set later", RuntimeError, ["SoftImplicitIntegrator", "damping = 0.2", "be 0"], O.step)
    packing()
    measures.softIntegrator().damping = 1
    for attempt in range(2):
        checks.raises(f"too much, attempt {attempt}", RuntimeError, ["SoftIntegrator", "damping = 1", "less than 1"], O.step)
    measures.softIntegrator().damping = 0.2
    run(2)
    O.bodies[3].state.blockedDOFs = "x"
    checks.raises("blocked", RuntimeError, ["#3", "damping = 0.2", "blockedDOFs"], O.step)
    O.bodies[3].state.blockedDOFs = ""
    run(2)
    checks.that("mended", O.iter == 4, O.iter)
    O.reset()
    O.materials.append(NeoHookeanMat(label="gel"))
    O.bodies.append(softDisc((0, 0), 1e-3, "gel", points=60, formulation="updated"))
    O.engines = softEngines(damping=0.2)
    checks.raises("updated", RuntimeError, ["#0", "damping = 0.2", "updated", "total"], O.step)


run_tests(relaxes, none_is_absent, goes_on_after_saving, refused)
