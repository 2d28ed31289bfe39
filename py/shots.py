# SPDX-License-Identifier: GPL-2.0-or-later
"""Shots: what a scene shows at one moment, as arrays that pictures.py draws, also later and without YADE.

A shot is a dict of numpy arrays, and a npz file of the same:

    time            [s]
    outlines        corners of all soft grains one after the other [m], shape (corners, 2); outline_sizes: corners of each grain;
                    rounded: whether its outline is smooth
    points          material points of all soft grains [m], shape (points, 2); point_sizes: points of each grain
    fields          names of what is known of the points; labels and units of each; values, shape (fields, points)
    rigid_outlines  corners of rigid bodies [m]; rigid_sizes: corners of each
    walls           axis (0: x, 1: y) of the normal and place on it [m] of each wall, shape (walls, 2)
    contact_lines   from centres of bodies to their contacts [m], shape (lines, 2, 2); contact_forces: normal forces there [N/m]
"""
import numpy
import yade.wrapper as wrapper
from yade import O

from . import arrays, measures, rigid, stresses
from .checks import InputError
from .records import replacing


def _speeds(body):
    return numpy.linalg.norm(arrays.pointVelocities(body), axis=1)


def _displacements(body):
    return numpy.linalg.norm(arrays.displacements(body), axis=1)


def _stretches(body):
    return arrays.principalStretches(body)[:, 0]


# Name, label, unit, and the function from a soft body to its values, one a material point or one for the grain.
FIELDS = {
    "vonMises": ("von Mises stress", "Pa", arrays.vonMisesStresses),
    "pressure": ("pressure", "Pa", arrays.pressures),
    "J": ("volume ratio J", "-", arrays.volumeRatios),
    "stretch": ("largest principal stretch", "-", _stretches),
    "plasticStrain": ("plastic strain", "-", arrays.plasticStrains),
    "velocity": ("speed", "m/s", _speeds),
    "displacement": ("displacement", "m", _displacements),
    "id": ("id of the body", "", lambda body: body.id),
}


def take(field="vonMises", label=None, unit=None):
    """The shot of the scene as it is. Arguments: those of snapshot(); raises InputError."""
    soft, contacts = measures.softBodies(), _contacts()
    outlines, points = zip(*map(_outline_and_points, soft)) if soft else ((), ())
    sizes = [len(part) for part in points]
    rows = [_values(one, soft, sizes, label, unit) for one in _names(field)]
    outlines_of_rigid = [outline for outline in map(rigid.outline, O.bodies) if outline is not None]
    walls = [(body.shape.axis, body.state.pos[body.shape.axis]) for body in O.bodies
             if isinstance(body.shape, wrapper.Wall) and body.shape.axis < 2]
    if not (soft or outlines_of_rigid):
        raise InputError("the scene has nothing to draw: append soft grains, spheres, boxes or facets to O.bodies first.")
    return {"time": numpy.float64(O.time), "outlines": _joined(outlines, 2), "outline_sizes": numpy.array([len(o) for o in outlines], dtype=int),
            "rounded": numpy.array([not body.shape.vertices for body in soft], dtype=bool),
            "points": _joined(points, 2), "point_sizes": numpy.array(sizes, dtype=int),
            "fields": numpy.array([row[0] for row in rows], dtype=str), "labels": numpy.array([row[1] for row in rows], dtype=str),
            "units": numpy.array([row[2] for row in rows], dtype=str),
            "values": numpy.array([row[3] for row in rows]).reshape(len(rows), sum(sizes)),
            "rigid_outlines": _joined(outlines_of_rigid, 2),
            "rigid_sizes": numpy.array([len(o) for o in outlines_of_rigid], dtype=int),
            "walls": numpy.array(walls, dtype=float).reshape(-1, 2), "contact_lines": contacts[0], "contact_forces": contacts[1]}


def save(path, shot):
    """Writes a shot to a npz file, in one stroke, numbers with seven digits."""
    small = {name: part.astype(numpy.float32) if part.dtype == float and part.ndim else part for name, part in shot.items()}
    with replacing(path) as unfinished:
        numpy.savez_compressed(unfinished, **small)


def _names(field):
    """The fields that are asked for, a list."""
    if field is None:
        return []
    return list(field) if isinstance(field, (list, tuple)) and all(isinstance(one, str) for one in field) else [field]


def _values(field, soft, sizes, label, unit):
    """Name, label, unit and values at all points of a field that is named, a function of a body, or an array."""
    if isinstance(field, str):
        if field not in FIELDS:
            raise InputError(f"field '{field}' is none: give {', '.join(map(repr, FIELDS))}, a function of a body, an array, or None.")
        known_label, known_unit, field_of = FIELDS[field]
        name, label, unit = field, label or known_label, known_unit if unit is None else unit
        parts = [field_of(body) if size else () for body, size in zip(soft, sizes)]
    elif callable(field):
        name, parts = getattr(field, "__name__", "field"), [field(body) if size else () for body, size in zip(soft, sizes)]
    else:
        name, parts = "field", _parts(field, sizes)
    columns = []
    for body, part, size in zip(soft, parts, sizes):
        try:
            columns.append(numpy.broadcast_to(numpy.asarray(part, dtype=float), size))
        except (TypeError, ValueError):
            raise InputError(f"field '{name}' gives {numpy.shape(part) or type(part).__name__} for soft grain #{body.id}: give a number for "
                             f"the grain, or one for each of its {size} material points.") from None
    return name, str(label or name), str(unit or ""), numpy.concatenate(columns) if columns else numpy.empty(0)


def _parts(values, sizes):
    """An array of values, one a grain or one a point, cut into those of each grain."""
    try:
        values = numpy.asarray(values, dtype=float)
    except (TypeError, ValueError):
        raise InputError(f"field is a {type(values).__name__}: give a name, a function of a body, or numbers.") from None
    if values.shape == (len(sizes),):
        return values
    if values.shape != (sum(sizes),):
        raise InputError(f"field has the shape {values.shape}: give {len(sizes)} numbers, one a soft grain, or {sum(sizes)}, one a material "
                         "point.")
    return numpy.split(values, numpy.cumsum(sizes)[:-1])


def _outline_and_points(body):
    """Of a soft grain; undeformed and without points as long as it has not run a step."""
    try:
        return arrays.outline(body), arrays.points(body)
    except ValueError:
        corners = body.shape.vertices or rigid.circle(body.shape.radius)
        return rigid.placed(body, corners)[:, :2], numpy.empty((0, 2))


def _contacts():
    """contact_lines and contact_forces of a shot; none where there is no SoftIntegrator."""
    try:
        contacts = stresses.forceChains(0)
    except InputError:
        return numpy.empty((0, 2, 2)), numpy.empty(0)
    lines, forces = [], []
    for column in (0, 1):
        for body, place, force, normal in zip(contacts.ids[:, column], contacts.places, contacts.forces, contacts.normals):
            body = O.bodies[int(body)]
            if not isinstance(body.shape, (wrapper.SoftGrain, wrapper.Sphere)):
                continue
            lines.append([(body.state.pos[0], body.state.pos[1]), place])
            forces.append(force @ normal)
    return numpy.array(lines, dtype=float).reshape(-1, 2, 2), numpy.array(forces, dtype=float)


def _joined(parts, columns):
    return numpy.concatenate(parts) if parts else numpy.empty((0, columns))
