# SPDX-License-Identifier: GPL-2.0-or-later
"""YADE's own tools on soft grains: what doc/yade_tools.md says of each of them holds."""
import math
import os
import sys

import numpy
from yade import O, pack, utils
from yade.minieigenHP import Vector3
from yade.pack import SpherePack
from yade.wrapper import ForceRecorder, FrictMat, UniaxialStrainer, VTKRecorder

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import (NeoHookeanMat, SoftBoxController, arrays, measures, rigidDisc, softBox, softCloud, softDisc,  # noqa: E402
                       softEngines, stresses)

R = 1e-3


def start(friction=0.0):
    O.reset()
    O.materials.append(NeoHookeanMat(frictionAngle=math.atan(friction), label="gel"))
    O.materials.append(FrictMat(frictionAngle=math.atan(friction), label="stone"))


def jammed():
    """Fifteen grains without friction at rest under 50 kPa; the controller of their box."""
    start()
    grains, height = softCloud(8e-3, 15, material="gel", points=60, seed=2)
    O.bodies.append(grains)
    walls = O.bodies.append(softBox(8e-3, height, "stone"))
    box = SoftBoxController(walls=walls, goal=(5e4, 5e4), stressMask=3, maxStrainRate=(20, 20), globUpdate=1,
                            maxUnbalanced=1e-3, doneHook="O.pause()")
    O.engines = softEngines(more=[box], integrator="implicit", quasistatic=True, dt=2e-4)
    O.run(200, True)
    return box


def run(steps):
    for _ in range(steps):
        O.step()


def motion(checks):
    start()
    O.bodies.append([softDisc((0, 0), R, "gel", points=60, velocity=(2, 0), spin=30), rigidDisc((0, 5 * R), R, "stone", velocity=(0, 3))])
    O.engines = softEngines()
    run(5)
    soft, stone = (body.state for body in O.bodies)
    whole = sum((s.mass * s.vel.squaredNorm() + s.inertia[2] * s.angVel[2]**2) / 2 for s in (soft, stone))
    checks.close_to("utils.kineticEnergy: translation and spin", utils.kineticEnergy() / whole, 1, 1e-9)
    checks.close_to("that of a grain's points holds it", soft.kineticEnergy() / ((soft.mass * 4 + soft.inertia[2] * 900) / 2), 1, 1e-3)
    checks.close_to("utils.momentum", (utils.momentum() - soft.mass * soft.vel - stone.mass * stone.vel).norm(), 0, 1e-15)
    x = soft.pos[0]
    utils.shiftBodies([0], Vector3(1, 0, 0))
    utils.setBodyVelocity(0, Vector3(7, 0, 0), "xyz")
    utils.calm(-1)
    run(1)
    checks.that("utils.shiftBodies, setBodyVelocity, calm leave soft grains alone",
                abs(soft.pos[0] - x) < 1e-5 and abs(soft.vel[0] - 2) < 1e-9, (soft.pos, soft.vel))
    soft.pos, soft.vel = (1, 0, 0), (7, 0, 0)
    run(1)
    checks.that("state.pos and state.vel do", abs(soft.pos[0] - 1) < 1e-4 and abs(soft.vel[0] - 7) < 1e-9, (soft.pos, soft.vel))


def forces(checks):
    box = jammed()
    checks.that("at rest", box.reached, (box.stress, box.currUnbalanced))
    grains = [body.id for body in measures.softBodies()]
    checks.that("O.forces holds no contact forces of soft grains", all(O.forces.f(i).norm() == 0 for i in grains))
    checks.that("so utils.unbalancedForce is 0 whatever they do", utils.unbalancedForce() == 0)
    checks.that("stresses.unbalancedForce sees them", 0 < stresses.unbalancedForce() < 2e-3, stresses.unbalancedForce())
    right = O.forces.f(box.walls[1])[0]
    checks.close_to("utils.sumForces", utils.sumForces([box.walls[1]], Vector3(1, 0, 0)) / right, 1, 1e-12)
    middle = (O.bodies[box.walls[0]].state.pos[0] + O.bodies[box.walls[1]].state.pos[0]) / 2
    checks.close_to("utils.forcesOnCoordPlane", abs(utils.forcesOnCoordPlane(middle, 0)[0]) / right, 1, 0.01)
    contacts = measures.contactPairs()
    interactions = {(i.id1, i.id2): i for i in O.interactions if i.isReal and i.phys.normalForce.norm() > 0}
    checks.that("O.interactions", sorted(interactions) == sorted(contacts))
    checks.that("body.intrs()", {(i.id1, i.id2) for i in O.bodies[3].intrs() if i.phys.normalForce.norm() > 0}
                == {pair for pair in contacts if 3 in pair})


def stress_functions(checks):
    box = jammed()
    tensor = stresses.ofPackingByContacts(box.boxArea)
    of_yade = numpy.array(utils.getStress(box.boxArea)).reshape(3, 3)
    checks.close_to("utils.getStress(area): along x", of_yade[0, 0] / tensor[0, 0], 1, 0.005)
    checks.close_to("utils.getStress(area): along y", of_yade[1, 1] / tensor[1, 1], 1, 0.005)
    per_body = utils.bodyStressTensors()
    for grain in measures.softBodies():
        radius = math.sqrt(grain.shape.area() / math.pi)
        # per ball of that radius, where the disc of unit thickness is meant; one contact point a pair, where contacts are long
        found = numpy.array(per_body[grain.id]).reshape(3, 3)[:2, :2] * 4 / 3 * radius
        expected = stresses.ofGrainByContacts(grain) * grain.state.area() / grain.shape.area()
        checks.close_to(f"utils.bodyStressTensors, grain {grain.id}", numpy.linalg.norm(found - expected), 0, 0.1 * numpy.linalg.norm(tensor))
    angles, sizes = utils.interactionAnglesHistogram(2)
    real = [i for i in O.interactions if i.isReal and i.phys.normalForce.norm() > 0]
    checks.close_to("utils.interactionAnglesHistogram counts contacts with force", sum(sizes), len(real), 1e-9)
    checks.that("utils.bodyNumInteractionsHistogram counts near bodies too",
                sum(n * count for n, count in zip(*utils.bodyNumInteractionsHistogram(()))) >= 2 * len(real))
    checks.that("utils.porosity knows spheres alone", utils.porosity(box.boxArea) == 1)
    checks.that("measures.solidFraction means something", 0.7 < measures.solidFraction(box.boxArea) < 1)


def strained(checks):
    start()
    O.bodies.append(softDisc((0, 0), R, "gel", points=60))
    O.bodies.append([utils.wall(x * R, axis=0, material="stone") for x in (-1.001, 1.001)])
    strainer = UniaxialStrainer(strainRate=-100, axis=0, posIds=[2], negIds=[1], crossSectionArea=2 * R, blockDisplacements=True,
                                blockRotations=True, stressUpdateInterval=1)
    O.engines = softEngines(more=[strainer])
    while strainer.strain > -0.2:
        O.step()
    length = O.bodies[2].state.pos[0] - O.bodies[1].state.pos[0]
    checks.close_to("UniaxialStrainer on walls: strain", strainer.strain, length / (2.002 * R) - 1, 1e-9)
    force = (O.forces.f(1)[0] - O.forces.f(2)[0]) / 2
    checks.close_to("and stress", strainer.avgStress, force / (2 * R), 1e-9 * abs(force / (2 * R)))
    checks.that("compression is negative", strainer.avgStress < -5e4, strainer.avgStress)


def masks(checks):
    for mask, meets in ((1, True), (2, False)):
        start()
        O.bodies.append([softDisc((0, 0), R, "gel", points=60, velocity=(2, 0)), softDisc((2.01 * R, 0), R, "gel", points=60)])
        O.bodies[1].groupMask = mask
        O.engines = softEngines()
        run(700)
        checks.that(f"groupMask {mask}", (O.bodies[1].state.vel[0] > 0.1) == meets and abs(O.bodies[0].state.vel[0] - 2) < (2 if meets else 1e-9),
                    (O.bodies[0].state.vel, O.bodies[1].state.vel))
    start()
    O.bodies.append([softDisc((0, 0), R, "gel", points=60, velocity=(2, 0)), softDisc((2.01 * R, 0), R, "gel", points=60)])
    for body in O.bodies:
        body.groupMask = 3
    O.engines = softEngines()
    O.engines[1].avoidSelfInteractionMask = 2
    run(700)
    checks.that("avoidSelfInteractionMask", O.bodies[1].state.vel.norm() == 0, O.bodies[1].state.vel)
    checks.that("NewtonIntegrator.mask leaves soft grains moving", moves_past_mask())
    checks.that("groups by ids: O.bodies.append(list)", O.bodies.append([softDisc((9 * R, 0), R, "gel", points=60)]) == [1])


def moves_past_mask():
    start()
    O.bodies.append(softDisc((0, 0), R, "gel", points=60, velocity=(2, 0)))
    O.engines = softEngines()
    O.engines[-2].mask = 4
    run(10)
    return O.bodies[0].state.pos[0] > 1e-6


def packs(checks):
    start()
    cloud = SpherePack()
    cloud.makeCloud(minCorner=(0, 0, 0), maxCorner=(10e-3, 10e-3, 0), rMean=0.8e-3, rRelFuzz=0.3, num=15, seed=1)
    O.bodies.append([softDisc(centre, radius, "gel", points=60) for centre, radius in cloud])
    hexagons = pack.regularHexa(pack.inAlignedBox((20e-3, 0, -5 * R), (30e-3, 8e-3, 5 * R)) - pack.inSphere((25e-3, 4e-3, 0), 2e-3), R, 1e-5)
    flat = [body for body in hexagons if abs(body.state.pos[2] - hexagons[0].state.pos[2]) < 1e-9]
    O.bodies.append([softDisc((body.state.pos[0], body.state.pos[1], 0), body.shape.radius, "gel", points=60) for body in flat])
    checks.that("makeCloud", sum(body.state.pos[0] < 11e-3 for body in O.bodies) == len(cloud) > 10, len(cloud))
    checks.that("predicates", 5 < len(flat) < 40 and not any((body.state.pos - Vector3(25e-3, 4e-3, 0)).norm() < 2e-3 for body in O.bodies), len(flat))
    O.engines = softEngines()
    run(50)
    checks.that("nothing overlaps", measures.softIntegrator().contactCount == 0)
    inside = pack.inAlignedBox((0, 0, -1), (10e-3, 10e-3, 1))
    where = arrays.points(O.bodies[0])
    checks.that("a predicate tells of material points", all(inside((x, y, 0), 0) for x, y in where))


def others(checks):
    start()
    O.bodies.append([softDisc((x * R, 0), R, "gel", points=60) for x in (0, 1.999)])
    with Folder() as folder:
        O.engines = softEngines(more=[VTKRecorder(fileName=folder + "/shot-", recorders=["spheres", "facets", "boxes", "velocity"], iterPeriod=1),
                                      ForceRecorder(ids=[0], file=folder + "/force.txt", iterPeriod=1)])
        run(3)
        checks.that("VTKRecorder and ForceRecorder run", len(os.listdir(folder)) > 3, os.listdir(folder))
        O.engines = softEngines()
    checks.that("utils.fabricTensor finds no spheres", numpy.isnan(numpy.array(utils.fabricTensor()[0])).all())
    utils.growParticles(2)
    run(1)
    checks.that("utils.growParticles leaves soft grains alone", O.bodies[0].shape.radius == R)
    checks.raises("utils.normalShearStressTensors", RuntimeError, [], lambda: sentence(utils.normalShearStressTensors))


def sentence(work):
    """YADE's messages end as they like."""
    try:
        work()
    except RuntimeError as error:
        raise RuntimeError(str(error).rstrip(".") + ".") from None


def erased(checks):
    box = jammed()
    count = len(O.bodies)
    O.bodies.erase(3)
    O.run(5, True)
    checks.that("O.bodies.erase", O.bodies[3] is None and len(measures.softBodies()) == count - 5)
    checks.that("the box goes on", stresses.ofPacking(box.boxArea)[0, 0] < 0)
    checks.that("and no force of it stays", not (stresses.contactPoints().ids == 3).any())


run_tests(motion, forces, stress_functions, strained, masks, packs, others,
          erased)
