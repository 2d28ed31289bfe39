# SPDX-License-Identifier: GPL-2.0-or-later
"""Packings that are held, released and pressed again: friction 0 to 10, five grains pressed flat, cyclic walls."""
import math
import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import LONG, RADIUS, disc, drive, gel, plate, run_cases, square_box  # noqa: E402
from softgrain import arrays, measures, softCloud  # noqa: E402
from yade import O  # noqa: E402

WIDTH, SPEED = 4e-3, 1.0
SWEEPS = "sweeps end at maxSweeps in some steps"


def packing(run, friction=0.0):
    """Six grains in a box; the top wall, and the time that presses them to a solid fraction of 0.95 [s]."""
    grains, height = softCloud(WIDTH, 6, (1.4e-3, 2.0e-3), 0.7, gel(), points=60, seed=4)
    O.bodies.append(grains)
    top = square_box(0, WIDTH, 0, height)[-1]
    drive(top, -SPEED)
    run.begin(4e-3 * height / SPEED, friction=friction)
    return top, height * (1 - 0.7 / 0.95) / SPEED


def held(friction):
    """Jammed and held: 2,000 steps, 100,000 in the long form; implicit steps of 0.1 ms: 50, or 1,000."""
    def work(run):
        top, duration = packing(run, friction)
        run.go(duration)
        drive(top, 0)
        run.most_steps = math.inf
        run.step = 1e-4
        run.go(2e-3 if run.implicit else 0.5e-3)
        places = numpy.array([tuple(body.state.pos) for body in measures.softBodies()])
        stored, work_before = run.stored(), run.soft.externalWork
        count = (1000 if LONG else 50) if run.implicit else (100000 if LONG else 2000)
        run.go(count * (run.step if run.implicit else O.dt))
        gain = run.stored() - stored - (run.soft.externalWork - work_before)
        run.require("no energy gained while held", gain < 1e-3 * run.turnover, gain / run.turnover)
        moved = abs(numpy.array([tuple(body.state.pos) for body in measures.softBodies()]) - places).max() / RADIUS
        # grains go on to vibrate in explicit runs, which have no damping; friction takes that out
        run.require("no creep", moved < (1e-3 if run.implicit else 0.05), f"({moved:.2g} R)")
    return work


def flat_and_back(run):
    """Five grains in a row pressed to a twentieth of their height, over 0.4 s, and released: the plates part in 10 ms."""
    for k in range(5):
        disc(2.05 * k * RADIUS, 0)
    walls = plate(1, -RADIUS, 1), plate(1, RADIUS, -1)
    run.most_steps = math.inf
    run.begin(1e-3)
    while (gap := 2 * walls[1].state.pos[1]) > 0.1001 * RADIUS:
        duration = 2e-2
        for wall in walls:
            drive(wall, wall.shape.sense * (gap - max(0.85 * gap, 0.1 * RADIUS)) / 2 / duration)
        run.step = duration / 10
        run.go(duration)
    for wall in walls:
        drive(wall, -wall.shape.sense * RADIUS / 1e-2)
    run.step = 2e-4
    run.go(1e-2)
    for wall in walls:
        drive(wall, 0)
    if run.method == "quasistatic":
        run.go(2e-3)
    recovered(run)


def recovered(run):
    """Grains are discs again, to their last vibrations, and touch no plate."""
    for body in measures.softBodies():
        outline = arrays.outline(body)
        form = measures.extent(outline, 1) / measures.extent(outline, 0)
        run.require("grains are round again", abs(form - 1) < 0.1, f"#{body.id} ({form:.3f})")
        run.require("whole", abs(body.state.area() / body.shape.area() - 1) < 0.02, body.state.area() / body.shape.area())


def again(run):
    """Pressed to 0.95, released, pressed again: the second time as hard as the first, within rearrangements."""
    top, duration = packing(run)
    peaks = []
    for _ in range(2):
        drive(top, -SPEED)
        run.go(duration)
        peaks.append(run.soft.elasticEnergy())
        drive(top, SPEED)
        run.go(duration)
    run.require("the second compaction stores as much", 0.3 < peaks[1] / peaks[0] < 3, peaks)


def fast_cycles(run):
    """A grain under a wall that goes up and down by a tenth of R, 20 times, at 2 m/s: it loses touch and is hit again."""
    disc(0, RADIUS)
    plate(1, 0, 1)
    top = plate(1, 2 * RADIUS, -1)
    run.begin(2e-6)
    for half in range(40):
        drive(top, 2.0 if half % 2 else -2.0)
        run.go(0.1 * RADIUS / 2)


ALL = ("explicit", "updated", "implicit", "quasistatic")
run_cases(*[(f"held packing, friction {mu:g}" + ", long" * LONG, ALL, held(mu))
            for mu in (0, 0.5, 1, 10)],
          ("five grains pressed to 5 % and released", ("implicit", "quasistatic") + ("explicit",) * LONG, flat_and_back),
          ("compaction, release, compaction", ALL, again),
          ("fast cycles of a wall", ALL[:3], fast_cycles),
          known=[("five grains pressed to 5 %", "quasistatic", "forces find no balance"),
                 ("held packing, friction 10", "updated", SWEEPS)])
