# SPDX-License-Identifier: GPL-2.0-or-later
"""What grains do before a packing jams: yade -n -x tests/benchmarks/loose.py [GRAINS POINTS SPEED [DAMPING]]

Compacts a loose cloud of discs from solid fraction 0.6 on and prints, at some solid fractions, the share of grains at rest, of
those whose largest stress is below some shares of the shear modulus, and the CPU time since the last, with the share of it in
forces, motion, contacts: how much could be saved by grains that move as rigid bodies while they carry no load.
"""
import sys
import time

import numpy
from softgrain import *
from softgrain.builders import widthOfSquareCloud

words = sys.argv[1:] + ["100", "124", "1.0", "0.0"][len(sys.argv) - 1:]
grains, points, speed, damping = int(words[0]), int(words[1]), float(words[2]), float(words[3])
DIAMETERS, LOOSEST, SHARES = (1.4e-3, 2.4e-3), 0.6, (1e-4, 1e-3, 1e-2, 1e-1)

gel = NeoHookeanMat(label="gel")
O.materials.append(gel)
O.materials.append(FrictMat(frictionAngle=0, label="steel"))
width = widthOfSquareCloud(grains, DIAMETERS, LOOSEST)
cloud, height = softCloud(width, grains, DIAMETERS, LOOSEST, "gel", points)
O.bodies.append(cloud)
top = O.bodies[O.bodies.append(softBox(width, height, "steel"))[3]]
top.state.vel = (0, -speed, 0)
O.engines = softEngines(damping=damping)
soft = measures.softIntegrator()
print("fraction  at rest  " + "  ".join(f"< {share:g}" for share in SHARES) + "  cpu s  forces  motion  contacts")
for fraction in (0.62, 0.65, 0.68, 0.71, 0.74, 0.77, 0.80, 0.82, 0.84):
    start, stages = time.process_time(), numpy.array(soft.stageSeconds)
    while top.state.pos[1] > height * LOOSEST / fraction:
        O.step()
    cpu, stages = time.process_time() - start, numpy.array(soft.stageSeconds) - stages
    stress = numpy.array([abs(arrays.cauchyStresses(body)).max() / gel.mu for body in cloud])
    rest = numpy.mean([body.state.vel.norm() == 0 for body in cloud])
    print(f"{fraction:8.2f}  {rest:7.2f}  " + "  ".join(f"{numpy.mean(stress < share):8.2f}" for share in SHARES)
          + f"  {cpu:5.2f}  " + "  ".join(f"{share:6.2f}" for share in (stages[0], stages[3], stages[1] + stages[2]) / stages.sum()),
          flush=True)
