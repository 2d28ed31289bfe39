# SPDX-License-Identifier: GPL-2.0-or-later
"""Unlike bodies that touch: densities 1 to 1e6, shear moduli 1 to 1e4, radii 1 to 20."""
import math
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import LONG, MOST_STEPS, MU, RADIUS, block, disc, gel, plate, polygon, run_cases  # noqa: E402
from softgrain import arrays, measures  # noqa: E402
from yade import O  # noqa: E402

METHODS = ("explicit", "updated", "implicit")


def light_on_heavy(run):
    """A grain meets one at rest of 1e6 times its mass."""
    light = disc(0, 2.02 * RADIUS, velocity=(0, -1, 0))
    heavy = disc(0, 0, material=gel(density=1e9))
    run.begin(1e-6)
    run.go(0.02 * RADIUS + 0.6e-3)
    momentum = light.state.mass * light.state.vel[1] + heavy.state.mass * heavy.state.vel[1]
    run.require("momentum kept", abs(momentum / light.state.mass + 1) < 1e-3, momentum)
    run.require("rebounds", 0.3 < light.state.vel[1] < 1, light.state.vel[1])


def heavy_on_light(run):
    """A block of the same area and 1e6 times the density comes down on a grain on a wall, and is thrown back."""
    disc(0, RADIUS)
    low, high, half = 2.01 * RADIUS, 3.51 * RADIUS, math.pi / 3 * RADIUS
    heavy = polygon([(-half, low), (half, low), (half, high), (-half, high)], gel(density=1e9), velocity=(0, -0.015, 0))
    plate(1, 0, 1)
    run.most_steps = 10 * MOST_STEPS
    run.begin(2e-3)
    start = lowest = heavy.state.pos[1]
    run.go(4e-3)
    while O.time < 0.3 and heavy.state.pos[1] < start - 0.01 * RADIUS:
        run.go(4e-3)
        lowest = min(lowest, heavy.state.pos[1])
    pressed = (start - 0.01 * RADIUS - lowest) / 2 / RADIUS
    run.require("pressed by 10 to 50 %, and thrown back", 0.1 < pressed < 0.5 and heavy.state.vel[1] > 0,
                (pressed, heavy.state.vel[1]))


def hard_on_soft(run):
    """1e4 times the modulus; together pressed by 15 % of one's height, all of which the soft one takes."""
    soft = disc(0, RADIUS)
    hard = disc(0, 3 * RADIUS, material=gel(mu=1e4 * MU))
    plate(1, 0, 1)
    plate(1, 4 * RADIUS, -1, -2.0)
    run.begin(5e-6)
    run.go(0.15 * RADIUS)
    ratio = soft.state.elasticEnergy() / hard.state.elasticEnergy()
    run.require("the soft one holds 99 % of the elastic energy", ratio > 99, ratio)


def large_on_small(run):
    """Twenty times the radius; the small one in the middle is pressed by half of its height between the large one and a box."""
    small = disc(0, RADIUS / 20, RADIUS / 20)
    disc(0, 1.1 * RADIUS)
    block(0, -0.5 * RADIUS, 2 * RADIUS, 0.5 * RADIUS)
    plate(1, 2.1 * RADIUS, -1, -1.0)
    run.begin(2e-6)
    run.go(0.05 * RADIUS)
    run.require("the small one stays between them", abs(small.state.pos[0]) < 0.02 * RADIUS and small.state.pos[1] > 0,
                small.state.pos)
    run.require("and is squeezed", measures.extent(arrays.outline(small), 1) < 1.9 * RADIUS / 20)


run_cases(("1e-6 of the mass on 1", METHODS, light_on_heavy),
          ("1e6 of the mass on 1", METHODS if LONG else ("explicit", "implicit"), heavy_on_light),
          ("1e4 of the modulus on 1", METHODS, hard_on_soft),
          ("20 of the radius on 1", METHODS, large_on_small))
