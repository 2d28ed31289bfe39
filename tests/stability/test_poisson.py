# SPDX-License-Identifier: GPL-2.0-or-later
"""Grains that are nearly incompressible: Poisson ratios 0.49 to 0.49999, squeezed, between four walls and in a packing."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import RADIUS, disc, drive, gel, plate, run_cases, square_box  # noqa: E402
from softgrain import softCloud  # noqa: E402
from yade import O  # noqa: E402

RATIOS = (0.49, 0.499, 0.4999, 0.49999)
SPEED = 2.0
LIMIT = 2345.0      # force at 30 % on an incompressible grain, finite elements of nu = 0.49: 2324.7 [N/m], see README


def squeezed(poisson):
    def work(run):
        disc(0, 0, material=gel(poisson), points=124)
        bottom, top = plate(1, -RADIUS, 1, SPEED / 2), plate(1, RADIUS, -1, -SPEED / 2)
        run.begin(2e-2 * RADIUS / SPEED)
        run.go(0.58 * RADIUS / SPEED)
        force, count = 0.0, 0
        end = O.time + 0.04 * RADIUS / SPEED
        while O.time < end:
            run.go(0.002 * RADIUS / SPEED)
            force, count = force + (O.forces.f(top.id)[1] - O.forces.f(bottom.id)[1]) / 2, count + 1
        run.require("no locking: force at 30 % within 8 % of 2345 N/m", abs(force / count / LIMIT - 1) < 0.08, force / count)
    return work


def cornered(poisson):
    """Sides 2 R c, c from 1 to 0.8875: solid fraction 0.997 were the grain incompressible."""
    def work(run):
        disc(0, 0, material=gel(poisson))
        for wall in square_box(-RADIUS, RADIUS, -RADIUS, RADIUS):
            drive(wall, wall.shape.sense * SPEED)
        run.begin(1e-2 * RADIUS / SPEED)
        run.go(0.1125 * RADIUS / SPEED)
    return work


def packed(poisson):
    """Six grains to a solid fraction of 0.93."""
    def work(run):
        width = 4e-3
        grains, height = softCloud(width, 6, (1.4e-3, 2.0e-3), 0.65, gel(poisson), points=60, seed=2)
        O.bodies.append(grains)
        top = square_box(0, width, 0, height)[-1]
        drive(top, -SPEED)
        run.begin(4e-3 * height / SPEED)
        run.go(height * (1 - 0.65 / 0.93) / SPEED)
    return work


def methods(poisson):
    return ("explicit", "updated", "implicit") if poisson == 0.49 else ("explicit", "implicit")


run_cases(*[(f"{name}, Poisson ratio {nu:g}", methods(nu), make(nu))
            for name, make in (("squeeze to 30 %", squeezed), ("four walls", cornered), ("packing of 6 to 0.93", packed))
            for nu in RATIOS])
