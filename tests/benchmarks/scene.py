# SPDX-License-Identifier: GPL-2.0-or-later
"""One timed compaction, for cost.py: yade -n -jN -x tests/benchmarks/scene.py GRAINS POINTS FROM TO SEED

Compacts a loose cloud of discs from solid fraction 0.65 at 1 m/s and times the part between the solid fractions FROM
and TO, by reference areas. Prints one line of JSON with everything in seconds, counts and metres.
"""
import json
import resource
import sys
import time

from softgrain import *
from softgrain.builders import widthOfSquareCloud

grains, points = int(sys.argv[1]), int(sys.argv[2])
start, stop, seed = float(sys.argv[3]), float(sys.argv[4]), int(sys.argv[5])
diameters, loosest, speed = (1.4e-3, 2.4e-3), 0.65, 1.0

material = O.materials.append(NeoHookeanMat())
walls = O.materials.append(FrictMat(frictionAngle=0))
width = widthOfSquareCloud(grains, diameters, loosest)
bodies, height = softCloud(width, grains, diameters, loosest, material, points, seed)
O.bodies.append(bodies)
top = O.bodies[O.bodies.append(softBox(width, height, walls))[3]]
top.state.vel = (0, -speed, 0)
O.engines = softEngines()
integrator = measures.softIntegrator()


def advance(fraction):
    while top.state.pos[1] > height * loosest / fraction:
        O.step()


def counters():
    return dict(wall=time.perf_counter(), cpu=time.process_time(), steps=O.iter, contact_iterations=integrator.contactIterations,
                travel=height - top.state.pos[1],
                **{f"stage{i}": seconds for i, seconds in enumerate(integrator.stageSeconds)})


advance(start)
before = counters()
advance(stop)
after = counters()
result = {key: after[key] - before[key] for key in before}
result.update(points=bodies[0].shape.pointCount(), grains=grains, mean_diameter=sum(diameters) / 2,
              peak_MB=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
print("RESULT " + json.dumps(result), flush=True)
