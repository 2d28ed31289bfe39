# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs: a grain that spins freely and one that bounces between plates, 20,000 steps, 1,000,000 in the long form; a shaken
packing, whose memory must not grow. Explicit: implicit steps dissipate by design."""
import math
import os
import resource
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import LONG, RADIUS, disc, drive, gel, plate, run_cases, square_box  # noqa: E402
from softgrain import arrays, softCloud  # noqa: E402
from yade import O  # noqa: E402

STEPS = 1000000 if LONG else 20000


def steps_of(run, count):
    """Time of so many steps [s]."""
    run.most_steps = math.inf
    return count * O.dt


def spinning(run):
    """At 3,000 rad/s its rim is as fast as a tenth of the shear waves."""
    body = disc(0, 0, spin=3000.0, velocity=(1, 0, 0))
    run.begin(1e-6)
    momentum = angular(body)
    run.go(steps_of(run, STEPS))
    drift = angular(body) / momentum - 1
    run.note = f"angular momentum {drift:+.1e}"
    # of the points; the steps keep that of lumped masses, and the grain breathes
    run.require("angular momentum within 1 %", abs(drift) < 1e-2)


def angular(body):
    x, v = arrays.points(body) - tuple(body.state.pos)[:2], arrays.pointVelocities(body) - tuple(body.state.vel)[:2]
    return arrays.pointVolumes(body) @ (x[:, 0] * v[:, 1] - x[:, 1] * v[:, 0])


def bouncing(run):
    """Between plates 2.2 R apart at first 3 m/s, spinning: its energy goes into vibrations and stays."""
    disc(0, 0, spin=1000.0, velocity=(0, 3, 0))
    plate(1, -1.1 * RADIUS, 1)
    plate(1, 1.1 * RADIUS, -1)
    run.begin(1e-6)
    run.go(steps_of(run, STEPS))


def shaken(run):
    """Six grains in a box whose lid goes up and down."""
    width = 4e-3
    grains, height = softCloud(width, 6, (1.4e-3, 2.0e-3), 0.65, gel(), points=60, seed=2)
    O.bodies.append(grains)
    lid = square_box(0, width, 0, height)[-1]
    run.begin(1e-6, friction=0.3)
    rounds = 20
    duration = steps_of(run, STEPS / rounds / 2)
    speed = 0.1 * height / duration
    for k in range(rounds):
        for sign in (-1, 1):
            drive(lid, sign * speed)
            run.go(duration)
        if k == 2:
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    growth = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) / 1024
    run.note = f"memory {growth:+.1f} MB"
    run.require("memory grows by less than 5 MB", growth < 5)


run_cases((f"spinning grain, {STEPS} steps", ("explicit", "updated"), spinning),
          (f"bouncing grain, {STEPS} steps", ("explicit", "updated"), bouncing),
          (f"shaken packing, {STEPS} steps", ("explicit", "updated"), shaken))
