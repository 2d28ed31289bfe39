# SPDX-License-Identifier: GPL-2.0-or-later
"""What flights of grains save while a packing is loose: yade -n -x tests/benchmarks/loose.py [GRAINS POINTS]

The same cloud of viscous discs, sinking under gravity and compacted at 0.1 m/s, with grains that always deform (a spin of 1e-9
rad/s keeps them from the flight that an undeformed grain starts with), with grains that deform from their first contact on
(rigidBelow=0), and with such that become rigid again (1e-2). Prints, window by window, the share of grains that move as rigid
bodies or rest at its end, the CPU time of the steps [s], and the first time over the others.
"""
import sys
import time

from softgrain import *
from softgrain.builders import widthOfSquareCloud

words = sys.argv[1:] + ["100", "276"][len(sys.argv) - 1:]
GRAINS, POINTS = map(int, words)
DIAMETERS, MU, WINDOWS = (1.4e-3, 2.4e-3), 1e5, 8


def scene(fraction, below, **engines):
    """The cloud in its box; the top wall of that."""
    O.reset()
    O.materials.append(NeoHookeanMat(lambda_=50 * MU, mu=MU, viscosity=2.0, frictionAngle=0.2, label="gel"))
    O.materials.append(FrictMat(frictionAngle=0.2, label="steel"))
    width = widthOfSquareCloud(GRAINS, DIAMETERS, fraction)
    cloud, height = softCloud(width, GRAINS, DIAMETERS, fraction, "gel", POINTS, seed=1)
    if below is None:
        for body in cloud:
            body.state.angVel = (0, 0, 1e-9)
    O.bodies.append(cloud)
    walls = O.bodies.append(softBox(width, height, "steel"))
    O.engines = softEngines(rigidBelow=below or 0, **engines)
    return O.bodies[walls[3]], height


def windows(goes_on):
    """Share of rigid grains at the end, and CPU time of the steps, while each of these holds."""
    rows, soft = [], measures.softIntegrator()
    for going in goes_on:
        start = time.process_time()
        while going():
            O.step()
        rows.append((soft.rigidCount / GRAINS, time.process_time() - start))
    return rows


def sinking(below):
    scene(0.35, below, gravity=(0, -9.81, 0))
    return windows([lambda end=5e-3 * (k + 1): O.time < end for k in range(WINDOWS)])


def compacted(below):
    top, height = scene(0.6, below)
    top.state.vel = (0, -0.1, 0)
    return windows([lambda end=height * 0.6 / (0.6 + 0.025 * (k + 1)): top.state.pos[1] > end for k in range(WINDOWS)])


print(f"{GRAINS} discs of {POINTS} points, seed 1")
for name, case in (("sinking, 5 ms a window", sinking), ("compacted, 0.025 of solid fraction a window", compacted)):
    runs = [case(below) for below in (None, 0.0, 1e-2)]
    print(f"{name}\nrigid            CPU time              ratio")
    for rows in zip(*runs):
        shares, times = zip(*rows)
        print("  ".join(f"{share:4.2f}" for share in shares) + "  " + "  ".join(f"{time:6.2f}" for time in times)
              + "  " + "  ".join(f"{times[0] / time:5.1f}" for time in times[1:]), flush=True)
    totals = [sum(time for _, time in rows) for rows in runs]
    print("in all            " + "  ".join(f"{time:6.2f}" for time in totals) + "  "
          + "  ".join(f"{totals[0] / time:5.1f}" for time in totals[1:]), flush=True)
