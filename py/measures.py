# SPDX-License-Identifier: GPL-2.0-or-later
"""Measures of a running scene: solid fraction, coordination, rattlers, stresses on walls."""
import math

import numpy
import yade.wrapper as wrapper
from yade import O

from .checks import InputError


def softIntegrator():
    """The SoftIntegrator in O.engines. Raises InputError when there is none."""
    for engine in O.engines:
        if isinstance(engine, wrapper.SoftIntegrator):
            return engine
    raise InputError("O.engines holds no SoftIntegrator: set O.engines = softEngines().")


def heldOrLost(soft):
    """What soft grains hold, elastic and kinetic, and what they have lost since the start, by a SoftIntegrator [J/m]: its
    externalWork, if they started at rest and none is missing. adhesionWork stands apart."""
    return (soft.kineticEnergy() + soft.elasticEnergy() + soft.frictionDissipation + soft.contactDissipation
            + soft.viscousDissipation + soft.plasticDissipation + soft.dampingDissipation
            + getattr(soft, "numericalDissipation", 0.0))


def softBodies():
    """The bodies of O.bodies that are soft grains."""
    return [body for body in O.bodies if isinstance(body.shape, wrapper.SoftGrain)]


def referenceArea():
    """Sum of the areas of the undeformed grains [m²]."""
    return math.fsum(body.shape.area() for body in softBodies())


def pointTotal():
    """Number of material points of all grains [-]."""
    return sum(body.shape.pointCount() for body in softBodies())


def solidFraction(boxArea):
    """Sum of the current areas of the grains over the area [m²] of the box [-]. InputError without a SoftIntegrator."""
    return softIntegrator().solidArea() / boxArea


def volumeChange(area, reference):
    """ln(Vs / Vs0) of a current and a reference total area of the grains [-] (Vu et al. 2017, eq. 9)."""
    return math.log(area / reference)


def wallStress(wall, axis, length):
    """Mean normal stress [Pa], compression positive, on the wall with this body id, of the last step: force along
    `axis` (0: x, 1: y) per thickness over the loaded length [m]."""
    return abs(O.forces.f(wall)[axis]) / length


def contactPairs():
    """Pairs (id1, id2) of bodies with a force between them in the last step, each once. InputError without a
    SoftIntegrator."""
    return [(contact[0], contact[1]) for contact in softIntegrator().contacts()]


def rigidContactPairs():
    """The same of YADE's rigid bodies: pairs of the real interactions with a normal force."""
    return [(i.id1, i.id2) for i in O.interactions if i.phys.normalForce.norm() > 0]


def coordination(pairs, grains, frictional):
    """Mean number of contacts of the grains that carry force, contacts with walls included, and the number of
    rattlers: (Z, rattlers, contacts).

    pairs       (id1, id2) of touching bodies, walls too
    grains      ids of the grains
    frictional  a grain carries force from 2 contacts on with friction, from 3 on without

    Rattlers are taken away, with their contacts, until none is left. contacts counts the pairs given. Z is NaN
    when all grains are rattlers.
    """
    least = 2 if frictional else 3
    neighbours = {grain: set() for grain in grains}
    for one, other in pairs:
        if one in neighbours:
            neighbours[one].add(other)
        if other in neighbours:
            neighbours[other].add(one)
    loose = [grain for grain, others in neighbours.items() if len(others) < least]
    while loose:
        rattler = loose.pop()
        for other in neighbours.pop(rattler):
            if other in neighbours:
                neighbours[other].discard(rattler)
                if len(neighbours[other]) == least - 1:
                    loose.append(other)
    rattlers = len(grains) - len(neighbours)
    carried = sum(len(others) for others in neighbours.values())
    return (carried / len(neighbours) if neighbours else math.nan), rattlers, len(pairs)


def extent(outline, axis):
    """Largest extent [m] of a boundary, shape (points, 2), along an axis (0: x, 1: y): between the tops of the
    parabolas through the outermost points and their neighbours."""
    return _outermost(outline, axis, 1) + _outermost(outline, axis, -1)


def contactHalfWidth(outline, axis, wall, tolerance):
    """Half the length [m] along which a grain lies on a wall.

    outline    boundary, shape (points, 2) [m]
    axis       of the wall's normal (0: x, 1: y); wall: the wall's coordinate on that axis [m]
    tolerance  gap up to which a point touches [m]

    Beyond its end the gap opens as (distance)^1.5, as between smooth bodies: the end is where the parabola for the
    distance along the boundary, as a function of gap^(2/3), through up to four points after the last touching one,
    meets gap 0. 0 when no point touches.
    """
    gap = numpy.abs(outline[:, axis] - wall)
    along = outline[:, 1 - axis]
    touching = numpy.flatnonzero(gap <= tolerance)
    if not len(touching):
        return 0.0
    ends = []
    for sign in (-1, 1):
        last = touching[numpy.argmax(sign * along[touching])]
        side = 1 if sign * (along[(last + 1) % len(gap)] - along[last - 1]) > 0 else -1
        after = (last + side * numpy.arange(5)) % len(gap)
        # up to where the boundary turns back, or up another wall
        free = int(numpy.cumprod(sign * numpy.diff(along[after]) > tolerance).sum())
        path = numpy.append(0, numpy.cumsum(numpy.linalg.norm(numpy.diff(outline[after], axis=0), axis=1)))
        end = 0.0
        if free > 1:
            fit = numpy.polyfit(gap[after[1:free + 1]]**(2 / 3), path[1:free + 1], min(2, free - 1))
            end = min(max(fit[-1], 0.0), path[1])
        ends.append(along[last] + sign * end)
    return (ends[1] - ends[0]) / 2


def _outermost(outline, axis, sign):
    """Largest coordinate along sign * axis, at the top of the parabola through three points [m]."""
    out, along = sign * outline[:, axis], outline[:, 1 - axis]
    top = int(numpy.argmax(out))
    three = [top - 1, top, (top + 1) % len(out)]
    here = along[three] - along[top]
    curve, slope, level = numpy.polyfit(here / numpy.ptp(here), out[three], 2)
    return level - slope**2 / (4 * curve) if curve < 0 else out[top]
