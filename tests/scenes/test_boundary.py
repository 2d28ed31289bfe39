# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls and boxes that follow stresses and strains: SoftWallController, SoftBoxController."""
import builtins
import math
import os
import sys

import numpy
from yade import O
from yade.wrapper import (Body, FrictMat, Ig2_Sphere_Sphere_ScGeom, Ig2_Wall_Sphere_ScGeom, Ip2_FrictMat_FrictMat_FrictPhys,
                          Law2_ScGeom_FrictPhys_CundallStrack)

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import (NeoHookeanMat, SoftBoundaryController, SoftBoxController, SoftWallController, discCloud,  # noqa: E402
                       measures, rigidContacts, rigidDisc, softBox, softDisc, softEngines)

WIDTH, R = 8e-3, 1e-3


def packing(friction=0.2, rigid=0, count=15, law=None, engines=None, **options):
    """A cloud whose first `rigid` grains are rigid, in a box that a SoftBoxController moves; that."""
    O.reset()
    angle = math.atan(friction)
    O.materials.append(NeoHookeanMat(frictionAngle=angle, label="gel"))
    O.materials.append(FrictMat(frictionAngle=angle, young=1e8, density=1000, label="stone"))
    radii, places, angles, height = discCloud(WIDTH, count, (1.4e-3, 2.4e-3), 0.65, 2)
    for number, (radius, place, angle) in enumerate(zip(radii, places, angles)):
        O.bodies.append(rigidDisc(place, radius, "stone") if number < rigid else
                        softDisc(place, radius, "gel", points=60, angle=angle))
    walls = O.bodies.append(softBox(WIDTH, height, "stone"))
    box = SoftBoxController(walls=walls, doneHook="O.pause()", **options)
    O.engines = softEngines(more=[box], functors=law or (), **(engines or {}))
    return box


def steps(count):
    """One by one: an error in O.run(count, True) is lost where it comes before YADE waits."""
    for _ in range(count):
        O.step()


def go(box, most=60000):
    """Until the goals are reached; whether they were."""
    O.run(most, True)
    return box.reached


def sides(box):
    return [O.bodies[high].state.pos[axis] - O.bodies[low].state.pos[axis]
            for axis, (low, high) in enumerate((box.walls[:2], box.walls[2:]))]


def held(box, steps=4000):
    """Mean stresses on the walls that move, over further steps, from O.forces [Pa]."""
    sums = numpy.zeros(2)
    for _ in range(steps):
        O.step()
        lengths = sides(box)
        sums += [O.forces.f(box.walls[1])[0] / lengths[1], O.forces.f(box.walls[3])[1] / lengths[0]]
    return sums / steps


def stress_after(box, steps):
    O.run(steps, True)
    return list(box.wallStress)


def isotropic(checks):
    for friction, goal in ((0.0, 1e5), (0.5, 1e4), (0.2, 1e6)):
        box = packing(friction, goal=(goal, goal), stressMask=3, maxStrainRate=(50, 50))
        checks.that("the goal is reached", go(box), (box.stress, box.currUnbalanced))
        soft = measures.softIntegrator()
        for axis, stress in enumerate(held(box)):
            checks.close_to(f"{goal:g} Pa are held along {'xy'[axis]}", stress / goal, 1, 0.005)
        checks.close_to("work of the walls is all work on the grains", box.externalWork / soft.externalWork, 1, 1e-3)
        checks.close_to("energy balance", (measures.heldOrLost(soft) - soft.externalWork) / soft.externalWork, 0, 1e-3)
        checks.close_to("area of the box", box.boxArea / (sides(box)[0] * sides(box)[1]), 1, 1e-3)


def jammed(checks):
    # from loose to far beyond jamming and back, with walls as fast as they may be: stress grows a thousandfold in strains of 0.3
    box = packing(goal=(1e4, 1e4), stressMask=3, maxStrainRate=(100, 100), maxUnbalanced=0.02)
    strains = []
    for goal in (1e4, 1e6, 5e6, 1e5, 1e6):
        box.goal = (goal, goal)
        checks.that(f"{goal:g} Pa are reached", go(box, 40000), (box.stress, box.currUnbalanced))
        checks.that("in the mean of the window", all(abs(s / goal - 1) <= box.relStressTol for s in box.stress), box.stress)
        strains.append(sum(box.strain))
    checks.that("strains grow and fall with stress", strains[0] < strains[1] < strains[2] > strains[3] < strains[4], strains)
    soft = measures.softIntegrator()
    checks.close_to("energy balance", (measures.heldOrLost(soft) - soft.externalWork) / soft.externalWork, 0, 1e-3)


def quasistatic(checks):
    for friction, goal in ((0.0, 1e4), (0.2, 1e6)):
        box = packing(friction, goal=(goal, goal), stressMask=3, maxStrainRate=(20, 20), globUpdate=1,
                      engines=dict(integrator="implicit", quasistatic=True, dt=2e-4))
        checks.that("implicit: reached", go(box, 300), (box.stress, box.currUnbalanced))
        for axis, stress in enumerate(held(box, 5)):
            checks.close_to(f"implicit: {goal:g} Pa along {'xy'[axis]}", stress / goal, 1, 0.01)
        soft = measures.softIntegrator()
        checks.close_to("implicit: work", box.externalWork / soft.externalWork, 1, 1e-6)


def strain_path(checks):
    box = packing(goal=(2e4, math.inf), stressMask=1, maxStrainRate=(200, 20))
    O.run(10, True)
    start, begin = box.strain[1], O.time
    worst = 0
    while box.strain[1] < 0.25:
        O.run(500, True)
        if box.strain[1] < 0.25:
            worst = max(worst, abs(box.strain[1] - start - 20 * (O.time - begin)))
    checks.that("the strain along y grows as its rate says", worst < 1e-4 * 0.25, worst)
    stresses = []
    while box.strain[1] < 0.35:
        O.run(100, True)
        stresses.append(list(box.stress))
    along_x, along_y = numpy.mean(stresses, axis=0)
    checks.close_to("while the stress along x is held", along_x / 2e4, 1, 0.05)
    checks.that("and that along y is larger", along_y > 1.2 * 2e4, along_y)
    checks.that("x opens", box.strain[0] < 0.15, box.strain)


def strain_goal(checks):
    box = packing(goal=(0, 0.2), maxStrainRate=(50, 50), maxUnbalanced=math.inf)
    checks.that("reached", go(box))
    width, height = sides(box)
    checks.close_to("uniaxial: height", height, box.initialLength[1] * math.exp(-0.2), 1e-6 * height)
    checks.close_to("uniaxial: width", width, WIDTH, 1e-12)
    box.goal = (0, 0.1)
    checks.that("and back", go(box) and abs(box.strain[1] - 0.1) < 1e-6, box.strain)


def symmetric(checks):
    for mask, goal in ((0, (0.1, 0.15)), (3, (1e5, 1e5))):
        box = packing(0.0, goal=goal, stressMask=mask, maxStrainRate=(50, 50), symmetric=True, maxUnbalanced=0.05 if mask else math.inf)
        before = [O.bodies[wall].state.pos[axis] for wall, axis in zip(box.walls, (0, 0, 1, 1))]
        checks.that("reached", go(box), (box.stress, box.strain, box.currUnbalanced))
        ways = [O.bodies[wall].state.pos[axis] - x for wall, axis, x in zip(box.walls, (0, 0, 1, 1), before)]
        checks.that("all walls move in", ways[0] > 0 > ways[1] and ways[2] > 0 > ways[3], ways)
        if mask == 0:
            checks.close_to("alike", ways[0] + ways[1], 0, 1e-12)
        else:
            means = numpy.mean([stress_after(box, 100) for _ in range(40)], axis=0)
            checks.that("and all bear the stress", all(abs(s / 1e5 - 1) < 0.02 for s in means), means)


def wall_on_a_disc(checks):
    # README: a disc of R = 1 mm bears 1107.8 N/m at 20 % squeeze between frictionless plates (finite elements)
    for engines, steps in (({}, 40000), (dict(integrator="implicit", quasistatic=True, dt=1e-4), 100)):
        O.reset()
        O.materials.append(NeoHookeanMat(label="gel"))
        O.materials.append(FrictMat(frictionAngle=0))
        O.bodies.append(softDisc((0.5, R), R, "gel"))
        walls = O.bodies.append(softBox(1, 2.001 * R, 1))
        press = SoftWallController(wall=walls[3], goal=1107.8 / R, length=R, maxVelocity=1, doneHook="O.pause()",
                                   globUpdate=1 if engines else 100)
        O.engines = softEngines(more=[press], **engines)
        O.run(steps, True)
        checks.that("reached", press.reached, (press.stress, press.currUnbalanced))
        heights = []
        for _ in range(steps // 20):
            O.step()
            heights.append(O.bodies[walls[3]].state.pos[1] / (2 * R))
        checks.close_to("squeeze", 1 - numpy.mean(heights), 0.2, 0.002)
        checks.close_to("the wall below bears as much", numpy.mean(-O.forces.f(walls[2])[1]), 1107.8, 0.02 * 1107.8)


def with_weight(checks):
    box = packing(0.0, goal=(1e4, 1e4), stressMask=3, maxStrainRate=(50, 50), maxUnbalanced=0.05,   # chaos decides when it falls below 0.01
                  engines=dict(gravity=(0, -20, 0)))
    checks.that("reached", go(box), (box.stress, box.currUnbalanced))
    mean = held(box)
    checks.close_to("the wall's own weight does not count", mean[1] / 1e4, 1, 0.02)


def beside_rigid_grains(checks):
    own = [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom(), Ip2_FrictMat_FrictMat_FrictPhys(),
           Law2_ScGeom_FrictPhys_CundallStrack()]
    for name, law, rigid, engines in (("Contact Dynamics", rigidContacts(), 7, {}), ("YADE's law", own, 7, {}),
                                      ("all rigid", rigidContacts(), 15, dict(dt=2e-6))):
        box = packing(0.2, rigid, goal=(2e4, 2e4), stressMask=3, maxStrainRate=(50, 50), law=law, engines=engines,
                      maxUnbalanced=0.05)
        checks.that(f"{name}: reached", go(box), (box.stress, box.currUnbalanced))
        for axis, stress in enumerate(held(box)):
            checks.close_to(f"{name}: stress along {'xy'[axis]}", stress / 2e4, 1, 0.03)


def hook(checks):
    builtins.calls = []
    box = packing(goal=(0.01, 0.01), maxStrainRate=(50, 50))
    box.doneHook = "calls.append(O.iter)"
    O.run(1500, True)
    checks.that("doneHook runs once", len(builtins.calls) == 1, builtins.calls)
    box.goal = (0.02, 0.02)
    O.run(1500, True)
    checks.that("and again for another goal", len(builtins.calls) == 2, builtins.calls)
    box.goal, box.doneHook = (0.03, 0.03), "nothing_of_that_name()"
    checks.raises("a hook that fails", RuntimeError, ["doneHook", "nothing_of_that_name"], lambda: steps(1500))


def saved(checks):
    def final(box):
        return numpy.concatenate([sides(box), box.stress, box.wallStress, box.strain, [box.externalWork * 1e3, box.currUnbalanced]])

    for engines, steps in (({}, 730), (dict(integrator="implicit", quasistatic=True, dt=2e-4), 21)):
        box = packing(goal=(2e4, 0.3), stressMask=1, maxStrainRate=(30, 30), globUpdate=100 if not engines else 3,
                      engines=engines)
        with Folder() as folder:
            O.run(3 * steps, True)
            O.save(os.path.join(folder, "box.xml"), quiet=True)
            O.run(steps, True)
            expected = final(box)
            O.load(os.path.join(folder, "box.xml"), quiet=True)
            O.run(steps, True)
            found = final(O.engines[-1])
        checks.that("has borne stress", expected[2] > 1e3, expected)
        checks.that("goes on when loaded", numpy.allclose(found, expected, rtol=1e-6), abs(found / expected - 1).max())


def refusals(checks):
    def complaint(words, step=None, **options):
        def work():
            box = packing(**{"goal": (1e4, 1e4), "stressMask": 3, "maxStrainRate": (50, 50), **options})
            if step:
                step(box)
            steps(3)
        checks.raises(" ".join(words), RuntimeError, words, work)

    complaint(["SoftBoxController", "goal along x", "-10000", "compression"], goal=(-1e4, 1e4))
    complaint(["goal along y", "strain"], goal=(1e4, math.nan), stressMask=1)
    complaint(["maxStrainRate along x", "0"], maxStrainRate=(0, 1))
    complaint(["maxStrainRate along y", "0"], maxStrainRate=(1, 0))
    complaint(["stressMask", "4"], stressMask=4)
    complaint(["mass", "-1"], mass=-1)
    complaint(["globUpdate", "0"], globUpdate=0)
    complaint(["walls", "3"], lambda box: setattr(box, "walls", box.walls[:3]))
    complaint(["body #99"], lambda box: setattr(box, "walls", [99, 1, 2, 3]))
    complaint(["body #0", "SoftGrain", "Wall normal to x"], lambda box: setattr(box, "walls", [0, 1, 2, 3]))
    complaint(["body #17", "axis = 1", "normal to x"], lambda box: setattr(box, "walls", [17, 16, 15, 18]))
    complaint(["body #19", "without shape", "Wall normal to x"],
              lambda box: setattr(box, "walls", [O.bodies.append(Body()), 16, 17, 18]))
    complaint(["no grain that moves", "mass"], lambda box: [setattr(body, "dynamic", False) for body in measures.softBodies()])
    complaint(["SoftBoundaryController moves nothing", "SoftBoxController"],
              lambda box: setattr(O, "engines", softEngines(more=[SoftBoundaryController()])))
    complaint(["#16", "#15", "apart"], lambda box: setattr(box, "walls", [16, 15, 17, 18]))
    complaint(["before SoftIntegrator"], lambda box: setattr(O, "engines", [box] + O.engines[:-1]))

    def single(**options):
        packing(goal=(0, 0), maxStrainRate=(1, 1))
        wall = SoftWallController(**{"wall": 18, "goal": 1e4, "length": 8e-3, "maxVelocity": 1, **options})
        O.engines = softEngines(more=[wall])
        steps(3)

    for words, options in ((["SoftWallController", "goal", "nan"], {"goal": math.nan}), (["goal", "-1"], {"goal": -1}),
                           (["length"], {"length": math.nan}), (["maxVelocity"], {"maxVelocity": 0}),
                           (["body #0", "SoftGrain"], {"wall": 0}), (["no body #-1"], {"wall": -1})):
        checks.raises(" ".join(words), RuntimeError, words, lambda options=options: single(**options))

    def no_sense():
        packing(goal=(0, 0), maxStrainRate=(1, 1))
        O.bodies[18].shape.sense = 0
        O.engines = softEngines(more=[SoftWallController(wall=18, goal=1e4, length=8e-3, maxVelocity=1)])
        steps(3)
    checks.raises("sense", RuntimeError, ["body #18", "sense = 0"], no_sense)


run_tests(isotropic, jammed, quasistatic, strain_path, strain_goal, symmetric, wall_on_a_disc, with_weight,
          beside_rigid_grains, hook, saved, refusals)
