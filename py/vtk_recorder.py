# SPDX-License-Identifier: GPL-2.0-or-later
"""What SoftVTKRecorder writes: the scene as blocks of cells with fields. vtk_files.py turns them into files."""
import functools

import numpy
import yade.wrapper as wrapper
from yade import O

from . import arrays, measures, rigid, stresses, vtk_files
from .checks import InputError


def record(engine):
    """One run of a SoftVTKRecorder. Raises InputError."""
    blocks, fields = chosen(engine.recorders)
    scene = Scene([body for body in O.bodies if engine.mask == 0 or body.mask & engine.mask])
    written = {}
    for name in blocks:
        outlines, whole = BLOCKS[name](scene)
        values = {field: column(scene) for field, column in FIELDS[name].items() if field in fields}
        written[name] = vtk_files.Block(outlines, whole, values)
    vtk_files.write(engine.fileName, written, vtk_files.Moment(O.iter, O.time, O.tags["id"]), engine.ascii, engine.compress)


def chosen(recorders):
    """Names of the blocks and of the fields that these recorders ask for. Raises InputError."""
    known = ["all", *BLOCKS, *dict.fromkeys(name for fields in FIELDS.values() for name in fields)]
    for name in recorders:
        if name not in known:
            raise InputError(f"SoftVTKRecorder: recorders holds {name!r}: take any of {', '.join(known)}.")
    if "all" in recorders:
        return list(BLOCKS), known
    blocks = [name for name in BLOCKS if name in recorders]
    if not blocks:
        raise InputError(f"SoftVTKRecorder: recorders is {list(recorders)!r}, which names no block: add one or more of "
                         f"{', '.join(BLOCKS)}, or 'all'.")
    return blocks, list(recorders)


class Scene:
    """These bodies as they are now; what several fields need is taken once, when the first of them asks for it."""

    def __init__(self, bodies):
        self.bodies = bodies
        self.soft = [body for body in bodies if isinstance(body.shape, wrapper.SoftGrain)]
        soft = measures.softBodies()
        self.height = soft[0].state.pos[2] if soft else 0.0     # of the plane of the grains [m]

    def at_points(self, array):
        """What a function of arrays.py gives for each soft grain, one grain after the other."""
        return numpy.concatenate([array(body) for body in self.soft]) if self.soft else numpy.zeros((0, 1))

    def at_all_points(self, value):
        """A number of each soft grain, at all its material points."""
        return numpy.repeat([value(body) for body in self.soft], [body.shape.pointCount() for body in self.soft])

    @functools.cached_property
    def gradients(self):
        return self.at_points(arrays.deformationGradients).reshape(-1, 2, 2)

    @functools.cached_property
    def stress(self):
        return self.at_points(arrays.cauchyStresses).reshape(-1, 3, 3)

    @functools.cached_property
    def mean_stress(self):
        """Of each soft grain, over its area now."""
        if not self.soft:
            return self.stress
        first = numpy.cumsum([0] + [body.shape.pointCount() for body in self.soft[:-1]])
        area = self.at_points(arrays.pointVolumes) * arrays.volumeRatio(self.gradients)
        sums = numpy.add.reduceat(area[:, None, None] * self.stress, first)
        return sums / numpy.add.reduceat(area, first)[:, None, None]

    @functools.cached_property
    def contacts(self):
        """With both bodies among these."""
        contacts = stresses.contactPoints()
        here = numpy.isin(contacts.ids, [body.id for body in self.bodies]).all(axis=1)
        return stresses.Contacts(*(part[here] for part in contacts))

    @functools.cached_property
    def rigid(self):
        """Rigid bodies and their outlines; lines first, which is VTK's order of cells. Walls are as long as the scene."""
        extent = self._extent()
        outlines = [(body, rigid.wallLine(body, *extent) if isinstance(body.shape, wrapper.Wall) else rigid.outline(body, self.height))
                    for body in self.bodies]
        return sorted(((body, outline) for body, outline in outlines if outline is not None), key=lambda shown: len(shown[1]) > 2)

    def _extent(self):
        """Limits (least, largest) of x and of y of all bodies [m]."""
        limits = [], []
        for body in self.bodies:
            if isinstance(body.shape, wrapper.Wall):
                if body.shape.axis < 2:
                    limits[body.shape.axis].append(body.state.pos[body.shape.axis])
                continue
            outline = arrays.outline(body) if isinstance(body.shape, wrapper.SoftGrain) else rigid.outline(body, self.height)
            if outline is not None:
                for along, values in zip(limits, outline.T):
                    along.extend((values.min(), values.max()))
        return [(min(along, default=0.0), max(along, default=0.0)) for along in limits]


def _of_soft(value):
    return lambda scene: numpy.array([value(body) for body in scene.soft])


def _of_rigid(value):
    return lambda scene: numpy.array([value(body) for body, _ in scene.rigid])


def _at_points(array):
    return lambda scene: scene.at_points(array)


def _components(stress):
    """xx, yy, zz, xy, yz, xz, VTK's order, of symmetric tensors."""
    return numpy.stack([stress[..., i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))], axis=-1)


OF_BODY = {"id": lambda body: body.id, "materialId": lambda body: body.mat.id if body.mat else -1, "mask": lambda body: body.mask}
OF_MOTION = {"displacement": lambda body: body.state.displ(), "velocity": lambda body: body.state.vel,
             "angVel": lambda body: body.state.angVel[2]}

# of each block its cells, as outlines and whether each of them is one cell (else each place is)
BLOCKS = {
    "grains": lambda scene: ([arrays.outline(body) for body in scene.soft], True),
    "points": lambda scene: ([arrays.points(body) for body in scene.soft], False),
    "contacts": lambda scene: ([scene.contacts.places], False),
    "rigid": lambda scene: ([outline for _, outline in scene.rigid], True),
}
# and its fields, with a row a cell
FIELDS = {
    "grains": {**{name: _of_soft(value) for name, value in {**OF_BODY, **OF_MOTION}.items()},
               "J": _of_soft(lambda body: body.state.area() / body.shape.area()),
               "stress": lambda scene: _components(scene.mean_stress),
               "pressure": lambda scene: arrays.pressure(scene.mean_stress),
               "vonMises": lambda scene: arrays.vonMises(scene.mean_stress)},
    "points": {**{name: functools.partial(Scene.at_all_points, value=value) for name, value in OF_BODY.items()},
               "displacement": _at_points(arrays.displacements), "velocity": _at_points(arrays.pointVelocities),
               "J": lambda scene: arrays.volumeRatio(scene.gradients),
               "stretches": lambda scene: arrays.stretches(scene.gradients),
               "stress": lambda scene: _components(scene.stress), "pressure": lambda scene: arrays.pressure(scene.stress),
               "vonMises": lambda scene: arrays.vonMises(scene.stress), "plasticStrain": _at_points(arrays.plasticStrains)},
    "contacts": {"id1": lambda scene: scene.contacts.ids[:, 0], "id2": lambda scene: scene.contacts.ids[:, 1],
                 "normal": lambda scene: scene.contacts.normals, "force": lambda scene: scene.contacts.forces,
                 "normalForce": lambda scene: numpy.sum(scene.contacts.forces * scene.contacts.normals, axis=1)},
    "rigid": {**{name: _of_rigid(value) for name, value in {**OF_BODY, **OF_MOTION}.items()},
              "force": _of_rigid(lambda body: O.forces.f(body.id)), "torque": _of_rigid(lambda body: O.forces.t(body.id)[2])},
}
