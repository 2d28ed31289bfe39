# SPDX-License-Identifier: GPL-2.0-or-later
"""Discs settle in a box, in YADE; for rigid_discs.py. Prints lines of JSON, RESULT first.

    yade -n -x scene.py cloud COUNT SEED FILE                       writes the cloud
    yade -n -x scene.py cd FILE UNTIL STEP TOLERANCE                by Contact Dynamics
    yade -n -x scene.py cs FILE UNTIL STIFFNESS SHARE               by Cundall-Strack; its step: SHARE of sqrt(mass / stiffness)
    yade -n -x scene.py problems FILE STEP TOLERANCE UNTIL...       contact problems at these times, by us and by Siconos
"""
import json
import math
import os
import sys
import time

import numpy
from yade import O
from yade.wrapper import (Bo1_Sphere_Aabb, Bo1_Wall_Aabb, ForceResetter, FrictMat, Ig2_Sphere_Sphere_ScGeom,
                          Ig2_Wall_Sphere_ScGeom, InsertionSortCollider, InteractionLoop, Ip2_FrictMat_FrictMat_FrictPhys,
                          Law2_ScGeom_FrictPhys_CundallStrack, MatchMaker, NewtonIntegrator)

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import discs  # noqa: E402
from softgrain import discCloud, fclib, measures, rigidContacts, rigidDisc, softBox, softEngines  # noqa: E402
from softgrain.builders import widthOfSquareCloud  # noqa: E402

DIAMETERS, LOOSEST = (1.4e-3, 2.4e-3), 0.65
DAMPING, SHEAR = 0.2, 0.5       # of Cundall-Strack: of NewtonIntegrator, gravity left out; shear over normal stiffness
PULL = (0, -discs.GRAVITY, 0)


def write_cloud(count, seed, path):
    width = widthOfSquareCloud(count, DIAMETERS, LOOSEST)
    radii, places, _, height = discCloud(width, count, DIAMETERS, LOOSEST, seed)
    with open(path, "w") as file:
        json.dump({"radii": radii, "places": places, "width": width, "height": height}, file)


def make_discs(path):
    """The bodies; radii [m] and the width of the box [m]."""
    radii, places, width, height = discs.load(path)
    material = O.materials.append(FrictMat(density=discs.DENSITY, frictionAngle=math.atan(discs.FRICTION)))
    for radius, (x, y) in zip(radii.tolist(), places.tolist()):
        O.bodies.append(rigidDisc((x, y), radius, material))
    O.bodies.append(softBox(width, height, material)[:3])
    return radii, width


def use_contact_dynamics(step, tolerance):
    O.engines = softEngines(gravity=PULL, dt=step, tolerance=tolerance, functors=rigidContacts())


def use_cundall_strack(radii, stiffness, share):
    smallest = float(radii.min())
    O.dt = share * math.sqrt(discs.DENSITY * math.pi * smallest**2 / stiffness)
    normal, shear = (MatchMaker(algo="val", val=value) for value in (stiffness, SHEAR * stiffness))
    O.engines = [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.05 * smallest),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                        [Ip2_FrictMat_FrictMat_FrictPhys(kn=normal, ks=shear)], [Law2_ScGeom_FrictPhys_CundallStrack()]),
        NewtonIntegrator(damping=DAMPING, gravity=PULL, dampGravity=False),
    ]


def settle(radii, width, until):
    states = [O.bodies[i].state for i in range(len(radii))]
    step = O.step

    def advance():
        step()
        return O.time

    result = discs.run(radii, width, until, advance,
                       lambda: (numpy.array([s.pos for s in states])[:, :2], numpy.array([s.vel for s in states])[:, :2]))
    return dict(result, steps=O.iter, dt=O.dt)


def settle_by_contact_dynamics(path, until, step, tolerance):
    radii, width = make_discs(path)
    use_contact_dynamics(step, tolerance)
    result = settle(radii, width, until)
    soft = measures.softIntegrator()
    discs.tell(**result, sweeps=soft.totalIterations / O.iter, residual=soft.residual(), contacts=soft.contactCount)


def settle_by_cundall_strack(path, until, stiffness, share):
    radii, width = make_discs(path)
    use_cundall_strack(radii, stiffness, share)
    result = settle(radii, width, until)
    discs.tell(**result, contacts=sum(1 for interaction in O.interactions if interaction.isReal))


def step_from_nothing():
    """The next step, its contact problem solved from no impulses: CPU time of the whole step."""
    for interaction in O.interactions:
        if interaction.isReal:
            interaction.phys.normalForce = interaction.phys.shearForce = (0, 0, 0)
    begin = time.process_time()
    O.step()
    return time.process_time() - begin


def compare(path, step, tolerance, *times):
    """Problems of single steps."""
    from problems import Scaled
    make_discs(path)
    use_contact_dynamics(step, tolerance)
    for until in times:
        while O.time < until * (1 - 1e-9):
            O.step()
        seconds = step_from_nothing()
        problem = Scaled(fclib.lastProblem())
        residual = problem.residual(problem.ours)
        its = problem.by_siconos(residual)
        discs.tell(time=until, contacts=len(problem.mu), ours_s=seconds, ours_sweeps=measures.softIntegrator().iterations,
                   residual=residual, siconos_s=its.seconds, siconos_sweeps=its.sweeps, siconos_residual=its.residual)


mode, *rest = sys.argv[1:]
if mode == "cloud":
    write_cloud(int(rest[0]), int(rest[1]), rest[2])
elif mode == "problems":
    compare(rest[0], *map(float, rest[1:]))
else:
    {"cd": settle_by_contact_dynamics, "cs": settle_by_cundall_strack}[mode](rest[0], *map(float, rest[1:]))
