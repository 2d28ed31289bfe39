# SPDX-License-Identifier: GPL-2.0-or-later
"""Stresses in grains and packings, and the forces that carry them, of the last step. Tensors have shape (2, 2) or (3, 3), in the
world frame, positive in tension [Pa]; forces are per metre of thickness [N/m].

Two ways lead to the stress of a grain or a packing: the volume mean of Cauchy's stress over its material points, and the sum of
contact forces times places, Love and Weber (Weber 1966; Christoffersen, Mehrabadi and Nemat-Nasser 1981; Nicot, Hadda, Guessasma,
Fortin and Millet 2013). Where grains are at rest they agree, by the divergence theorem."""
import collections
import math

import numpy
import yade.wrapper as wrapper
from yade import O

from . import arrays, measures
from .checks import InputError, positive

Contacts = collections.namedtuple("Contacts", "ids places normals forces")


def contactPoints():
    """All contact points that bear a force, of soft grains with any body and of rigid bodies with each other, by Contact Dynamics or
    one of YADE's laws: a named tuple of numpy arrays

    ids      of the two bodies, shape (contacts, 2); a pair of a soft grain has as many rows as contact points
    places   [m], shape (contacts, 2)
    normals  from the first body to the second, shape (contacts, 2)
    forces   on the second body [N/m], shape (contacts, 2)
    InputError without a SoftIntegrator."""
    rows = numpy.frombuffer(measures.softIntegrator().contactPoints(), dtype="<f8").reshape(-1, 8)
    rows = numpy.concatenate([rows, _of_other_laws(rows)])
    return Contacts(rows[:, :2].astype(int), rows[:, 2:4].copy(), rows[:, 4:6].copy(), rows[:, 6:].copy())


def forceChains(share=1.0):
    """The contacts, one a pair of bodies, whose normal forces are at least `share` of their mean: with 1 the strong network of
    Radjai, Wolf, Jean and Moreau 1998; with 0 all. A named tuple as of contactPoints(), places weighted with normal forces, ordered by
    falling normal force. Raises InputError on a negative share."""
    if not share >= 0:
        raise InputError(f"forceChains: share is {share!r}: give 0 or more.")
    points = contactPoints()
    if not len(points.ids):
        return points
    pairs, pair = numpy.unique(points.ids, axis=0, return_inverse=True)
    pair = pair.ravel()
    size = numpy.abs(_dot(points.forces, points.normals))

    def total(values):
        return numpy.column_stack([numpy.bincount(pair, column, len(pairs)) for column in values.T])

    weight = numpy.maximum(numpy.bincount(pair, size, len(pairs)), 1e-300)
    places = total(size[:, None] * points.places) / weight[:, None]
    normals = total(size[:, None] * points.normals)
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1), 1e-300)[:, None]
    forces = total(points.forces)
    normal = _dot(forces, normals)
    order = numpy.argsort(-normal, kind="stable")
    strong = order[normal[order] >= share * normal.mean()]
    return Contacts(pairs[strong], places[strong], normals[strong], forces[strong])


def ofGrain(body):
    """Mean Cauchy stress of a soft grain over its volume now, from its material points: (3, 3). Raises InputError for other bodies."""
    sums, area = _cauchy_sum(body)
    return sums / area


def ofGrainByContacts(body):
    """The same of a soft grain, a sphere or a box, from the forces of contacts on it: (2, 2). In a soft grain that is being accelerated
    the two differ; a rigid body has this one alone. Raises InputError for other bodies."""
    return _moments([body])[0] / _area(body)


def ofPacking(boxArea):
    """Mean stress over the area of a box [m²], voids included, from the material points: (3, 3). Of rigid grains, which have none,
    from contacts, in the plane. Raises InputError."""
    boxArea = positive("ofPacking: boxArea", boxArea, "m²")
    sums = sum((_cauchy_sum(body)[0] for body in measures.softBodies()), numpy.zeros((3, 3)))
    rigid = [body for body in _grains() if not isinstance(body.shape, wrapper.SoftGrain)]
    if rigid:
        sums[:2, :2] += _moments(rigid).sum(axis=0)
    return sums / boxArea


def ofPackingByContacts(boxArea):
    """The same from contacts alone (Love and Weber): (2, 2). Raises InputError."""
    boxArea = positive("ofPackingByContacts: boxArea", boxArea, "m²")
    return _moments(_grains()).sum(axis=0) / boxArea


def ofWalls(left, right, bottom, top):
    """The same from the forces on the four walls of a box, by their ids in the order of softBox(): (2, 2), moments of the forces over the
    area of the box; the sum of forces times places, so that friction on walls counts. Raises InputError."""
    ids = (left, right, bottom, top)
    for wall in ids:
        if wall not in range(len(O.bodies)) or not isinstance(getattr(O.bodies[wall], "shape", None), wrapper.Wall):
            raise InputError(f"ofWalls: body #{wall} is no Wall: give the ids that O.bodies.append(softBox(...)) returns.")
    x0, x1, y0, y1 = (O.bodies[wall].state.pos[axis] for wall, axis in zip(ids, (0, 0, 1, 1)))
    sums = numpy.zeros((2, 2))
    middle = numpy.array([x0 + x1, y0 + y1]) / 2
    for _, places, forces in _on([O.bodies[wall] for wall in ids], contactPoints()):
        sums -= forces.T @ (places - middle)        # what they do to the grains
    return sums / ((x1 - x0) * (y1 - y0))


def unbalancedForce():
    """Mean size of the sum of all forces on a grain, over the mean force of a contact [-]: utils.unbalancedForce() for grains whose
    contact forces O.forces does not hold. Contacts of Contact Dynamics chatter from step to step; SoftBoxController.currUnbalanced is
    a mean over steps. NaN without contacts. InputError without a SoftIntegrator."""
    pairs, grains = forceChains(0), _grains()
    if not len(pairs.ids) or not grains:
        return math.nan
    gravity = numpy.array(measures.softIntegrator().gravity)[:2]
    sums = numpy.array([body.state.mass * gravity + _applied(body) for body in grains])
    for rows, _, forces in _on(grains, pairs):
        numpy.add.at(sums, rows, forces)
    return float(numpy.linalg.norm(sums, axis=1).mean() / numpy.linalg.norm(pairs.forces, axis=1).mean())


def _applied(body):
    """What a script lets act on a soft grain through O.forces [N/m]; that of rigid bodies holds reactions too."""
    force = O.forces.f(body.id) if isinstance(body.shape, wrapper.SoftGrain) else O.forces.permF(body.id)
    return numpy.array([force[0], force[1]])


def _of_other_laws(rows):
    """Rows as of SoftIntegrator.contactPoints() of the contacts of YADE's laws."""
    known = set(map(tuple, rows[:, :2].astype(int).tolist()))
    found = []
    for i in O.interactions:
        if (i.id1, i.id2) in known or not hasattr(i.geom, "contactPoint") or not hasattr(i.phys, "shearForce"):
            continue
        force, place, normal = i.phys.normalForce + i.phys.shearForce, i.geom.contactPoint, i.geom.normal
        if force.norm() > 0:
            found.append([i.id1, i.id2, place[0], place[1], normal[0], normal[1], force[0], force[1]])
    return numpy.array(found).reshape(-1, 8)


def _grains():
    """The bodies that are soft grains, and the rigid ones that may move and are neither walls nor members of a clump."""
    return [body for body in O.bodies
            if isinstance(body.shape, wrapper.SoftGrain)
            or (body.dynamic and body.clumpId in (-1, body.id) and not isinstance(body.shape, wrapper.Wall))]


def _moments(bodies):
    """Of each body, the sum over its contacts of force times place from its centre [N]: (bodies, 2, 2), first index the force's."""
    centres = numpy.array([[body.state.pos[0], body.state.pos[1]] for body in bodies])
    moments = numpy.zeros((len(bodies), 2, 2))
    for rows, places, forces in _on(bodies, contactPoints()):
        numpy.add.at(moments, rows, forces[:, :, None] * (places - centres[rows])[:, None, :])
    return moments


def _on(bodies, contacts):
    """Of the contacts whose first, and of those whose second body is among these or a member of one: its place in the list, the
    place of the contact [m], and the force on it [N/m]."""
    number = {body.id: i for i, body in enumerate(bodies)}
    whole = {body.id: body.clumpId for body in O.bodies if body.clumpId >= 0}
    for column, sign in ((0, -1), (1, 1)):
        rows = numpy.array([number.get(whole.get(i, i), -1) for i in contacts.ids[:, column]], dtype=int)
        mine = rows >= 0
        yield rows[mine], contacts.places[mine], sign * contacts.forces[mine]


def _cauchy_sum(body):
    """Integral of Cauchy's stress over a soft grain [N], (3, 3), and its area by the material points [m²]."""
    area = arrays.pointVolumes(body) * arrays.volumeRatios(body)
    return numpy.einsum("p,pij->ij", area, arrays.cauchyStresses(body)), area.sum()


def _area(body):
    """Area of a grain now [m²]. Raises InputError."""
    if isinstance(body.shape, wrapper.SoftGrain):
        return body.state.area()
    if isinstance(body.shape, wrapper.Sphere):
        return math.pi * body.shape.radius**2
    if isinstance(body.shape, wrapper.Box):
        return 4 * body.shape.extents[0] * body.shape.extents[1]
    raise InputError(f"body #{body.id}, a {type(body.shape).__name__}, has no area here: give a soft grain, a sphere or a box.")


def _dot(a, b):
    return numpy.sum(a * b, axis=1)
