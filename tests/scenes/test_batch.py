# SPDX-License-Identifier: GPL-2.0-or-later
"""yade-batch: two jobs of one scene, its parameters from a table."""
import glob
import os
import subprocess
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402

TABLE = """description radius speed
wide 1e-3 1
narrow 0.5e-3 2
"""
SCENE = """
from softgrain import *
from yade import plot, utils
utils.readParamsFromTable(radius=1e-3, speed=1.0)
from yade.params import table

O.materials.append(FrictMat())
O.materials.append(NeoHookeanMat())
O.bodies.append(wall(-1.01 * table.radius, axis=1, sense=1, material=0))
O.bodies.append(softDisc((0, 0), table.radius, points=60, velocity=(0, -table.speed, 0)))

def record():
    plot.addData(t=O.time, y=O.bodies[1].state.pos[1], force=O.forces.f(0)[1])

O.engines = softEngines(more=[PyRunner(command="record()", iterPeriod=20)])
O.run(400, True)
utils.waitIfBatch()
plot.saveDataTxt(O.tags["description"] + ".txt")
"""


def two_jobs(checks):
    with Folder() as folder:
        for name, content in (("jobs.table", TABLE), ("scene.py", SCENE)):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(content)
        batch = subprocess.run(["yade-batch", "-j1", "--job-threads=1", "jobs.table", "scene.py"], cwd=folder,
                               capture_output=True, text=True, timeout=300, check=False)
        logs = "".join(open(log, encoding="utf-8").read()[-800:] for log in glob.glob(os.path.join(folder, "*.log")))
        checks.that("yade-batch", batch.returncode == 0, batch.stdout[-600:] + logs)
        for name, radius in (("wide", 1e-3), ("narrow", 0.5e-3)):
            path = os.path.join(folder, f"{name}.txt")
            if checks.that(f"job {name} wrote its data", os.path.exists(path), logs):
                force, _, y = numpy.loadtxt(path).T
                checks.that(f"job {name}: the disc meets the wall", force.min() < 0 and y.min() > -0.2 * radius)


run_tests(two_jobs)
