# SPDX-License-Identifier: GPL-2.0-or-later
"""Contact problems for Siconos, whose Gauss-Seidel for the plane takes matrices of 2 x 2 blocks."""
import math
import time
import warnings
from typing import NamedTuple

import numpy
import scipy.sparse
import siconos.numerics as numerics

SWEEPS, MOST = 20, 20000    # between two looks at the residual; in all


class Answer(NamedTuple):
    seconds: float      # CPU time
    sweeps: int
    residual: float


class Scaled:
    """A Problem of softgrain.fclib without units: |q| = 1, and a velocity of 1 takes an impulse of about 1."""

    def __init__(self, problem):
        size = len(problem.q)
        matrix = scipy.sparse.csr_matrix((problem.values, problem.columns, problem.rows), shape=(size, size))
        inertia, unit = float(numpy.mean(1 / matrix.diagonal()[::2])), float(numpy.linalg.norm(problem.q))
        self.W, self.q, self.mu = (inertia * matrix).tocsc(), problem.q / unit, problem.mu
        self.ours = problem.r / (inertia * unit)

    def residual(self, r):
        """As SoftIntegrator.residual(): ||r - P_K(r - u - mu |u_t| n)|| / max(|q|, |r|, |u|)."""
        u = self.W @ r + self.q
        normal = r[::2] - u[::2] - self.mu * abs(u[1::2])
        tangential = r[1::2] - u[1::2]
        size = abs(tangential)
        kept = (normal + self.mu * size) / (1 + self.mu**2)         # of what lies beside the cone
        inside, below = size <= self.mu * normal, self.mu * size <= -normal
        error = numpy.stack([r[::2] - numpy.select([below, inside], [0, normal], kept),
                             r[1::2] - numpy.select([below, inside], [0, tangential], numpy.sign(tangential) * self.mu * kept)])
        return float(numpy.linalg.norm(error) / max(1, numpy.linalg.norm(r), numpy.linalg.norm(u)))

    def by_siconos(self, residual):
        """Its Gauss-Seidel from no impulses until the residual is this one: after each few sweeps the clock stands still, so that
        no judgement of its own costs it time, and it goes on from where it was."""
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")     # of the width of indices
            _, blocks = numerics.SBM_from_csparse(2, self.W)
        problem = numerics.FrictionContactProblem(2, len(self.mu), blocks, self.q, self.mu)
        options = numerics.SolverOptions(numerics.SICONOS_FRICTION_2D_NSGS)
        options.iparam[numerics.SICONOS_FRICTION_3D_IPARAM_ERROR_EVALUATION] = \
            numerics.SICONOS_FRICTION_3D_NSGS_ERROR_EVALUATION_LIGHT
        options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = SWEEPS
        options.dparam[numerics.SICONOS_DPARAM_TOL] = 1e-300
        r, u = numpy.zeros_like(self.q), numpy.zeros_like(self.q)
        seconds, sweeps, reached = 0.0, 0, math.inf
        while reached > residual and sweeps < MOST:
            begin = time.process_time()
            numerics.fc2d_driver(problem, r, u, options)
            seconds += time.process_time() - begin
            sweeps += SWEEPS
            reached = self.residual(r)
        return Answer(seconds, sweeps, reached)
