# SPDX-License-Identifier: GPL-2.0-or-later
"""Rest under gravity at 1, 0.1 and 0.01 of the size: a stack of three squares on a wall, a heap of six discs in a box, with
friction. Explicit steps have no damping: bodies settle by friction and contact alone, so less is asked of them."""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import disc, gel, plate, polygon, run_cases, square_box  # noqa: E402
from softgrain import arrays, measures  # noqa: E402

G = (0, -9.81, 0)
METHODS = ("explicit", "updated", "implicit", "quasistatic")
MOST_SWEEPS = 100


def soft(size):
    """Shear modulus in proportion to the size [m], so that the shape at rest is the same."""
    return gel(0.45, 1e4 * 100 * size)


def settle(run, size):
    """Falls from 0.1 of the size, and goes on ten times as long as that takes, implicit twenty times."""
    time = (2 * 0.1 * size / 9.81)**0.5
    run.begin(0.04 * time, friction=0.5, gravity=G)
    run.go((20 if run.implicit else 10) * time)
    bottoms = [arrays.outline(body)[:, 1].min() for body in measures.softBodies()]
    run.require("nothing falls through", min(bottoms) > -0.02 * size, min(bottoms))
    kinetic = sum(0.5 * body.state.mass * body.state.vel.norm()**2 for body in measures.softBodies())
    fall = sum(body.state.mass for body in measures.softBodies()) * 9.81 * 0.1 * size
    run.require("at rest" if run.implicit else "not faster than it fell", kinetic < (1e-3 if run.implicit else 1) * fall,
                kinetic / fall)
    if not run.implicit:
        run.require(f"sweeps up to {MOST_SWEEPS}", run.iterations <= MOST_SWEEPS, run.iterations)


def stack(size):
    def work(run):
        material, half = soft(size), size / 2
        for k in range(3):
            low = (0.1 + 1.001 * k) * size
            polygon([(-half, low), (half, low), (half, low + size), (-half, low + size)], material)
        plate(1, 0, 1)
        settle(run, size)
        heights = [body.state.pos[1] / size for body in measures.softBodies()]
        run.require("in their order", 0.4 < heights[0] < heights[1] - 0.7 < heights[2] - 1.4, heights)
    return work


def heap(size):
    def work(run):
        material, R = soft(size), size / 2
        for row, count in ((0, 3), (1, 2), (2, 1)):
            for k in range(count):
                disc((2.02 * k + 1.01 * row) * R, (1.1 + 1.85 * row) * R, R, material)
        square_box(-1.1 * R, 5.15 * R, 0, 20 * R)
        settle(run, size)
    return work


run_cases(*[(f"{name}, size {1e3 * size:g} mm", METHODS, make(size))
            for name, make in (("stack of 3 squares", stack), ("heap of 6 discs", heap)) for size in (1e-2, 1e-3, 1e-4)],
          known=[("stack of 3 squares, size 0.1 mm", "implicit", "corners that stand on corners: no normal for the iterations to settle on")])
