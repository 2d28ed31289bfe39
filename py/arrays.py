# SPDX-License-Identifier: GPL-2.0-or-later
"""What a soft grain holds, as numpy arrays. Each function takes a body of the running scene; arrays are copies,
SI units, current frame unless said otherwise. Raise InputError for a body that is no soft grain."""
import numpy
import yade.wrapper as wrapper

from .checks import InputError


def points(body):
    """Current positions of the material points [m], shape (points, 2)."""
    return _array(_state(body).pointPositions(), 2)


def displacements(body):
    """Displacements of the material points [m], shape (points, 2), from where they lay in the undeformed grain when its
    body was put down (at state.refPos, turned by state.refOri)."""
    return points(body) - _array(_state(body).pointReferencePositions(), 2)


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
    return volumeRatio(deformationGradients(body))


def principalStretches(body):
    """Principal stretches in the plane at the material points [-], the larger first, shape (points, 2). The third is 1."""
    return stretches(deformationGradients(body))


def cauchyStresses(body):
    """Cauchy stresses at the material points [Pa], tension positive, shape (points, 3, 3)."""
    return _array(_state(body).cauchyStress(), 3, 3)


def vonMisesStresses(body):
    """Von Mises stresses at the material points [Pa], shape (points,)."""
    return vonMises(cauchyStresses(body))


def pressures(body):
    """Pressures, minus the mean Cauchy stresses, at the material points [Pa], shape (points,)."""
    return pressure(cauchyStresses(body))


def plasticStrains(body):
    """Plastic strains that have gathered at the material points [-], shape (points,): the integral of the rate
    sqrt(2/3) |D_p|; 0 where the material has no plasticity."""
    return _array(_state(body).plasticStrains())


def outline(body):
    """Current boundary, counter-clockwise [m], shape (surface points, 2)."""
    return _array(_state(body).outline(), 2)


def volumeRatio(F):
    """det F of deformation gradients, shape (..., 2, 2), shape (...) [-]."""
    return F[..., 0, 0] * F[..., 1, 1] - F[..., 0, 1] * F[..., 1, 0]


def stretches(F):
    """Singular values of deformation gradients, shape (..., 2, 2), the larger first, shape (..., 2) [-]."""
    turned = numpy.hypot(F[..., 0, 0] + F[..., 1, 1], F[..., 1, 0] - F[..., 0, 1])
    sheared = numpy.hypot(F[..., 0, 0] - F[..., 1, 1], F[..., 1, 0] + F[..., 0, 1])
    return numpy.stack([turned + sheared, abs(turned - sheared)], axis=-1) / 2


def vonMises(stress):
    """Von Mises stress of stress tensors, shape (..., 3, 3), in their unit, shape (...)."""
    deviator = stress + pressure(stress)[..., None, None] * numpy.eye(3)
    return numpy.sqrt(1.5 * numpy.sum(deviator**2, axis=(-2, -1)))


def pressure(stress):
    """Minus the mean normal stress of stress tensors, shape (..., 3, 3), in their unit, shape (...)."""
    return -numpy.trace(stress, axis1=-2, axis2=-1) / 3


def _state(body):
    """The SoftState of a body, or InputError."""
    state = getattr(body, "state", None)
    if isinstance(state, wrapper.SoftState):
        return state
    what = f"body #{body.id}, a {type(body.shape).__name__}," if isinstance(body, wrapper.Body) else repr(body)
    raise InputError(f"{what} is no soft grain: give a body that softDisc or softPolygon made.")


def _array(content, *shape):
    return numpy.frombuffer(content, dtype="<f8").reshape(-1, *shape).copy()
