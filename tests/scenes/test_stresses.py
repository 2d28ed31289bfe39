# SPDX-License-Identifier: GPL-2.0-or-later
"""Stress tensors of grains and packings, and force chains, against the divergence theorem and forces on walls."""
import math
import os
import sys

import numpy
from yade import O
from yade.utils import sphere
from yade.wrapper import (FrictMat, Ig2_Sphere_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom, Ip2_FrictMat_FrictMat_FrictPhys,
                          Law2_ScGeom_FrictPhys_CundallStrack)

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import (InputError, NeoHookeanMat, SoftBoxController, discCloud, measures, rigidContacts, rigidDisc,  # noqa: E402
                       softBox, softDisc, softEngines, stresses)

WIDTH = 8e-3


def packing(friction, goal, rigid=0, engines=None, **options):
    """Fifteen grains at rest in a box under a stress [Pa], the first `rigid` of them rigid; the controller of the box."""
    O.reset()
    angle = math.atan(friction)
    O.materials.append(NeoHookeanMat(frictionAngle=angle, label="gel"))
    O.materials.append(FrictMat(frictionAngle=angle, young=1e8, density=1000, label="stone"))
    radii, places, angles, height = discCloud(WIDTH, 15, (1.4e-3, 2.4e-3), 0.65, 2)
    for number, (radius, place, angle) in enumerate(zip(radii, places, angles)):
        O.bodies.append(rigidDisc(place, radius, "stone") if number < rigid else
                        softDisc(place, radius, "gel", points=60, angle=angle))
    walls = O.bodies.append(softBox(WIDTH, height, "stone"))
    box = SoftBoxController(walls=walls, goal=(goal, goal), stressMask=3, maxStrainRate=(20, 20), doneHook="O.pause()", **options)
    O.engines = softEngines(more=[box], **(engines or dict(integrator="implicit", quasistatic=True, dt=2e-4)))
    O.run(60000 if engines else 200, True)
    return box


def apart(one, other):
    return numpy.linalg.norm(one - other) / numpy.linalg.norm(other)


def packings_at_rest(checks):
    for friction, goal in ((0.0, 2e4), (0.3, 2e4), (0.3, 1e6)):
        box = packing(friction, goal, globUpdate=1, maxUnbalanced=1e-3)
        checks.that("at rest", box.reached, (box.stress, box.currUnbalanced))
        of_points, of_contacts = stresses.ofPacking(box.boxArea), stresses.ofPackingByContacts(box.boxArea)
        of_walls = stresses.ofWalls(*box.walls)
        what = f"friction {friction:g}, {goal:g} Pa: "
        checks.close_to(what + "points as contacts", apart(of_points[:2, :2], of_contacts), 0, 0.01)
        checks.close_to(what + "contacts as walls", apart(of_contacts, of_walls), 0, 0.002)
        checks.close_to(what + "symmetric", abs(of_contacts[0, 1] - of_contacts[1, 0]) / abs(numpy.trace(of_contacts)), 0, 0.001)
        checks.that(what + "compression is negative", of_points[0, 0] < 0 > of_points[1, 1] and of_points[2, 2] < 0, of_points)
        # the forces of O.forces over the sides: without friction on the walls nothing else counts
        if friction == 0:
            for axis in range(2):
                low, high = (O.forces.f(wall)[axis] for wall in box.walls[2 * axis:2 * axis + 2])
                across = box.boxArea / (O.bodies[box.walls[2 * axis + 1]].state.pos[axis] - O.bodies[box.walls[2 * axis]].state.pos[axis])
                checks.close_to(what + "force on a wall over its side", -high / across / of_contacts[axis, axis], 1, 0.005)
                checks.close_to(what + "opposite walls", (low + high) / high, 0, 0.005)
        for body in measures.softBodies():
            of_grain = stresses.ofGrain(body)[:2, :2]
            checks.close_to(f"{what}grain {body.id}", numpy.linalg.norm(of_grain - stresses.ofGrainByContacts(body)),
                            0, 0.015 * numpy.linalg.norm(of_contacts))
        total = sum(stresses.ofGrain(body) * body.state.area() for body in measures.softBodies()) / box.boxArea
        checks.close_to(what + "a packing is the sum of its grains", apart(total, of_points), 0, 2e-3)


def a_pressed_disc(checks):
    # a disc that bears the force P between plates at a distance h: the mean stress is -P h / area across the plates, 0 along them
    O.reset()
    O.materials.append([NeoHookeanMat(), FrictMat(frictionAngle=0)])
    O.bodies.append(softDisc((0.5, 1e-3), 1e-3, 0, points=124))
    walls = O.bodies.append(softBox(1, 2e-3, 1))
    O.engines = softEngines(integrator="implicit", quasistatic=True, dt=1e-4)
    O.bodies[walls[3]].state.vel = (0, -0.6, 0)
    O.run(10, True)
    grain, height, force = O.bodies[0], O.bodies[walls[3]].state.pos[1], O.forces.f(walls[3])[1]
    expected = -force * height / grain.state.area()
    for name, stress in (("points", stresses.ofGrain(grain)), ("contacts", stresses.ofGrainByContacts(grain))):
        checks.close_to(f"{name}: across", stress[1, 1] / expected, 1, 0.005)
        checks.close_to(f"{name}: along", stress[0, 0] / expected, 0, 0.005)
        checks.close_to(f"{name}: shear", stress[0, 1] / expected, 0, 0.005)


def mixtures(checks):
    own = [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ip2_FrictMat_FrictMat_FrictPhys(),
           Law2_ScGeom_FrictPhys_CundallStrack()]
    for name, law in (("Contact Dynamics", rigidContacts()), ("YADE's law", own)):
        box = packing(0.3, 1e5, 7, dict(functors=law), maxUnbalanced=0.01)
        checks.that("at rest", box.reached, (box.stress, box.currUnbalanced))
        means = numpy.zeros((3, 2, 2))
        for _ in range(1000):
            O.step()
            means += [stresses.ofPacking(box.boxArea)[:2, :2], stresses.ofPackingByContacts(box.boxArea), stresses.ofWalls(*box.walls)]
        of_points, of_contacts, of_walls = means / 1000
        checks.close_to(f"{name}: points as contacts", apart(of_points, of_contacts), 0, 0.01)
        checks.close_to(f"{name}: contacts as walls", apart(of_contacts, of_walls), 0, 0.01)
        checks.close_to(f"{name}: symmetric", abs(of_contacts[0, 1] - of_contacts[1, 0]) / abs(numpy.trace(of_contacts)), 0, 0.01)
        for body in O.bodies:
            if body.id < 7:
                rigid = stresses.ofGrainByContacts(body)
                checks.that(f"{name}: rigid grain {body.id} is pressed or loose", numpy.trace(rigid) <= 0, rigid)


def chains(checks):
    box = packing(0.3, 1e5, globUpdate=1, maxUnbalanced=1e-3)
    points, pairs, strong = stresses.contactPoints(), stresses.forceChains(0), stresses.forceChains()
    known = {contact[:2]: contact[2:] for contact in measures.softIntegrator().contacts()}
    checks.that("the pairs of contacts()", sorted(map(tuple, pairs.ids.tolist())) == sorted(known))
    for (one, two), place, normal, force in zip(pairs.ids.tolist(), *pairs[1:]):
        expected = known[one, two]
        checks.that(f"{one}-{two}", all(numpy.allclose(found, list(vector)[:2], rtol=1e-9, atol=1e-9 * numpy.linalg.norm(found))
                                        for found, vector in zip((place, normal, force), expected)), (place, normal, force, expected))
        geom = O.interactions[one, two].geom
        checks.that("and YADE's geom has them", numpy.allclose(list(geom.normal)[:2], normal) and numpy.allclose(list(geom.contactPoint)[:2], place))
    normal = numpy.sum(pairs.forces * pairs.normals, axis=1)
    checks.that("falling order, compression positive", (numpy.diff(normal) <= 0).all() and (normal > 0).all())
    checks.that("Coulomb", (abs(pairs.forces[:, 0] * pairs.normals[:, 1] - pairs.forces[:, 1] * pairs.normals[:, 0]) <= 0.31 * normal).all())
    checks.that("the strong bear more than the mean", len(strong.ids) == (normal >= normal.mean()).sum() and 0 < len(strong.ids) < len(pairs.ids))
    checks.that("rows of a pair lie on its normal's sides", len(points.ids) > len(pairs.ids))
    for grain in measures.softBodies():
        total = pairs.forces[pairs.ids[:, 1] == grain.id].sum(axis=0) - pairs.forces[pairs.ids[:, 0] == grain.id].sum(axis=0)
        checks.close_to(f"forces on grain {grain.id} are balanced", numpy.linalg.norm(total), 0, 5e-3 * normal.mean())
    checks.close_to("unbalanced force", stresses.unbalancedForce(), 0, 2e-3)
    checks.that("at rest", box.currUnbalanced < 1e-3, box.currUnbalanced)


def falling(checks):
    O.reset()
    O.materials.append([NeoHookeanMat(), FrictMat(frictionAngle=0.1)])
    O.bodies.append([softDisc((x, 0), 1e-3, 0, points=60) for x in (-1.001e-3, 1.001e-3)])
    for body in O.bodies:
        body.state.vel = (-300 * body.state.pos[0], 0, 0)
    O.engines = softEngines(gravity=(0, -10, 0))
    O.run(15, True)
    points = stresses.forceChains(0)
    weight = O.bodies[0].state.mass * 10
    push = numpy.linalg.norm(points.forces)
    checks.close_to("weights and the push between them", stresses.unbalancedForce(), math.hypot(weight, push) / push, 1e-8)


def refusals(checks):
    packing(0.3, 1e4, globUpdate=1)
    wall, ball = O.bodies[15], O.bodies[O.bodies.append(sphere((1, 1, 0), 1e-3, material="stone", fixed=True))]
    for words, work in ((["#15", "Wall"], lambda: stresses.ofGrain(wall)), (["#15", "Wall"], lambda: stresses.ofGrainByContacts(wall)),
                        (["#19", "Sphere"], lambda: stresses.ofGrain(ball)), (["boxArea", "0"], lambda: stresses.ofPacking(0)),
                        (["boxArea", "-1"], lambda: stresses.ofPackingByContacts(-1)), (["share", "-1"], lambda: stresses.forceChains(-1)),
                        (["#0", "Wall"], lambda: stresses.ofWalls(0, 1, 2, 3)), (["#77"], lambda: stresses.ofWalls(15, 16, 17, 77))):
        checks.raises(" ".join(words), InputError, words, work)
    O.engines = []
    checks.raises("no integrator", InputError, ["SoftIntegrator"], stresses.contactPoints)


run_tests(packings_at_rest, a_pressed_disc, mixtures, chains, falling, refusals)
