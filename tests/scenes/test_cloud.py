# SPDX-License-Identifier: GPL-2.0-or-later
"""softCloud: the box is as full as asked, no two discs touch, a seed gives the same cloud, thousands take seconds."""
import math
import os
import sys
import time

import numpy
from yade import O

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import NeoHookeanMat, discCloud, softCloud  # noqa: E402
from softgrain.builders import widthOfSquareCloud  # noqa: E402

DIAMETERS = (1.4e-3, 2.4e-3)


def slow_least_gap(width, height, radii, places):
    """All pairs and all sides, without any cells [m]."""
    apart = numpy.hypot(*(places[:, None] - places[None]).transpose(2, 0, 1)) - radii[:, None] - radii[None]
    numpy.fill_diagonal(apart, numpy.inf)
    sides = numpy.minimum(places, numpy.array([width, height]) - places) - radii[:, None]
    return min(apart.min(), 2 * sides.min())


def no_two_discs_touch(checks):
    for count, fractions in ((1, (0.2,)), (10, (0.2, 0.5, 0.6)), (40, (0.5, 0.65, 0.72)), (300, (0.2, 0.65, 0.75))):
        for fraction in fractions:
            for seed in (1, 2, 3):
                width = widthOfSquareCloud(count, DIAMETERS, fraction)
                radii, places, angles, height = discCloud(width, count, DIAMETERS, fraction, seed)
                radii, places = numpy.array(radii), numpy.array(places)
                gap = slow_least_gap(width, height, radii, places)
                name = f"{count} discs, solid fraction {fraction}, seed {seed}"
                checks.that(f"{name}: apart", gap >= 1e-3 * radii.mean(), f"least gap {gap / radii.mean():.2e} R")
                full = math.pi * sum(radii**2) / (width * height)
                checks.close_to(f"{name}: as full as asked", full, fraction, 1e-12)
                checks.that(f"{name}: diameters", 0.7e-3 <= radii.min() and radii.max() <= 1.2e-3)
                checks.that(f"{name}: a rotation for each", len(angles) == count)


def a_seed_gives_the_same_cloud(checks):
    width = widthOfSquareCloud(50, DIAMETERS, 0.65)
    one, same, other = (discCloud(width, 50, DIAMETERS, 0.65, seed) for seed in (4, 4, 5))
    checks.that("same seed, same cloud", one == same)
    checks.that("other seed, other cloud", one != other)


def three_thousand_discs_take_seconds(checks):
    began = time.process_time()
    discCloud(widthOfSquareCloud(3000, DIAMETERS, 0.65), 3000, DIAMETERS, 0.65, 1)
    seconds = time.process_time() - began
    checks.that("3000 discs within 10 s", seconds < 10, f"{seconds:.1f} s")


def bodies_are_those_of_the_cloud(checks):
    O.reset()
    O.materials.append(NeoHookeanMat())
    width = widthOfSquareCloud(12, DIAMETERS, 0.6)
    bodies, height = softCloud(width, 12, DIAMETERS, 0.6, points=60, seed=7)
    radii, places, angles, same_height = discCloud(width, 12, DIAMETERS, 0.6, 7)
    checks.that("same height", height == same_height)
    for body, radius, place, angle in zip(bodies, radii, places, angles):
        checks.that("radius and place", body.shape.radius == radius and tuple(body.state.pos)[:2] == tuple(place))
        axis, turn = body.state.ori.toAxisAngle()
        difference = (turn * math.copysign(1, axis[2]) - angle) % (2 * math.pi)
        checks.close_to("rotation of the grid", min(difference, 2 * math.pi - difference), 0, 1e-9)
        checks.close_to("mass", body.state.mass, 1000 * math.pi * radius**2, 1e-9 * body.state.mass)


run_tests(no_two_discs_touch, a_seed_gives_the_same_cloud, three_thousand_discs_take_seconds,
          bodies_are_those_of_the_cloud)
