# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies as the plane of the grains cuts them."""
import math

import numpy
import yade.wrapper as wrapper
from yade.minieigenHP import Vector3

CORNERS = 64    # of a disc


def outline(body, height=0.0):
    """Corners now [m], shape (corners, 2), of what a plane z = height [m] cuts from a sphere, a box, or a facet: a circle, a
    rectangle, a line. None where it cuts nothing, and for other bodies. The rectangle is that of the box's x and y extents."""
    if isinstance(body.shape, wrapper.Sphere):
        off = height - body.state.pos[2]
        if abs(off) >= body.shape.radius:
            return None
        local = circle(math.sqrt(body.shape.radius**2 - off**2))
    elif isinstance(body.shape, wrapper.Box):
        x, y = body.shape.extents[0], body.shape.extents[1]
        local = numpy.array([(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)])
    elif isinstance(body.shape, wrapper.Facet):
        return _cut(placed(body, body.shape.vertices), height)
    else:
        return None
    return placed(body, local)[:, :2]


def circle(radius):
    """Corners of a disc about the origin [m], shape (corners, 3)."""
    turn = numpy.linspace(0, 2 * math.pi, CORNERS, endpoint=False)
    return radius * numpy.column_stack([numpy.cos(turn), numpy.sin(turn), 0 * turn])


def placed(body, corners):
    """Where corners in the frame of a body, shape (corners, 3), are now [m]."""
    return numpy.array([body.state.pos + body.state.ori * Vector3(*map(float, corner)) for corner in corners])


def wallLine(body, x, y):
    """Both ends [m], shape (2, 2), of a wall along the part of the plane with these limits (least, largest) of x and y [m]. None for
    a wall along the plane."""
    axis = body.shape.axis
    if axis == 2:
        return None
    ends = numpy.column_stack([x, y])
    ends[:, axis] = body.state.pos[axis]
    return ends


def _cut(corners, height):
    """Where a polygon in space meets the plane: two points, or None."""
    ends = [(a + (height - a[2]) / (b[2] - a[2]) * (b - a))[:2]
            for a, b in zip(corners, numpy.roll(corners, -1, axis=0)) if (a[2] >= height) != (b[2] >= height)]
    return numpy.array(ends) if len(ends) == 2 else None
