#!/usr/bin/python3
# SPDX-License-Identifier: GPL-2.0-or-later
"""The discs of rigid_discs.py by Siconos alone: its discs and planes, its time-stepping of Moreau and Jean, its Gauss-Seidel.

    python3 siconos_scene.py FILE UNTIL STEP TOLERANCE
"""
import math
import os
import sys

import numpy
import siconos.kernel as kernel
import siconos.numerics as numerics
from siconos.mechanics.collision.bodies import Disk
from siconos.mechanics.collision.native import SpaceFilter

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import discs  # noqa: E402

UNIT = 1e-3                 # of lengths [m]: cells of its grid are whole numbers
CELL, LOOK_AHEAD = 2, 1     # width of a cell [UNIT], and what a disc is made wider by: the fastest that finds all contacts
SWEEPS = 1000               # at most, in a step


def make_bodies(radii, places, system):
    bodies = []
    for radius, (x, y) in zip(radii, places):
        mass = discs.DENSITY * math.pi * radius**2
        body = Disk(radius / UNIT, mass, [x / UNIT, y / UNIT, 0], [0, 0, 0])
        body.setFExtPtr([0, -mass * discs.GRAVITY / UNIT, 0])
        system.insertDynamicalSystem(body)
        bodies.append(body)
    return bodies


def make_box(width):
    """Floor and sides, a x + b y + c = 0 each."""
    planes = [[0, 1, 0, 0, 0, 0], [1, 0, 0, 0, 0, 0], [1, 0, -width / UNIT, width / UNIT, 0, 0]]
    box = SpaceFilter(LOOK_AHEAD, CELL, numpy.array(planes, float))
    box.insertNonSmoothLaw(kernel.NewtonImpactFrictionNSL(0, 0, discs.FRICTION, 2), 0, 0)
    return box


def make_solver(tolerance):
    solver = kernel.FrictionContact(2, numerics.SICONOS_FRICTION_2D_NSGS)
    options = solver.numericsSolverOptions()
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = SWEEPS
    options.dparam[numerics.SICONOS_DPARAM_TOL] = tolerance
    solver.setMaxSize(100000)
    solver.setMStorageType(numerics.NM_SPARSE_BLOCK)
    solver.setKeepLambdaAndYState(True)     # the next step starts from these impulses
    return solver, options


def main():
    path, until, step, tolerance = sys.argv[1], *map(float, sys.argv[2:])
    radii, places, width, _ = discs.load(path)
    system = kernel.NonSmoothDynamicalSystem(0, 2 * until)
    bodies = make_bodies(radii, places, system)
    system.setSymmetric(True)
    solver, options = make_solver(tolerance)
    simulation = kernel.TimeStepping(system, kernel.TimeDiscretisation(0, step), kernel.MoreauJeanOSI(0.50001), solver)
    simulation.setNewtonOptions(kernel.SICONOS_TS_LINEAR)
    simulation.insertInteractionManager(make_box(width))
    counts = {"steps": 0, "sweeps": 0}

    def advance():
        simulation.computeOneStep()
        counts["steps"] += 1
        counts["sweeps"] += options.iparam[numerics.SICONOS_IPARAM_ITER_DONE]
        now = simulation.nextTime()
        simulation.nextStep()
        return now

    result = discs.run(radii, width, until, advance,
                       lambda: (UNIT * numpy.array([b.q()[:2] for b in bodies]),
                                UNIT * numpy.array([b.velocity()[:2] for b in bodies])))
    touching = len(kernel.interactions(system.topology().indexSet(1)))
    discs.tell(**result, steps=counts["steps"], dt=step, sweeps=counts["sweeps"] / counts["steps"], contacts=touching,
               residual=options.dparam[numerics.SICONOS_DPARAM_RESIDU])


main()
