# SPDX-License-Identifier: GPL-2.0-or-later
"""Coordination, contact widths, jamming and eq. 10 against cases whose answer is known."""
import math
import os
import random
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import jamming, measures  # noqa: E402


def coordination_of_known_packings(checks):
    # four grains in a chain between walls 90 and 91: two contacts each
    chain = [(90, 0), (0, 1), (1, 2), (2, 3), (3, 91)]
    checks.that("a chain carries force with friction", measures.coordination(chain, range(4), True) == (2.0, 0, 5))
    found = measures.coordination(chain, range(4), False)
    checks.that("and is all rattlers without", math.isnan(found[0]) and found[1:] == (4, 5))
    # a triangle on two walls (three contacts each), one grain that hangs on by two
    frame = [(0, 1), (1, 2), (2, 0), (0, 90), (1, 91), (2, 92), (3, 0), (3, 1)]
    checks.that("a grain with two contacts is a rattler, its contacts do not count",
                measures.coordination(frame, range(4), False) == (3.0, 1, 8))
    checks.that("with friction it is none", measures.coordination(frame, range(4), True) == ((4 + 4 + 3 + 2) / 4, 0, 8))


def coordination_equals_the_slow_way(checks):
    generator = random.Random(3)
    for _ in range(50):
        count = generator.randint(3, 30)
        bodies = range(count + 4)          # the last four are walls
        pairs = [(a, b) for a in bodies for b in bodies if a < b and a < count and generator.random() < 4 / count]
        for least in (2, 3):
            alive = set(range(count))
            while True:
                degree = {g: sum(1 for a, b in pairs if g in (a, b) and all(x in alive or x >= count for x in (a, b)))
                          for g in alive}
                loose = {g for g in alive if degree[g] < least}
                if not loose:
                    break
                alive -= loose
            expected = sum(degree.values()) / len(alive) if alive else math.nan
            found, rattlers, _ = measures.coordination(pairs, range(count), least == 2)
            checks.that("Z as by brute force", found == expected or (math.isnan(found) and math.isnan(expected)))
            checks.that("rattlers as by brute force", rattlers == count - len(alive))


def contact_width_of_a_pressed_cylinder(checks):
    # Johnson 1985, section 4.2(c): outside the contact |x| < a the gap is [x sqrt(x^2 - a^2) - a^2 acosh(x / a)] / 2 R
    for a in (0.2, 0.33, 0.5):
        x = numpy.linspace(-1, 1, 28)
        out = numpy.maximum(abs(x) / a, 1)
        top = 1 - a**2 / 4 * (out * numpy.sqrt(out**2 - 1) - numpy.arccosh(out))
        outline = numpy.concatenate([numpy.column_stack([x, top])[::-1], numpy.column_stack([x, -3 - top])])
        for turned, axis in ((outline, 1), (outline[:, ::-1], 0)):
            checks.close_to("half-width of the contact", measures.contactHalfWidth(turned, axis, 1.0, 1e-6) / a, 1, 1e-2)
    checks.that("no contact", measures.contactHalfWidth(outline, 1, 2.0, 1e-4) == 0)


def contact_width_in_a_square(checks):
    x = numpy.linspace(-1, 1, 11)[:-1]
    square = numpy.concatenate([numpy.column_stack([x, 0 * x - 1]), numpy.column_stack([0 * x + 1, x]),
                                numpy.column_stack([-x, 0 * x + 1]), numpy.column_stack([0 * x - 1, -x])])
    for axis in range(2):
        checks.close_to("side of the square", measures.contactHalfWidth(square, axis, 1.0, 1e-4), 1, 1e-12)


def extent_of_a_sampled_circle(checks):
    for start in (0.0, 0.05, 0.1, 0.2):
        turn = start + numpy.linspace(0, 2 * math.pi, 32, endpoint=False)
        circle = 3 * numpy.column_stack([numpy.cos(turn), numpy.sin(turn)])
        for axis in range(2):
            checks.close_to("diameter through the sampled points", measures.extent(circle, axis), 6, 1e-3)


def compaction(exponent, scatter=0.0):
    """Table of an invented compaction that jams at 0.82 with Z0 = 4, and grows to Z = 5.8 at 0.98."""
    fraction = numpy.arange(0.65, 0.9801, 0.001)
    beyond = numpy.maximum(fraction - 0.82, 0) / 0.16
    stress = jamming.STRESS * numpy.exp((fraction - 0.82) / 0.01)
    count = numpy.where(fraction < 0.82, numpy.nan, 4 + 1.8 * beyond**exponent)
    return {"strain": numpy.log(fraction / 0.65), "solid_fraction": fraction, "stress_bottom_Pa": stress,
            "coordination": count + scatter * numpy.sin(1e5 * fraction)}


def jamming_and_equation_10(checks):
    table = compaction(0.5)
    point = jamming.jamming_point(table)
    checks.close_to("jamming fraction", point["solid_fraction"], 0.82, 1.5e-3)
    fits = jamming.growth_fits(table)
    checks.that("eq. 10 for several phi0", len(fits) == 3)
    checks.that("a square root has a small residual", fits[0]["residual"] < 0.06, fits[0]["residual"])
    linear = jamming.growth_fits(compaction(1.0))[0]
    checks.that("a straight line has a large one", linear["residual"] > 0.15, linear["residual"])
    checks.close_to("and the exponent 1", linear["best_exponent"], 1.0, 0.1)
    loose = {key: value[:100] for key, value in table.items()}
    checks.that("no jamming before jamming", jamming.jamming_point(loose) is None and jamming.growth_fits(loose) == [])


run_tests(coordination_of_known_packings, coordination_equals_the_slow_way, contact_width_of_a_pressed_cylinder,
          contact_width_in_a_square, extent_of_a_sampled_circle, jamming_and_equation_10)
