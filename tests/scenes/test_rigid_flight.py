# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains that move as rigid bodies until something comes near, inside the real yade: they fall as YADE's rigid discs do, heed what
scripts do to them, saved scenes go on to the last digit, a packing settles as without. (Tolerances: tests/core/step.)"""
import os
import sys

from yade import O
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, rigidDisc, softBox, softCloud, softDisc, softEngines  # noqa: E402

GRAVITY = (0, -9.81, 0)
WIDTH, COUNT = 10e-3, 20


def run(steps):
    for _ in range(steps):
        O.step()


def materials():
    O.reset()
    O.materials.append(NeoHookeanMat(lambda_=1e6, mu=1e5, viscosity=2.0, frictionAngle=0.2, label="gel"))
    O.materials.append(FrictMat(frictionAngle=0.2, density=1000, label="steel"))


def cloud(below):
    """Grains that sink to the floor of a box."""
    materials()
    grains, height = softCloud(WIDTH, COUNT, (1.4e-3, 2.4e-3), 0.3, "gel", points=60, seed=3)
    O.bodies.append(grains)
    O.bodies.append(softBox(WIDTH, height, "steel"))
    O.engines = softEngines(gravity=GRAVITY, rigidBelow=below)
    return measures.softIntegrator()


def falls_as_rigid_discs_do(checks):
    materials()
    soft, rigid = O.bodies.append([softDisc((0, 0), 1e-3, "gel", points=60, velocity=(0.1, 0.2, 0)),
                                   rigidDisc((5e-3, 0), 1e-3, material="steel")])
    O.bodies[rigid].state.vel = (0.1, 0.2, 0)
    O.engines = softEngines(gravity=GRAVITY, dt=1e-6)
    run(2000)
    one, other = O.bodies[soft].state, O.bodies[rigid].state
    checks.close_to("in flight", measures.softIntegrator().rigidCount, 1, 0)
    checks.close_to("velocity", (one.vel - other.vel).norm(), 0, 1e-14)
    checks.close_to("place", (one.pos - other.pos + O.bodies[rigid].state.refPos).norm(), 0, 1e-14)


def heeds_scripts(checks):
    """Velocity, spin and place by hand, a force, blocked degrees of freedom: the same as of a grain that deforms."""
    found = []
    for spin in (0, 1e-9):  # which keeps it from flying
        materials()
        disc = O.bodies[O.bodies.append(softDisc((0, 0), 1e-3, "gel", points=60, spin=spin))]
        O.engines = softEngines(dt=1e-6)
        run(100)
        checks.close_to("in flight", measures.softIntegrator().rigidCount, spin == 0, 0)
        disc.state.vel = (0.3, 0.1, 0)
        run(100)
        disc.state.pos = disc.state.pos + (1e-3, 2e-3, 0)
        run(100)
        for _ in range(100):
            O.forces.setPermF(disc.id, (1e-3, 0, 0))
            O.step()
        O.forces.setPermF(disc.id, (0, 0, 0))
        disc.state.blockedDOFs = "y"
        run(100)
        disc.state.blockedDOFs = ""
        disc.state.angVel = (0, 0, 3.0)
        run(100)
        soft = measures.softIntegrator()
        found.append((disc.state.pos, disc.state.vel, disc.state.angVel[2], soft.externalWork, measures.heldOrLost(soft)))
    for name, one, other in zip(("place", "velocity"), *found):
        checks.close_to(name, (one - other).norm() / other.norm(), 0, 1e-9)
    checks.close_to("spin", found[0][2], found[1][2], 1e-6)
    for state in found:
        checks.close_to("work", state[3] / state[4], 1, 1e-9)
    checks.close_to("the same work", found[0][3] / found[1][3], 1, 1e-9)


def settles_as_without(checks):
    heights, energies = [], []
    for below in (0, 1e-4):
        soft = cloud(below)
        flights = 0
        while O.time < 0.04:
            O.step()
            flights += soft.rigidCount
        heights.append(sum(body.state.pos[1] * body.state.mass for body in measures.softBodies()))
        energies.append((measures.heldOrLost(soft) - soft.externalWork) / soft.externalWork)
        print(f"rigid below {below:g}: {flights / O.iter / COUNT:.2f} of the grains in flight, energy off by {energies[-1]:.1e}, "
              f"damping {soft.dampingDissipation / soft.externalWork:.1e}")
        checks.that("they fly", flights / O.iter / COUNT > 0.3, flights / O.iter / COUNT)
        checks.that("what the tolerance takes", (soft.dampingDissipation > 0) == (below > 0)
                    and soft.dampingDissipation < 1e-2 * soft.externalWork, soft.dampingDissipation / soft.externalWork)
    checks.close_to("height of the centre of mass", heights[1] / heights[0], 1, 2e-3)
    for energy in energies:
        checks.close_to("energy", energy, 0, 1e-3)


def goes_on_after_saving(checks):
    soft = cloud(1e-3)
    O.bodies[0].state.angVel = (0, 0, 2)
    while O.time < 0.03:
        O.step()
    checks.that("some fly", 0 < soft.rigidCount < COUNT, soft.rigidCount)

    def all_of_it():
        return [arrays.points(body).tobytes() + arrays.outline(body).tobytes() for body in measures.softBodies()]

    with Folder() as folder:
        path = os.path.join(folder, "scene.yade.gz")
        O.save(path, quiet=True)
        run(300)
        expected = all_of_it(), soft.dampingDissipation, soft.viscousDissipation
        O.reset()
        O.load(path, quiet=True)
        run(300)
    soft = measures.softIntegrator()
    checks.that("the same bits", all_of_it() == expected[0])
    checks.close_to("damping", soft.dampingDissipation, expected[1], 0)
    checks.close_to("viscosity", soft.viscousDissipation, expected[2], 0)


def refused(checks):
    for value in (-0.1, 1.0, float("nan")):
        checks.raises(f"softEngines, {value}", ValueError, ["rigidBelow"], lambda: softEngines(rigidBelow=value))
    checks.raises("implicit", ValueError, ["rigidBelow", "implicit"],
                  lambda: softEngines(integrator="implicit", dt=1e-6, rigidBelow=0.1))
    soft = cloud(0)
    soft.rigidBelow = 1
    checks.raises("too much", RuntimeError, ["SoftIntegrator", "rigidBelow = 1", "less than 1"], O.step)
    O.engines = softEngines(integrator="implicit", dt=1e-6)
    measures.softIntegrator().rigidBelow = 0.1
    checks.raises("implicit, set later", RuntimeError, ["SoftImplicitIntegrator", "rigidBelow = 0.1", "be 0"], O.step)


run_tests(falls_as_rigid_discs_do, heeds_scripts, settles_as_without, goes_on_after_saving, refused)
