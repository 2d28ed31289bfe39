# SPDX-License-Identifier: GPL-2.0-or-later
"""Ogden grains inside the real yade: a block in a closing box and a disc between plates, explicit, implicit, quasi-static,
total and updated, against closed forms, each other and Neo-Hookean grains; saving; refusals; examples. (Stresses, tangents and
stable steps: tests/core, tests/verification.)"""
import math
import os
import sys

import numpy
from yade import O
from yade.utils import wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402
from softgrain import NeoHookeanMat, OgdenMat, arrays, measures, softDisc, softEngines, softPolygon  # noqa: E402
from softgrain.records import read_table  # noqa: E402

LAMBDA, TERMS, SIDE = 6e6, ((0.2e6, 8.0), (-0.3e6, -2.0)), 1e-3
QUASISTATIC = {"integrator": "implicit", "quasistatic": True, "dt": 1e-6}


def gel(**changed):
    mu, alpha = zip(*TERMS)
    return OgdenMat(**{"lambda_": LAMBDA, "mu": mu, "alpha": alpha, "label": "gel", **changed})


def cauchy(height):
    """Stress along a stretch, with none across [Pa]."""
    return (sum(mu * (height**alpha - 1) for mu, alpha in TERMS) + LAMBDA * math.log(height)) / height


def pressed(make, material=None, speed=1.0, box=False, **engines):
    """A grain between two walls that close on it along y, with two at its sides if it is in a box; the ids of the first."""
    O.reset()
    O.materials.append(material or gel())
    stone = O.materials.append(FrictMat(frictionAngle=0))
    O.bodies.append(make())
    walls = [O.bodies.append(wall(side * SIDE, axis=1, sense=-side, material=stone)) for side in (-1, 1)]
    if box:
        for side in (-1, 1):
            O.bodies.append(wall(side * SIDE, axis=0, sense=-side, material=stone))
    for side, body in zip((-1, 1), walls):
        O.bodies[body].state.vel = (0, -side * speed, 0)
    O.engines = softEngines(**engines)
    return walls


def until(walls, height):
    while O.bodies[walls[1]].state.pos[1] > height * SIDE:
        O.step()


def block():
    return softPolygon([(x * SIDE, y * SIDE) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], "gel", points=64)


def disc(formulation="total"):
    return softDisc((0, 0), SIDE, "gel", points=124, formulation=formulation)


def block_against_the_closed_form(checks):
    walls = pressed(block, box=True, **QUASISTATIC)
    for end in (0.9, 0.8, 0.7):
        until(walls, end)
        # the walls' recovery leaves gaps and penetrations of some 1e-5 radii, at the modulus of lambda
        found = O.bodies[walls[1]].state.pos[1] / SIDE
        stress = O.forces.f(walls[1])[1] / (2 * SIDE)
        checks.close_to(f"stress at {end}", -stress, cauchy(found), 2e-3 * abs(cauchy(found)))


def force_of_the_disc(checks, name, **kind):
    formulation = kind.pop("formulation", "total")
    walls = pressed(lambda: disc(formulation), speed=0.5, **kind)
    until(walls, 0.81)
    forces = []
    while O.bodies[walls[1]].state.pos[1] > 0.79 * SIDE:
        O.step()
        forces.append(abs(O.forces.f(walls[0])[1]) + abs(O.forces.f(walls[1])[1]))
    soft = measures.softIntegrator()
    stored = soft.elasticEnergy() + soft.kineticEnergy() + soft.contactDissipation + getattr(soft, "numericalDissipation", 0.0)
    checks.that(f"{name}: energy balance", abs(stored / soft.externalWork - 1) < 1e-2, stored / soft.externalWork - 1)
    return numpy.mean(forces) / 2


def every_scheme_gives_the_same_force(checks):
    expected = force_of_the_disc(checks, "quasi-static", **QUASISTATIC)
    for name, bound, kind in (("explicit", 0.02, {}), ("implicit", 0.02, {"integrator": "implicit", "dt": 1e-6}),
                              ("updated", 0.04, {"formulation": "updated"})):
        force = force_of_the_disc(checks, name, **kind)
        checks.close_to(f"{name}: force", force, expected, bound * expected)


def exponent_two_is_neo_hookean(checks):
    places = []
    for material in (OgdenMat(lambda_=LAMBDA, mu=[0.8e6], alpha=[2], label="gel"),
                     NeoHookeanMat(lambda_=LAMBDA, mu=0.8e6, label="gel")):
        pressed(disc, material, dt=2e-7)
        for _ in range(300):
            O.step()
        places.append(arrays.points(O.bodies[0]))
    checks.close_to("places of points", abs(places[0] - places[1]).max(), 0, 1e-9 * SIDE)


def goes_on_after_saving(checks):
    for engines in ({}, {"integrator": "implicit", "dt": 2e-6}):
        walls = pressed(disc, speed=2.0, **engines)
        until(walls, 0.95)
        with Folder() as folder:
            path = os.path.join(folder, "scene.xml.gz")
            O.save(path, quiet=True)
            expected = []
            for loaded in (False, True):
                if loaded:
                    O.reset()
                    O.load(path, quiet=True)
                for _ in range(10 if engines else 200):
                    O.step()
                expected.append(arrays.points(O.bodies[0]))
        checks.close_to("places", abs(expected[0] - expected[1]).max(), 0, 1e-9 * SIDE)
        checks.that("constants", tuple(O.bodies[0].material.alpha) == (8, -2))


def refused(checks):
    for name, material, words in (
            ("lengths", gel(mu=[1e6]), ["OgdenMat 'gel'", "1 numbers", "alpha 2", "as many"]),
            ("no terms", gel(mu=[], alpha=[]), ["one to three"]), ("four terms", gel(mu=[1] * 4, alpha=[2] * 4), ["one to three"]),
            ("exponent 0", gel(mu=[1e6], alpha=[0]), ["alpha[0] = 0", "leave its term out"]),
            ("soft", gel(mu=[1e6], alpha=[-2]), ["shear modulus", "-1e+06 Pa"])):
        pressed(disc, material)
        for attempt in range(2):
            checks.raises(f"{name}, attempt {attempt}", (RuntimeError, ValueError), ["#0", *words], O.step)


def examples(checks):
    with Folder() as folder:
        words = ["--material", "ogden", "--lambda", "6e6", "--mu", "1e6", "--alpha", "8"]
        done = run_example(folder, "squeeze.py", "--quick", "--speed", "0.5", "--out", "squeeze", *words)
        checks.that("squeeze.py", done.returncode == 0 and "finite elements" not in done.stdout, said(done))
        done = run_example(folder, "compaction.py", "--grains", "10", "--points", "60", "--no-figures", "--until", "0.8",
                           "--safety", "0.4", "--out", "compaction", *words)
        checks.that("compaction.py", done.returncode == 0, said(done))
        table = read_table(os.path.join(folder, "compaction", "compaction.csv"))
        checks.that("energy balance", abs(table["energy_residual_J"][-1]) < 0.02 * table["external_work_J"][-1])
        done = run_example(folder, "squeeze.py", "--quick", "--out", "none", *words[:-1], "0")
        checks.that("exponent 0", done.returncode == 2 and "--alpha 0" in done.stderr, said(done))


run_tests(block_against_the_closed_form, every_scheme_gives_the_same_force, exponent_two_is_neo_hookean, goes_on_after_saving,
          refused, examples)
