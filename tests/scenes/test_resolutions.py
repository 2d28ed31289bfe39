# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains of different resolution in one scene: a column of three discs, held at its sides, between plates gives the force of
one in which all are fine, explicit and quasi-static, and each disc is flattened as there."""
import os
import sys

import numpy
from yade import O
from yade.utils import wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, softDisc, softEngines  # noqa: E402

RADIUS, FINE = 1e-3, 400
HALF = 3 * RADIUS


def column(points, **engines):
    """Of three discs, upon each other; what the plates bear while they close by 18 to 20 % [N/m], and the heights [R]."""
    O.reset()
    O.materials.append(NeoHookeanMat(lambda_=6e6, mu=1e6, label="gel"))
    steel = O.materials.append(FrictMat(frictionAngle=0))
    O.bodies.append([softDisc((0, 2 * k * RADIUS), RADIUS, "gel", points=count) for k, count in zip((-1, 0, 1), points)])
    plates = [O.bodies.append(wall(side * HALF, axis=1, sense=-side, material=steel)) for side in (-1, 1)]
    for side in (-1, 1):
        O.bodies.append(wall(side * RADIUS, axis=0, sense=-side, material=steel))
    for side, plate in zip((-1, 1), plates):
        O.bodies[plate].state.vel = (0, -0.5 * side, 0)
    O.engines = softEngines(**engines)
    top, forces = O.bodies[plates[1]].state, []
    while top.pos[1] > 0.80 * HALF:
        O.step()
        if top.pos[1] < 0.82 * HALF:
            forces.append(abs(O.forces.f(plates[0])[1]) + abs(O.forces.f(plates[1])[1]))
    return numpy.mean(forces) / 2, [numpy.ptp(arrays.outline(body)[:, 1]) / RADIUS for body in measures.softBodies()]


def a_column_of_mixed_discs(checks):
    for name, engines, bound in (("quasi-static", {"integrator": "implicit", "quasistatic": True, "dt": 5e-6}, 0.02),
                                 ("explicit", {"safety": 0.5}, 0.03)):
        expected, heights = column((FINE, FINE, FINE), **engines)
        for points in ((124, FINE, 276), (FINE, 124, FINE), (276, 124, 276)):
            force, found = column(points, **engines)
            counts = [body.shape.pointCount() for body in measures.softBodies()]
            checks.that(f"{name}, {points}: points", numpy.allclose(counts, points, rtol=0.25), counts)
            checks.close_to(f"{name}, {points}: force", force, expected, bound * expected)
            checks.close_to(f"{name}, {points}: heights", abs(numpy.array(found) - heights).max(), 0, 0.02)
            soft = measures.softIntegrator()
            missing = measures.heldOrLost(soft) / soft.externalWork - 1
            checks.that(f"{name}, {points}: energy balance", abs(missing) < 1e-2, missing)


run_tests(a_column_of_mixed_discs)
