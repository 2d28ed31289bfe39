# SPDX-License-Identifier: GPL-2.0-or-later
"""The contact solver against Siconos (Debian's python3-siconos) on problems of packings under compaction. Prints the
table of doc/verification.md.

A problem is one step of a dense packing, taken anew from the same state for each tolerance. Siconos solves it in its
own way: by Lemke's pivoting, which ends at round-off, or by its Gauss-Seidel where pivoting fails or takes too long.

Siconos judges an answer (fc2d_compute_error; Acary and Brogliato 2008) by ||r - P_K(r - u - mu |u_t| n)|| / |q|. It
adds impulses to velocities: both count in units of impulse here, through the mean contact inertia, as in
SoftIntegrator.residual(). That one is divided by max(|q|, |r|, |u|), and so is never the larger of the two."""
import ctypes
import math
import os
import sys

import numpy
import siconos.numerics as numerics
from yade import O, FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import NeoHookeanMat, fclib, measures, softBox, softCloud, softEngines  # noqa: E402
from softgrain.builders import widthOfSquareCloud  # noqa: E402

SEED, GRAINS, POINTS, SPEED = 11, 60, 60, 4     # of the cloud and the discs; of the top wall [m/s]
DIAMETERS = (1.4e-3, 2.4e-3)
TOLERANCES = (1e-3, 1e-6, 1e-9)
# friction: solid fractions, each with methods of Siconos and the tolerances they stop at; the first that finds an answer
# counts. The last problem's answer need not be unique, neither its impulses nor its velocities, and is left to Siconos's
# measure alone.
PIVOTING, ITERATION = ("LEMKE", 1e-13), ("NSGS", 1e-12)
PROBLEMS = {0.0: ((0.9, (PIVOTING, ITERATION)), (1.02, (("NSGS", 1e-11),))),
            0.8: ((0.9, (ITERATION,)),),
            0.3: ((0.9, (PIVOTING, ITERATION)), (1.02, ()))}

compute_error = ctypes.CDLL("libsiconos_numerics.so.7").fc2d_compute_error  # has no Python interface
compute_error.argtypes = 3 * [ctypes.c_void_p] + 2 * [ctypes.c_double] + [ctypes.c_void_p]


class Scaled:
    """A Problem of fclib without units: |q| = 1, and a velocity of 1 takes an impulse of about 1."""

    def __init__(self, problem):
        size = len(problem.q)
        W = numpy.zeros((size, size))
        W[numpy.repeat(numpy.arange(size), numpy.diff(problem.rows)), problem.columns] = problem.values
        inertia = numpy.mean(1 / W.diagonal()[::2])
        self.velocity_unit = norm(problem.q)
        self.impulse_unit = inertia * self.velocity_unit
        self.W, self.q, self.mu = inertia * W, problem.q / self.velocity_unit, problem.mu
        self.rank = numpy.linalg.matrix_rank(self.W, hermitian=True)
        self.for_siconos = numerics.FrictionContactProblem(2, self.W, self.q, self.mu)

    def velocities(self, r):
        return self.W @ r + self.q

    def error(self, r):
        """Siconos's measure of impulses."""
        error, u = numpy.zeros(1), numpy.zeros_like(r)
        compute_error(int(self.for_siconos.this), r.ctypes.data, u.ctypes.data, 1.0, norm(self.q), error.ctypes.data)
        return error[0]

    def solved_by_siconos(self, methods):
        """Impulses, the method that found them and their error."""
        for method, tolerance in methods:
            r = self.attempt(method, tolerance)
            if r is not None and self.error(r) <= 10 * tolerance:
                return r, method, self.error(r)
        raise RuntimeError(f"Siconos found no answer by {' nor '.join(method for method, _ in methods)}.")

    def attempt(self, method, tolerance):
        """Impulses, or None where the method gives up; it may be wrong where it does not."""
        options = numerics.SolverOptions(getattr(numerics, f"SICONOS_FRICTION_2D_{method}"))
        options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 100000
        options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
        r, u = numpy.zeros_like(self.q), numpy.zeros_like(self.q)
        return None if numerics.fc2d_driver(self.for_siconos, r, u, options) else r


def norm(vector):
    return float(numpy.linalg.norm(vector))


def make_packing(friction):
    """Discs in a box whose top comes down; returns a function that tells the solid fraction."""
    O.reset()
    grain = O.materials.append(NeoHookeanMat(density=1000, frictionAngle=math.atan(friction)))
    wall = O.materials.append(FrictMat(frictionAngle=math.atan(friction)))
    width = widthOfSquareCloud(GRAINS, DIAMETERS, 0.65)
    grains, height = softCloud(width, GRAINS, DIAMETERS, 0.65, grain, POINTS, SEED)
    O.bodies.append(grains)
    top = O.bodies.append(softBox(width, height, wall))[3]
    O.bodies[top].state.vel = (0, -SPEED, 0)
    O.engines = softEngines()
    O.step()
    return lambda: measures.solidFraction(width * O.bodies[top].state.pos[1])


def solved_anew(tolerance):
    """The next step from the state in memory: its Problem, residual and sweeps."""
    O.loadTmp()
    soft = measures.softIntegrator()
    soft.tolerance, soft.maxSweeps = tolerance, 1000000
    O.step()
    return fclib.lastProblem(), soft.residual(), soft.iterations


def compare(checks, name, methods):
    """Answers of the step from the state in memory, one a tolerance."""
    answers = [(tolerance, *solved_anew(tolerance)) for tolerance in TOLERANCES]
    problem = answers[-1][1]
    scaled = Scaled(problem)
    size = f"{len(problem.mu)} | {len(problem.q) - scaled.rank}"
    how = "-"
    if methods:
        reference, method, error = scaled.solved_by_siconos(methods)
        how = f"{method}, {error:.0e}"
    for tolerance, same, residual, sweeps in answers:
        what = f"{name}, tolerance {tolerance:g}"
        checks.that(f"{what}: the same problem", (same.values == problem.values).all() and (same.q == problem.q).all())
        r = same.r / scaled.impulse_unit
        u = scaled.velocities(r)
        error = scaled.error(r)
        checks.close_to(f"{what}: the surfaces move as W r + q", norm(same.u / scaled.velocity_unit - u), 0, 1e-11)
        checks.that(f"{what}: our residual is within it", residual <= tolerance, residual)
        checks.that(f"{what}: Siconos's error is within it", error <= tolerance, error)
        checks.close_to(f"{what}: our residual is Siconos's error", residual * max(1, norm(r), norm(u)), error,
                        1e-6 * error + 1e-12)
        apart = "-"
        if methods:
            # an error bounds the distance from the answer but for a factor, of the conditioning of W
            difference = norm(u - scaled.velocities(reference))
            checks.that(f"{what}: velocities are Siconos's", difference <= 10 * tolerance, difference)
            apart = f"{difference:.1e}"
        print(f"| {name} | {size} | {tolerance:.0e} | {sweeps} | {residual:.1e} | {error:.1e} | {how} | {apart} |")
    return scaled, r


def what_is_wrong_is_seen(checks, name, scaled, r):
    """An answer that is spoilt a little fails every check of compare at the smaller tolerances."""
    normal, tangential = r[::2], r[1::2]
    largest, open_ = 2 * int(normal.argmax()), 2 * int(normal.argmin())
    spoilt = {"a thousandth more of the largest impulse": (largest, 1e-3 * r[largest]),
              "a thousandth less of it": (largest, -1e-3 * r[largest]),
              "the same on an open contact": (open_, 1e-3 * r[largest])}
    if abs(tangential).max() > 1e-6:
        rubbing = 2 * int(abs(tangential).argmax()) + 1
        spoilt["friction the other way"] = (rubbing, -2 * r[rubbing])
    for what, (place, change) in spoilt.items():
        wrong = r.copy()
        wrong[place] += change
        checks.that(f"{name}: {what}: Siconos's error", scaled.error(wrong) > 1e-5, scaled.error(wrong))
        moved = norm(scaled.velocities(wrong) - scaled.velocities(r))
        checks.that(f"{name}: {what}: velocities", moved > 1e-5, moved)


def packings(checks):
    print(f"{GRAINS} discs of {POINTS} points, seed {SEED}")
    print("| solid fraction | friction | contacts | redundant | tolerance | sweeps | our residual "
          "| Siconos's error of our answer | Siconos's method, its error | velocities apart |")
    for friction, problems in PROBLEMS.items():
        fraction_now = make_packing(friction)
        for fraction, methods in problems:
            while fraction_now() < fraction:
                O.run(25, wait=True)
            O.saveTmp()
            name = f"{fraction:.2f} | {friction:g}"
            what_is_wrong_is_seen(checks, name, *compare(checks, name, methods))
            O.loadTmp()


run_tests(packings)
