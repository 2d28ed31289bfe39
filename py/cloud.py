# SPDX-License-Identifier: GPL-2.0-or-later
"""Random places for discs in a rectangular box such that none touch: plain numpy, nothing of YADE.

Discs start at random points. While any two, or a disc and a side of the box, come nearer than a wished gap, they
push each other apart (pair potential (overlap)^2 / 2, descent with momentum by the FIRE rule of Bitzek et al.,
Phys. Rev. Lett. 97, 170201, 2006). The wished gap is what the spare room allows, so that the cloud is spread
evenly; the least gap that is accepted is much smaller.
"""
import math

import numpy

from .checks import InputError

LEAST_GAP = 1e-3        # least accepted gap between discs, and half of it to the box [mean radius]
EVEN_FRACTION = 0.76    # solid fraction of the discs grown by the wished gap
UTMOST_FRACTION = 0.80  # random packings of discs jam at 0.84: above this the descent is slow or never ends
MOST_MOVES = 3000       # of one attempt
ATTEMPTS = 8            # each from new random places


def random_radii(count, diameters, generator):
    """`count` radii [m]; the diameters are uniform between the two given ones [m]."""
    return 0.5 * generator.uniform(diameters[0], diameters[1], count)


def scatter(width, height, radii, generator):
    """Centres [m], shape (count, 2), of discs in [0, width] x [0, height] that do not touch. The same generator
    state gives the same places. Raises InputError when there is no room."""
    fraction = math.pi * numpy.sum(radii**2) / (width * height)
    if fraction > UTMOST_FRACTION:
        raise InputError(f"solid fraction {fraction:.3f} of the cloud is out of reach for discs that do not touch: "
                         f"ask for {UTMOST_FRACTION} or less.")
    if 2.002 * radii.max() > min(width, height):
        raise InputError(f"the box {width:g} m x {height:g} m of the cloud is too small for a disc of diameter "
                         f"{2 * radii.max():g} m: make the box wider or the discs smaller.")
    least = LEAST_GAP * radii.mean()
    wished = max(_gap_for(radii, width, height), 2 * least)
    sides = numpy.array([width, height])
    for _ in range(ATTEMPTS):
        grown = radii + wished / 2
        room = numpy.maximum(sides - 2 * grown[:, None], 0)
        places = grown[:, None] + generator.random((len(radii), 2)) * room
        places, overlap = _push_apart(places, grown, sides, wished / 2)
        if overlap <= wished - least:
            return places
        wished = max(wished / 2, 2 * least)
    raise InputError(f"no places were found for {len(radii)} discs that do not touch at solid fraction "
                     f"{fraction:.3f} in a box {width:g} m wide: ask for a smaller solid fraction or another width.")


def _gap_for(radii, width, height):
    """Gap [m] by which all discs can be kept apart until their grown outlines fill EVEN_FRACTION of the box."""
    # sum pi (r + g/2)^2 = EVEN_FRACTION w h, solved for g
    a, b = len(radii) / 4, radii.sum()
    c = numpy.sum(radii**2) - EVEN_FRACTION * width * height / math.pi
    return max(0.0, (-b + math.sqrt(max(b * b - 4 * a * c, 0.0))) / (2 * a))


def _push_apart(places, radii, sides, allowed):
    """Moves grown discs until no overlap exceeds `allowed` [m] or MOST_MOVES is reached: places, largest overlap."""
    skin = 0.3 * radii.mean()
    velocity = numpy.zeros_like(places)
    listed_at, pairs = None, None
    step, mixing, downhill = 0.3, 0.1, 0
    for _ in range(MOST_MOVES):
        if listed_at is None or numpy.max(numpy.sum((places - listed_at)**2, axis=1)) > (skin / 2)**2:
            listed_at, pairs = places.copy(), _near_pairs(places, radii, skin)
        force, worst = _repulsion(places, radii, sides, pairs)
        if worst <= allowed:
            break
        power = numpy.sum(force * velocity)
        if power > 0:
            downhill += 1
            speed = math.sqrt(numpy.sum(velocity**2) / max(numpy.sum(force**2), 1e-300))
            velocity = (1 - mixing) * velocity + mixing * speed * force
            if downhill > 5:
                step, mixing = min(1.1 * step, 0.8), 0.99 * mixing
        else:
            velocity[:] = 0
            step, mixing, downhill = max(0.5 * step, 0.05), 0.1, 0
        velocity += step * force
        places = places + step * velocity
    return places, worst


def _repulsion(places, radii, sides, pairs):
    """Force on each disc [m, unit stiffness] and the largest overlap [m]; an overlap with a side counts twice."""
    first, second = pairs
    across = places[second] - places[first]
    distance = numpy.maximum(numpy.hypot(across[:, 0], across[:, 1]), 1e-12 * radii[0])
    overlap = radii[first] + radii[second] - distance
    touching = overlap > 0
    first, second, overlap = first[touching], second[touching], overlap[touching]
    push = across[touching] * (overlap / distance[touching])[:, None]
    force = numpy.empty_like(places)
    for axis in range(2):
        force[:, axis] = (numpy.bincount(second, push[:, axis], len(places))
                          - numpy.bincount(first, push[:, axis], len(places)))
    low = numpy.maximum(radii[:, None] - places, 0)
    high = numpy.maximum(places + radii[:, None] - sides, 0)
    force += 2 * (low - high)
    return force, max(overlap.max(initial=0.0), 2 * low.max(), 2 * high.max())


def _near_pairs(places, radii, skin):
    """Index arrays of all pairs whose gap is below `skin`, found through a grid of cells."""
    size = 2 * radii.max() + skin
    cell = numpy.floor((places - places.min(axis=0)) / size).astype(int)
    columns = cell[:, 0].max() + 3
    key = (cell[:, 1] + 1) * columns + cell[:, 0] + 1
    order = numpy.argsort(key, kind="stable")
    ordered = key[order]
    found = []
    for shift in (0, 1, columns - 1, columns, columns + 1):
        begin = numpy.searchsorted(ordered, key + shift, "left")
        count = numpy.searchsorted(ordered, key + shift, "right") - begin
        first = numpy.repeat(numpy.arange(len(key)), count)
        within = numpy.arange(count.sum()) - numpy.repeat(numpy.cumsum(count) - count, count)
        second = order[numpy.repeat(begin, count) + within]
        keep = first < second if shift == 0 else slice(None)
        found.append((first[keep], second[keep]))
    first = numpy.concatenate([pair[0] for pair in found])
    second = numpy.concatenate([pair[1] for pair in found])
    across = places[second] - places[first]
    near = numpy.hypot(across[:, 0], across[:, 1]) < radii[first] + radii[second] + skin
    return first[near], second[near]
