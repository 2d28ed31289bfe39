# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of concave outline that come to meet themselves: arms of a U that walls press on each other hold each other off, with
friction as between two grains, and go on the same after a break."""
import os
import sys

import numpy
from yade import O
from yade.utils import wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, softEngines, softPolygon  # noqa: E402

SIZE = 1e-3
U = [(-1, -1), (1, -1), (1, 1), (0.25, 1), (0.25, 0), (-0.25, 0), (-0.25, 1), (-1, 1)]
SPEED = 1.0


def press(friction=0.0, skew=0.15, **options):
    """A U in a box whose sides come together; its body. The right arm is lower by `skew` [SIZE]: corners do not meet."""
    O.reset()
    O.materials.append(NeoHookeanMat(lambda_=1e6, mu=1e6, density=1000, frictionAngle=friction, label="gel"))
    O.materials.append(FrictMat(frictionAngle=0, label="stone"))
    outline = [(x, y - skew * (x > 0 and y == 1)) for x, y in U]
    O.bodies.append(softPolygon([(SIZE * x, SIZE * y) for x, y in outline], "gel", points=300))
    for axis, side in ((0, 1), (0, -1), (1, 1)):
        O.bodies.append(wall(-side * SIZE, axis=axis, sense=side, material="stone"))
        if axis == 0:
            O.bodies[-1].state.vel = (side * SPEED, 0, 0)
    O.engines = softEngines(**options)
    return O.bodies[0]


def shut(until=0.31):
    """Presses on until each wall has gone so far [SIZE]; the force of a wall at its end [N/m]."""
    while O.time < until * SIZE / SPEED:
        O.step()
    return abs(O.forces.f(1)[0])


def covers_twice(body):
    outline = arrays.outline(body)
    along = numpy.roll(outline, -1, axis=0) - numpy.roll(outline, 1, axis=0)
    along /= numpy.linalg.norm(along, axis=1)[:, None]
    for place in outline + 0.02 * SIZE * numpy.stack((along[:, 1], -along[:, 0]), axis=1):
        ways = outline - place
        angles = numpy.unwrap(numpy.append(numpy.arctan2(ways[:, 1], ways[:, 0]), numpy.arctan2(ways[0, 1], ways[0, 0])))
        if angles[-1] - angles[0] > 3 * numpy.pi:
            return True
    return False


def arms_hold_each_other_off(checks):
    for options in ({}, {"integrator": "implicit", "dt": 5e-6}, {"quasistatic": True, "integrator": "implicit", "dt": 5e-6}):
        body = press(**options)
        shut(0.2)
        checks.that(f"{options}: there is an opening", not covers_twice(body))
        shut()
        soft = measures.softIntegrator()
        checks.that(f"{options}: the outline stays out of itself", not covers_twice(body))
        checks.that(f"{options}: J > 0", soft.minJ() > 0.2, soft.minJ())
        checks.close_to(f"{options}: energy", measures.heldOrLost(soft) / soft.externalWork, 1, 0.02)
        checks.that(f"{options}: contacts of two bodies alone are told", all(a != b for a, b, *_ in soft.contacts()))


def goes_on_the_same(checks):
    for options in ({}, {"quasistatic": True, "integrator": "implicit", "dt": 5e-6}):
        ends = []
        for broken in (False, True):
            press(0.3, **options)
            shut(0.28)
            if broken:
                with Folder() as folder:
                    path = os.path.join(folder, "scene.xml")
                    O.save(path, quiet=True)
                    O.reset()
                    O.load(path, quiet=True)
            shut()
            ends.append(arrays.points(O.bodies[0]))
        checks.close_to(f"{options}: after a break", abs(ends[0] - ends[1]).max() / SIZE, 0, 1e-9 if options else 0)


def friction_between_the_arms(checks):
    taken = []
    for friction in (0.0, 0.6):
        body = press(friction, skew=0.3)
        shut()
        taken.append(measures.softIntegrator().frictionDissipation)
        checks.that(f"friction {friction}: the outline stays out of itself", not covers_twice(body))
    checks.that("slides without friction at no cost, and with it at some", taken[0] == 0 and taken[1] > 0, taken)


run_tests(arms_hold_each_other_off, goes_on_the_same, friction_between_the_arms)
