# SPDX-License-Identifier: GPL-2.0-or-later
"""What the scenes of rigid_discs.py share: the discs, the clock, and what is looked at while it stands still."""
import json
import math
import time

import numpy
from scipy.spatial import cKDTree

DENSITY, FRICTION, GRAVITY = 1000.0, 0.3, 9.81      # [kg/m3], [-], [m/s2]
LOOKS = 200                                         # at the discs in a run


def load(path):
    """The cloud that scene.py wrote: radii [m] (count,), centres [m] (count, 2), width and height of the box [m]."""
    with open(path) as file:
        cloud = json.load(file)
    return numpy.array(cloud["radii"]), numpy.array(cloud["places"]), cloud["width"], cloud["height"]


def overlap(radii, places, width):
    """Deepest overlap of two discs, or of one and the floor or a side [radius of the smaller]."""
    pairs = cKDTree(places).query_pairs(2 * radii.max(), output_type="ndarray")
    one, two = pairs.T
    depths = radii[one] + radii[two] - numpy.linalg.norm(places[one] - places[two], axis=1)
    of_sides = [(radii - gap) / radii for gap in (places[:, 0], width - places[:, 0], places[:, 1])]
    return float(max(0, (depths / numpy.minimum(radii[one], radii[two])).max(initial=0), *(side.max() for side in of_sides)))


def solid_fraction(radii, places, width):
    """Of a bed that fills the box evenly up to twice the height of its centre of mass."""
    area = math.pi * radii**2
    return float(area.sum() / (2 * width * numpy.average(places[:, 1], weights=area)))


def mean_speed(radii, velocities):
    """Root of the mean square [m/s], by mass; turns left out."""
    return float(math.sqrt(numpy.average((velocities**2).sum(axis=1), weights=radii**2)))


def run(radii, width, until, step, state):
    """Calls step() until its time [s] has come; state() gives places and velocities (count, 2). The clock, of CPU time,
    stands still while the discs are looked at."""
    seconds, now, deepest = 0.0, 0.0, 0.0
    for look in range(1, LOOKS + 1):
        begin = time.process_time()
        while now < until * look / LOOKS * (1 - 1e-9):
            now = step()
        seconds += time.process_time() - begin
        places, velocities = state()
        deepest = max(deepest, overlap(radii, places, width))
    return {"cpu_s": seconds, "deepest": deepest, "last": overlap(radii, places, width),
            "solid_fraction": solid_fraction(radii, places, width), "speed": mean_speed(radii, velocities)}


def tell(**result):
    print("RESULT " + json.dumps(result), flush=True)
