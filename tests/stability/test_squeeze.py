# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains squeezed as far as they go: one flat to a tenth, one in a corner without voids, a packing without voids and beyond."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import GRID_LAID_ANEW, RADIUS, disc, drive, gel, plate, run_cases, square_box  # noqa: E402
from softgrain import measures, softCloud  # noqa: E402
from yade import O  # noqa: E402

ALL = ("explicit", "updated", "implicit", "quasistatic")


def flat(run):
    """Gap from 2 R to 0.2 R, slower and slower, since it flows out sideways the faster."""
    disc(0, 0)
    walls = plate(1, -RADIUS, 1), plate(1, RADIUS, -1)
    run.begin(5e-6)
    while (gap := 2 * walls[1].state.pos[1]) > 0.2001 * RADIUS:
        nearer = max(0.9 * gap, 0.2 * RADIUS)
        duration = (gap - nearer) / (gap / RADIUS / 2)**2 / 8      # at 8 m/s (gap / 2 R)^2
        for wall in walls:
            drive(wall, wall.shape.sense * (gap - nearer) / 2 / duration)
        run.step = duration / 10
        run.go(duration)
    run.require("squeezed by 90 %", abs(walls[1].state.pos[1] - 0.1 * RADIUS) < 2e-3 * RADIUS, walls[1].state.pos[1])


def cornered(run):
    """Four walls until a solid fraction of 0.999."""
    body = disc(0, 0, points=124)
    walls = square_box(-RADIUS, RADIUS, -RADIUS, RADIUS)
    speed = 0.5
    for wall in walls:
        drive(wall, wall.shape.sense * speed)
    run.begin(5e-4 * RADIUS / speed)

    def fraction():
        return body.state.area() / (2 * walls[3].state.pos[1])**2
    while fraction() < 0.999 and walls[3].state.pos[1] > 0.8 * RADIUS:
        run.go(1e-3 * RADIUS / speed)
    run.require("solid fraction 0.999", 0.999 <= fraction() <= 1.001, fraction())


def packed(beyond):
    """Eight grains until their undeformed areas are (1 + beyond) times the box."""
    def work(run):
        width, speed = 5e-3, 2.0
        grains, height = softCloud(width, 8, (1.4e-3, 2.4e-3), 0.65, gel(), points=124, seed=3)
        O.bodies.append(grains)
        top = square_box(0, width, 0, height)[-1]
        drive(top, -speed)
        run.begin(2e-3 * height / speed)
        run.go((height - measures.referenceArea() / width / (1 + beyond)) / speed)
        fraction = measures.solidFraction(width * top.state.pos[1])
        least = 0.97 + beyond / 2      # grains are compressible: pressure closes the last voids slowly
        run.require(f"solid fraction {least:g} to 1.003", least < fraction < 1.003, fraction)
    return work


run_cases(("one grain squeezed by 90 %", ALL, flat),
          ("four walls to solid fraction 0.999", ALL, cornered),
          ("packing of 8 to 1.0", ALL, packed(0.0)),
          ("packing of 8 to 3 % beyond 1.0", ALL, packed(0.03)),
          known=[("one grain", "updated", GRID_LAID_ANEW)])
