# SPDX-License-Identifier: GPL-2.0-or-later
"""Sharp and slender bodies: a square through a slot, squares corner on corner, a corner that indents a disc, a grain pinched
between two edges, a column that buckles, a slender grain, notched ones, a ring."""
import math
import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import GRID_LAID_ANEW, RADIUS, block, disc, drive, gel, plate, polygon, run_cases, square_box  # noqa: E402
from softgrain import arrays  # noqa: E402

METHODS = ("explicit", "updated", "implicit")
HALF = 0.25     # of the squares of the slot [m]


def rectangle(x, y, half_width, half_height, angle=0.0):
    c, s = math.cos(angle), math.sin(angle)
    return [(x + c * a - s * b, y + s * a + c * b) for a, b in ((-half_width, -half_height), (half_width, -half_height),
                                                                (half_width, half_height), (-half_width, half_height))]


def slot(run):
    """The two-dimensional case of Li et al. 2020's comparison (IPC): a fixed soft block, here rigid, of 0.2 m x 0.7 m, beside
    which a soft square of 0.5 m is driven past, E = 1000 Pa, nu = 0.4, 1000 kg/m3; here through a slot of 0.4 m between two."""
    square = polygon(rectangle(0, 0, HALF, HALF), gel(0.4, 1000 / 2.8), points=124)
    for side in (-1, 1):
        block(0.55 * side, 0.61, 0.35, 0.1)
    pusher = plate(1, -1.004 * HALF, 1, 0.05)
    run.begin(4e-2)
    run.go(1.0 / 0.05)
    drive(pusher, 0)
    run.go(1.0)
    run.require("squeezed into the slot, not around it", square.state.pos[1] > 0.4 and abs(square.state.pos[0]) < 0.05,
                square.state.pos)


def past_each_other(run):
    """Two soft squares of 0.5 m pushed past each other with an overlap of 0.1 m of their ways: corner on corner first."""
    material = gel(0.4, 1000 / 2.8)
    squares = [polygon(rectangle(0.51 * side, 0.2 * side, HALF, HALF), material, velocity=(-0.1 * side, 0, 0))
               for side in (-1, 1)]
    run.begin(2e-2)
    momentum = sum(square.state.mass * square.state.vel[0] for square in squares)
    run.go(7.5)
    run.require("momentum kept", abs(sum(square.state.mass * square.state.vel[0] for square in squares) - momentum)
                < 1e-6 * squares[0].state.mass)


def corner_on_corner(run):
    """Two squares on their corners, one on the other, pressed between plates by 20 %."""
    diagonal = RADIUS * math.sqrt(2)
    for k in (-1, 1):
        polygon(rectangle(0, 1.01 * k * diagonal, RADIUS, RADIUS, math.pi / 4))
    plate(1, -2.02 * diagonal, 1, 1.0)
    plate(1, 2.02 * diagonal, -1, -1.0)
    run.begin(5e-6)
    run.go(0.4 * diagonal)


def indented(run):
    """A box on its corner pressed into a disc by half of R."""
    disc(0, 0, points=124)
    plate(1, -1.001 * RADIUS, 1)
    block(0, RADIUS * (1.001 + 0.5 * math.sqrt(2)), RADIUS / 2, RADIUS / 2, math.pi / 4, (0, -1))
    run.begin(5e-6)
    run.go(0.5 * RADIUS)


def pinched(run):
    """A disc between the corners of two boxes, which come as near to each other as R."""
    disc(0, 0, points=124)
    for side in (-1, 1):
        block(0, side * RADIUS * (1.001 + 0.5 * math.sqrt(2)), RADIUS / 2, RADIUS / 2, math.pi / 4, (0, -side))
    run.begin(5e-6)
    run.go(0.5 * RADIUS)


def column(run):
    """Four rectangles, twice as high as wide, on each other with friction 0.5, pressed by a fifth: the column gives way."""
    for k in range(4):
        polygon(rectangle(0.02 * RADIUS * (-1)**k, (2.001 * k + 1.001) * RADIUS, RADIUS / 2, RADIUS))
    drive(square_box(-3 * RADIUS, 3 * RADIUS, 0, 8.006 * RADIUS)[-1], -2.0)
    run.begin(5e-6, friction=0.5)
    run.go(1.6 * RADIUS / 2)


def slender(run):
    """A grain ten times as long as thick, standing, pressed by a fifth between plates: it buckles between side walls."""
    body = polygon(rectangle(0, 5 * RADIUS, RADIUS / 2, 5 * RADIUS, 0.01), points=160)
    drive(square_box(-3 * RADIUS, 3 * RADIUS, -0.01 * RADIUS, 10.01 * RADIUS)[-1], -2.0)
    run.begin(5e-6, friction=0.5)
    run.go(2 * RADIUS / 2)
    bow = numpy.ptp(arrays.outline(body)[:, 0])
    run.require("buckled", bow > 1.5 * RADIUS, bow)


def notched(run):
    """A square with a notch to its middle, pressed across by 30 %: the notch closes to half of its width."""
    w = 0.3 * RADIUS
    polygon([(-RADIUS, -RADIUS), (RADIUS, -RADIUS), (RADIUS, RADIUS), (w, RADIUS), (0, 0), (-w, RADIUS), (-RADIUS, RADIUS)],
            points=160)
    plate(0, -1.001 * RADIUS, 1, 1.0)
    plate(0, 1.001 * RADIUS, -1, -1.0)
    run.begin(5e-6)
    run.go(0.15 * RADIUS)


def arms(friction):
    """A U between walls on a floor, pressed across by 38 %: its arms, as far from each other as half of its radius, meet and press
    on each other."""
    def work(run):
        w = 0.25 * RADIUS
        body = polygon([(-RADIUS, -RADIUS), (RADIUS, -RADIUS), (RADIUS, RADIUS), (w, RADIUS), (w, 0), (-w, 0), (-w, RADIUS),
                        (-RADIUS, RADIUS)], points=300)
        plate(1, -1.15 * RADIUS, 1)
        for side in (-1, 1):
            plate(0, side * 1.001 * RADIUS, -side, -side)
        run.begin(5e-6, friction=friction)
        outline = arrays.outline(body)
        sides = [(abs(outline[:, 0] - side * w) < 0.02 * RADIUS) & (outline[:, 1] > 0.1 * RADIUS) for side in (-1, 1)]
        run.go(0.38 * RADIUS)
        left, right = (arrays.outline(body)[side] for side in sides)
        width = numpy.linalg.norm(left[:, None] - right, axis=2).min()
        run.require("arms meet", width < 0.1 * RADIUS, width)
        run.require("does not pass through itself", not covers_twice(body))
    return work


def covers_twice(body):
    """Some place 0.02 R off the boundary is inside of it twice."""
    outline = arrays.outline(body)
    along = numpy.roll(outline, -1, axis=0) - numpy.roll(outline, 1, axis=0)
    along /= numpy.linalg.norm(along, axis=1)[:, None]
    for place in outline + 0.02 * RADIUS * numpy.stack((along[:, 1], -along[:, 0]), axis=1):
        ways = outline - place
        angles = numpy.unwrap(numpy.append(numpy.arctan2(ways[:, 1], ways[:, 0]), numpy.arctan2(ways[0, 1], ways[0, 0])))
        if angles[-1] - angles[0] > 3 * math.pi:
            return True
    return False


def ring(run):
    """A ring, slit at its side as polygons have no holes: pressed from above by a third of its height it opens at the slit."""
    def arc(radius, first, last, count):
        return [(radius * math.cos(angle), radius * math.sin(angle)) for angle in numpy.linspace(first, last, count)]

    slit = 0.1
    body = polygon(arc(RADIUS, slit, 2 * math.pi - slit, 24) + arc(0.6 * RADIUS, 2 * math.pi - slit, slit, 16), points=200)
    plate(1, -1.001 * RADIUS, 1, 1.0)
    plate(1, 1.001 * RADIUS, -1, -1.0)
    run.begin(5e-6)
    run.go(RADIUS / 3)
    across = numpy.ptp(arrays.outline(body), axis=0)
    run.require("lower and wider", across[1] < 1.36 * RADIUS and across[0] > 2.2 * RADIUS, across)


run_cases(("square through a slot", METHODS, slot),
          ("squares past each other", METHODS, past_each_other),
          ("corner on corner", METHODS, corner_on_corner),
          ("corner indents a disc", METHODS, indented),
          ("grain pinched between two edges", METHODS, pinched),
          ("column of four rectangles", METHODS, column),
          ("slender grain, aspect 10", METHODS, slender),
          ("notched grain", METHODS, notched),
          ("arms of a U on each other", (*METHODS, "quasistatic"), arms(0)),
          ("arms of a U on each other, friction 0.5", METHODS, arms(0.5)),
          ("slit ring", METHODS, ring),
          known=[*[("square through", method, "corners of the square fold over themselves at the edges of the slot")
                   for method in ("explicit", "implicit")],
                 ("square through", "updated", GRID_LAID_ANEW)])
