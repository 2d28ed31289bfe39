# SPDX-License-Identifier: GPL-2.0-or-later
"""yade -n -x rigid_siconos.py GRAINS FRICTION: single steps of rigid discs that are pressed together; the time of our contact
solver and of Siconos's Gauss-Seidel for the same problem from the same start, nought, to about the same residual."""
import math
import sys
import time

import numpy
import scipy.sparse
import siconos.numerics as numerics
from softgrain import discCloud, fclib, measures, rigidContacts, rigidDisc, softBox, softEngines
from softgrain.builders import widthOfSquareCloud
from yade import O
from yade.wrapper import FrictMat

DIAMETERS, SPEED = (1.4e-3, 2.4e-3), 1.0
AT = (0.72, 0.76, 0.78)     # solid fractions

grains, friction = int(sys.argv[1]), float(sys.argv[2])
O.materials.append(FrictMat(density=1000, frictionAngle=math.atan(friction)))
width = widthOfSquareCloud(grains, DIAMETERS, 0.65)
radii, places, _, height = discCloud(width, grains, DIAMETERS, 0.65, seed=1)
for radius, (x, y) in zip(radii, places):
    O.bodies.append(rigidDisc((x, y), radius))
top = O.bodies.append(softBox(width, height))[3]
O.bodies[top].state.vel = (0, -SPEED, 0)
O.engines = softEngines(dt=2e-3 * min(radii) / SPEED, functors=rigidContacts())
soft = measures.softIntegrator()
area = math.pi * math.fsum(radius**2 for radius in radii)


def siconos_seconds(problem, residual):
    """CPU time of its Gauss-Seidel until its residual is this one."""
    size = len(problem.q)
    matrix = scipy.sparse.csr_matrix((problem.values, problem.columns, problem.rows), shape=(size, size))
    inertia = float(numpy.mean(1 / matrix.diagonal()[::2]))
    scaled = numerics.FrictionContactProblem(2, (inertia * matrix).tocsc(), problem.q / numpy.linalg.norm(problem.q), problem.mu)
    options = numerics.SolverOptions(numerics.SICONOS_FRICTION_2D_NSGS)
    options.iparam[numerics.SICONOS_IPARAM_MAX_ITER] = 100000
    options.dparam[numerics.SICONOS_DPARAM_TOL] = residual
    r, u = numpy.zeros(size), numpy.zeros(size)
    begin = time.process_time()
    failed = numerics.fc2d_driver(scaled, r, u, options)
    return math.nan if failed else time.process_time() - begin


for fraction in AT:
    while area / (width * O.bodies[top].state.pos[1]) < fraction:
        O.step()
    for interaction in O.interactions:      # a cold start, as Siconos has it
        if interaction.isReal:
            interaction.phys.normalForce = interaction.phys.shearForce = (0, 0, 0)
    before = soft.stageSeconds[2]
    O.step()
    ours, problem = soft.stageSeconds[2] - before, fclib.lastProblem()
    its = siconos_seconds(problem, soft.residual())
    print(f"RESULT solid fraction {fraction}: {len(problem.mu)} contacts, residual {soft.residual():.1e}: ours {1e3 * ours:.1f} ms "
          f"({soft.iterations} sweeps), Siconos {1e3 * its:.1f} ms, ratio {its / ours:.1f}")
