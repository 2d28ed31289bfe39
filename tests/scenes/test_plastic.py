# SPDX-License-Identifier: GPL-2.0-or-later
"""Plasticity inside the real yade: a block pressed by smooth walls and released, against the plane-strain solution; a disc that
stays flat; energy balances; saving; materials changed by hand; refusals; examples. (Return map, finite elements:
tests/verification.)"""
import math
import os
import sys

import numpy
from yade import O
from yade.utils import wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402
from softgrain import NeoHookeanMat, PlasticMat, arrays, measures, softDisc, softEngines, softPolygon  # noqa: E402
from softgrain.records import read_table  # noqa: E402

LAMBDA, MU, YIELD, HARDENING = 2e6, 1e6, 4e4, 2e5
SIDE = 1e-3


def run(steps):
    for _ in range(steps):
        O.step()


def metal(**changed):
    return PlasticMat(**{"lambda_": LAMBDA, "mu": MU, "yieldStress": YIELD, "hardening": HARDENING, "label": "metal", **changed})


def pressed(make, speed, material=None, **engines):
    """A grain between two walls that close on it along y; the ids of the walls."""
    O.reset()
    O.materials.append(material or metal())
    stone = O.materials.append(FrictMat(frictionAngle=0))
    O.bodies.append(make())
    walls = [O.bodies.append(wall(side * SIDE, axis=1, sense=-side, material=stone)) for side in (-1, 1)]
    drive(walls, speed)
    O.engines = softEngines(**engines)
    return walls


def drive(walls, speed):
    for side, body in zip((-1, 1), walls):
        O.bodies[body].state.vel = (0, -side * speed, 0)


def block():
    return softPolygon([(x * SIDE, y * SIDE) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], "metal", points=64)


def disc(points=124, formulation="total"):
    return softDisc((0, 0), SIDE, "metal", points=points, formulation=formulation)


def plane_strain(heights):
    """Of a block with free sides whose height changes by exp(height) along a path: logarithmic strain across, stress along y
    [Pa] and plastic strain at its end. Axes do not turn, so that this is the small-strain return map in logarithms; the strain
    across is the one without stress."""
    plastic, gathered, across = numpy.zeros(3), 0.0, 0.0

    def trial(side, height):
        """Kirchhoff's stress, change of the plastic strain, flow."""
        strain = numpy.array([side, height, 0.0]) - plastic
        deviator = strain - strain.mean()
        size = math.sqrt(6) * MU * numpy.linalg.norm(deviator)
        flow = max(0.0, size - YIELD - HARDENING * gathered) / (3 * MU + HARDENING)
        left = deviator * (1 - 3 * MU * flow / max(size, 1e-300))
        return (LAMBDA + 2 * MU / 3) * strain.sum() + 2 * MU * left, deviator - left, flow

    for height in heights:
        for _ in range(50):
            stress = trial(across, height)[0][0]
            slope = (trial(across + 1e-7, height)[0][0] - stress) / 1e-7
            across -= stress / slope
        tau, change, flow = trial(across, height)
        plastic, gathered = plastic + change, gathered + flow
    return across, tau[1] / math.exp(across + height), gathered


def path(*ends):
    """Heights from 0 to the ends, one after the other, in steps of 1e-3."""
    heights, here = [], 0.0
    for end in ends:
        count = round(abs(end - here) / 1e-3)
        heights += list(numpy.linspace(here, end, count + 1)[1:])
        here = end
    return heights


def block_against_the_closed_form(checks):
    """Pressed to 0.8 of its height, quasi-static, then released until the walls are free, and pressed again."""
    walls = pressed(block, 1.0, integrator="implicit", quasistatic=True, dt=2e-6)
    body = O.bodies[0]

    def press_to(height):
        while abs(O.bodies[walls[1]].state.pos[1] / SIDE - height) > 1e-3:
            O.step()
        found = math.log(O.bodies[walls[1]].state.pos[1] / SIDE)
        width = numpy.ptp(arrays.outline(body)[:, 0])
        return found, O.forces.f(walls[1])[1] / width, math.log(width / (2 * SIDE))

    trail = []
    for end, speed in ((0.9, 1.0), (0.8, 1.0), (0.81, -0.2), (0.75, 1.0)):
        drive(walls, speed)
        height, stress, across = press_to(end)
        trail.append(height)
        expected = plane_strain(path(*trail))
        checks.close_to(f"stress at {end}", -stress, expected[1], 5e-3 * YIELD)
        checks.close_to(f"width at {end}", across, expected[0], 1e-3)
        strains = arrays.plasticStrains(body)
        checks.that(f"plastic strain at {end}", abs(strains - expected[2]).max() < 2e-3, (strains.min(), strains.max(), expected))
    soft = measures.softIntegrator()
    checks.that("what is dissipated follows from the plastic strain",
                abs(soft.plasticDissipation / sum(
                    arrays.pointVolumes(body) * (YIELD * strains + HARDENING / 2 * strains**2)) - 1) < 1e-9)
    missing = measures.heldOrLost(soft) / soft.externalWork - 1 - soft.kineticEnergy() / soft.externalWork
    checks.that("energy balance", abs(missing) < 1e-2, missing)


def a_disc_stays_flat(checks):
    walls = pressed(disc, 1.0)
    O.trackEnergy = True
    while O.bodies[walls[1]].state.pos[1] > 0.8 * SIDE:
        run(20)
    soft, body = measures.softIntegrator(), O.bodies[0]
    missing = measures.heldOrLost(soft) / soft.externalWork - 1
    checks.that("explicit: energy balance", abs(missing) < 3e-3, missing)
    checks.that("most of the work is dissipated", soft.plasticDissipation > 0.5 * soft.externalWork)
    energy = dict(O.energy.items())
    checks.close_to("O.energy", energy["softPlastic"], soft.plasticDissipation, 1e-12 * soft.externalWork)
    checks.close_to("its sum", sum(value for name, value in energy.items() if name.startswith("soft")), 0,
                    3e-3 * soft.externalWork)
    drive(walls, -1.0)
    while O.bodies[walls[1]].state.pos[1] < 1.1 * SIDE:
        run(20)
    height = measures.extent(arrays.outline(body), 1) / (2 * SIDE)
    checks.that("it stays flat", 0.79 < height < 0.87, height)
    checks.that("and keeps its area", abs(body.state.area() / body.shape.area() - 1) < 0.02, body.state.area())


def goes_on_after_saving(checks):
    for engines in ({}, {"integrator": "implicit", "dt": 2e-6}):
        pressed(disc, 2.0, **engines)
        end = 0.93 if engines else 0.9
        while O.bodies[2].state.pos[1] > end * SIDE:
            O.step()
        with Folder() as folder:
            path_of_scene = os.path.join(folder, "scene.xml.gz")
            O.save(path_of_scene, quiet=True)
            steps = 10 if engines else 200
            run(steps)
            soft = measures.softIntegrator()
            expected = arrays.points(O.bodies[0]), arrays.plasticStrains(O.bodies[0]), soft.plasticDissipation
            O.reset()
            O.load(path_of_scene, quiet=True)
            run(steps)
        name = "implicit" if engines else "explicit"
        strains = arrays.plasticStrains(O.bodies[0])
        checks.that(f"{name}: it has flowed", expected[1].max() > 0.05, expected[1].max())
        checks.close_to(f"{name}: places", abs(arrays.points(O.bodies[0]) - expected[0]).max(), 0, 1e-9 * SIDE)
        checks.close_to(f"{name}: plastic strains", abs(strains - expected[1]).max(), 0, 1e-9)
        checks.close_to(f"{name}: dissipation", measures.softIntegrator().plasticDissipation, expected[2], 1e-9 * expected[2])


def materials_changed_by_hand(checks):
    pressed(disc, 2.0)
    while O.bodies[2].state.pos[1] > 0.9 * SIDE:
        O.step()
    body = O.bodies[0]
    before = arrays.plasticStrains(body)
    body.material.yieldStress = 1000 * YIELD
    run(50)
    checks.that("a higher yield stress: no more flow", (arrays.plasticStrains(body) == before).all() and before.max() > 0)
    body.material.yieldStress = 0
    for attempt in range(2):
        checks.raises(f"yield stress 0, attempt {attempt}", (RuntimeError, ValueError), ["#0", "yieldStress = 0", "positive"],
                      O.step)
    body.material.yieldStress = YIELD
    drive((1, 2), 0)
    run(50)
    body.material = NeoHookeanMat(lambda_=LAMBDA, mu=MU)
    run(1)
    checks.that("another class: forgotten", (arrays.plasticStrains(body) == 0).all())


def several_grains_share_lanes(checks):
    """Nine discs of different sizes, apart, thrown at walls: each as alone."""
    found = {}
    for alone in (True, False):
        strains = []
        for group in ([[k] for k in range(3)] if alone else [range(9)]):
            O.reset()
            O.materials.append(metal())
            stone = O.materials.append(FrictMat(frictionAngle=0))
            for k in group:
                radius = (1 + 0.1 * k) * SIDE
                O.bodies.append(softDisc((5e-3 * k, radius * 1.001), radius, "metal", points=60, velocity=(0, -8 - k, 0)))
            O.bodies.append(wall(0, axis=1, sense=1, material=stone))
            O.engines = softEngines(dt=1e-7)
            run(1500)
            strains += [arrays.plasticStrains(body) for body in measures.softBodies()[:3]]
        found[alone] = numpy.array(strains)
    checks.that("they flow", found[True].max(axis=1).min() > 0.01, found[True].max(axis=1))
    difference = abs(found[True] - found[False]).max()
    checks.that("the same alone and among others", difference < 1e-6, difference)


def refused(checks):
    pressed(lambda: disc(formulation="updated"), 1.0)
    for attempt in range(2):
        checks.raises(f"updated, attempt {attempt}", (RuntimeError, ValueError), ["#0", "PlasticMat", "updated", "total"], O.step)


def examples(checks):
    with Folder() as folder:
        words = ["--material", "plastic", "--lambda", "2e6", "--mu", "1e6", "--yield-stress", "4e4", "--hardening", "2e5"]
        for name, more in (("explicit", []), ("quasistatic", ["--quasistatic"])):
            done = run_example(folder, "squeeze.py", "--quick", "--speed", "0.2", "--out", name, *words, *more)
            checks.that(f"squeeze, {name}", done.returncode == 0 and "finite elements" not in done.stdout, said(done))
        tables = [read_table(os.path.join(folder, name, "squeeze.csv")) for name in ("explicit", "quasistatic")]
        forces = [numpy.interp(numpy.arange(0.1, 0.18, 0.005), table["squeeze"], table["force_per_thickness_N_m"]).mean()
                  for table in tables]
        checks.close_to("the same force", forces[0], forces[1], 0.03 * forces[1])
        words += ["--grains", "10", "--points", "60", "--no-figures", "--until", "0.8", "--safety", "0.4"]
        for name, more in (("compaction", []), ("slow", ["--quasistatic"])):
            done = run_example(folder, "compaction.py", "--out", name, *words, *more)
            checks.that(name, done.returncode == 0, said(done))
            table = read_table(os.path.join(folder, name, "compaction.csv"))
            lost, work = table["plastic_dissipation_J"][-1], table["external_work_J"][-1]
            checks.that(f"{name}: a column of its own", 0.1 * work < lost < work, (lost, work))


run_tests(block_against_the_closed_form, a_disc_stays_flat, goes_on_after_saving, materials_changed_by_hand,
          several_grains_share_lanes, refused, examples)
