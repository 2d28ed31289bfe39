# SPDX-License-Identifier: GPL-2.0-or-later
"""What a soft grain holds, as numpy arrays. Each function takes a body of the running scene; arrays are copies,
SI units, current frame unless said otherwise. Raise InputError for a body that is no soft grain."""
import numpy
import yade.wrapper as wrapper

from .checks import InputError


def points(body):
    """Current positions of the material points [m], shape (points, 2)."""
    return _array(_state(body).pointPositions(), 2)


def pointReferences(body):
    """Positions of the material points as the grain was placed, before it moved and deformed [m], shape (points, 2)."""
    return _array(_state(body).pointReferences(), 2)


def pointVelocities(body):
    """Velocities of the material points [m/s], shape (points, 2)."""
    return _array(_state(body).pointVelocities(), 2)


def pointVolumes(body):
    """Reference areas of the material points [m²], shape (points,)."""
    return _array(_state(body).pointVolumes())


def deformationGradients(body):
    """Deformation gradients F at the material points [-], shape (points, 2, 2)."""
    return _array(_state(body).deformationGradients(), 2, 2)


def volumeRatios(body):
    """J = det F at the material points [-], shape (points,)."""
    return numpy.linalg.det(deformationGradients(body))


def cauchyStresses(body):
    """Cauchy stresses at the material points [Pa], tension positive, shape (points, 3, 3)."""
    return _array(_state(body).cauchyStress(), 3, 3)


def vonMisesStresses(body):
    """Von Mises stresses at the material points [Pa], shape (points,)."""
    stress = cauchyStresses(body)
    mean = numpy.trace(stress, axis1=1, axis2=2) / 3
    deviator = stress - mean[:, None, None] * numpy.eye(3)
    return numpy.sqrt(1.5 * numpy.sum(deviator**2, axis=(1, 2)))


def pressures(body):
    """Pressures, minus the mean Cauchy stresses, at the material points [Pa], shape (points,)."""
    return -numpy.trace(cauchyStresses(body), axis1=1, axis2=2) / 3


def plasticStrains(body):
    """Plastic strains that have gathered at the material points [-], shape (points,): the integral of the rate
    sqrt(2/3) |D_p|; 0 where the material has no plasticity."""
    return _array(_state(body).plasticStrains())


def outline(body):
    """Current boundary, counter-clockwise [m], shape (surface points, 2)."""
    return _array(_state(body).outline(), 2)


def _state(body):
    """The SoftState of a body, or InputError."""
    state = getattr(body, "state", None)
    if isinstance(state, wrapper.SoftState):
        return state
    what = f"body #{body.id}, a {type(body.shape).__name__}," if isinstance(body, wrapper.Body) else repr(body)
    raise InputError(f"{what} is no soft grain: give a body that softDisc or softPolygon made.")


def _array(content, *shape):
    return numpy.frombuffer(content, dtype="<f8").reshape(-1, *shape).copy()
