# SPDX-License-Identifier: GPL-2.0-or-later
"""Fast bodies: impacts on a wall, on another grain and on a thin box, at 1, 10 and 100 m/s. Waves of compression run at
252 m/s, of shear at 35 m/s."""
import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import GRID_LAID_ANEW, RADIUS, block, disc, plate, run_cases  # noqa: E402
from softgrain import arrays  # noqa: E402

SPEEDS = (1, 10, 100)
FOLDED = "the boundary folds over itself where the grain is pressed to a tenth"
METHODS = ("explicit", "updated", "implicit")
CONTACT = 12 * RADIUS / 35     # lasts about as long as a few shear waves through the grain [s]


def on_wall(speed, **options):
    def work(run):
        body = disc(0, 1.01 * RADIUS, points=124, velocity=(0, -speed, 0))
        plate(1, 0, 1)
        run.begin(min(2e-6, 2e-2 * RADIUS / speed), **options)
        run.go(0.01 * RADIUS / speed + CONTACT)
        run.require("rebounds", 0 < body.state.vel[1] <= speed, body.state.vel[1])
    return work


def on_grain(speed, **options):
    def work(run):
        left = disc(-1.01 * RADIUS, 0, points=124, velocity=(speed / 2, 0, 0))
        right = disc(1.01 * RADIUS, 0.6 * RADIUS, points=124, velocity=(-speed / 2, 0, 0))
        run.begin(min(2e-6, 4e-2 * RADIUS / speed), **options)
        excess = [body.state.inertia[2] - inertia(body) for body in (left, right)]
        angular = momentum([left, right], excess)[2]
        run.go(0.2 * RADIUS / speed + CONTACT)
        after = momentum([left, right], excess)
        scale = left.state.mass * speed / 2
        run.require("momentum kept", max(abs(after[0]), abs(after[1])) < 1e-3 * scale, after)
        run.require("angular momentum kept", abs(after[2] - angular) < 2e-2 * scale * RADIUS, (after[2], angular))
        way = (right.state.pos - left.state.pos).dot(right.state.vel - left.state.vel)
        run.require("they part", way > 0, way)
    return work


def on_thin_box(speed, **options):
    """0.02 radii thick: a tenth of the distance between surface points."""
    def work(run):
        body = disc(0, 1.05 * RADIUS, points=124, velocity=(0, -speed, 0))
        block(0, -0.01 * RADIUS, 4 * RADIUS, 0.01 * RADIUS)
        run.begin(min(2e-6, 2e-2 * RADIUS / speed), **options)
        run.go(0.05 * RADIUS / speed + CONTACT)
        run.require("stays on its side", body.state.pos[1] > 0.2 * RADIUS, body.state.pos[1])
        run.require("rebounds", 0 < body.state.vel[1] <= speed, body.state.vel[1])
    return work


def momentum(bodies, excess):
    """Of the plane, and angular about the origin: angVel is over the moment of inertia now, that of the points and what
    lumping adds to it."""
    sums = numpy.zeros(3)
    for body, more in zip(bodies, excess):
        m, x, v = body.state.mass, body.state.pos, body.state.vel
        sums += [m * v[0], m * v[1], m * (x[0] * v[1] - x[1] * v[0]) + (inertia(body) + more) * body.state.angVel[2]]
    return sums


def inertia(body):
    """Of the points about the centre of mass [kg m]."""
    arm = arrays.points(body) - tuple(body.state.pos)[:2]
    return body.material.density * arrays.pointVolumes(body) @ (arm**2).sum(1)


IMPACTS = (("impact on a wall", on_wall), ("impact of two grains off centre", on_grain), ("impact on a thin box", on_thin_box))
run_cases(*[(f"{name}, {speed} m/s", METHODS, make(speed)) for name, make in IMPACTS for speed in SPEEDS],
          *[(f"0.2 of the stable step, {name}, {SPEEDS[-1]} m/s", ("explicit",), make(SPEEDS[-1], safety=0.2))
            for name, make in IMPACTS],
          (f"theta 1/2, impact of two grains off centre, {SPEEDS[-1]} m/s", ("implicit",), on_grain(SPEEDS[-1], theta=0.5)),
          known=[("0.2 of the stable step, impact on a thin box", "explicit", FOLDED),
                 ("impact on a thin box, 100", "explicit", FOLDED),
                 ("impact on a wall, 100", "updated", GRID_LAID_ANEW), ("impact on a thin box, 100", "updated", GRID_LAID_ANEW),
                 ("impact of two grains off centre, 100", "implicit", "order 1 does not conserve angular momentum; order 2 does")])
