# SPDX-License-Identifier: GPL-2.0-or-later
"""yade-batch: two jobs of one scene, its parameters from a table; and of an example, whose options are the columns."""
import glob
import os
import subprocess
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, run_tests  # noqa: E402
from softgrain import load_run  # noqa: E402

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


# Small; then a mistake in an option, of a value, and of a column.
SWEEP = """description friction seed grains points until no_figures diameters speed
smooth 0 1 8 40 0.68 1 1.4e-3,2.4e-3 *
rough 0.5 = = = = = = *
wrong -1 = = = = = = *
"""


def batch_of(folder, scene, **files):
    """Runs yade-batch on a scene and its table, of these contents; the process, and what the jobs have logged."""
    for name, content in files.items():
        with open(os.path.join(folder, name), "w", encoding="ascii") as file:
            file.write(content)
    batch = subprocess.run(["yade-batch", "-j2", "--job-threads=1", "--log=@.log", "table", scene], cwd=folder, capture_output=True, text=True,
                           timeout=300, check=False)
    return batch, "".join(open(log, encoding="utf-8").read()[-800:] for log in glob.glob(os.path.join(folder, "*.log")))


def an_example(checks):
    with Folder() as folder:
        _, logs = batch_of(folder, os.path.join(EXAMPLES, "compaction.py"), table=SWEEP)
        runs = {name: load_run(os.path.join(folder, f"compaction-{name}")) for name in ("smooth", "rough")}
        checks.that("two runs", all(run.finished and run["solid_fraction"][-1] >= 0.68 for run in runs.values()), logs)
        checks.that("of their parameters", [run.parameters["friction"] for run in runs.values()] == [0, 0.5]
                    and runs["rough"].parameters["diameters"] == [1.4e-3, 2.4e-3] and runs["rough"].parameters["speed"] == 1)
        checks.that("friction dissipates in one", runs["smooth"]["friction_J"][-1] == 0 < runs["rough"]["friction_J"][-1])
        checks.that("each says how to run it alone", "--friction 0.5" in runs["rough"].command and "--no-figures" in runs["rough"].command
                    and "--out compaction-rough" in runs["rough"].command, runs["rough"].command)
        checks.that("a mistake is one sentence in its log", "--friction: -1 has to be zero or above" in logs and "Traceback" not in logs, logs)
        with open(os.path.join(EXAMPLES, "sweep.table"), encoding="ascii") as file:
            shorter = [" ".join([*line.split(), {"description": "until"}.get(line.split()[0], "0.67")]) for line in file
                       if line.strip() and not line.startswith("#")]
        _, logs = batch_of(folder, os.path.join(EXAMPLES, "compaction.py"), table="\n".join(shorter[:2]) + "\n")
        checks.that("sweep.table", load_run(os.path.join(folder, "compaction-smooth-1")).parameters["grains"] == 60, logs)


def two_jobs(checks):
    with Folder() as folder:
        batch, logs = batch_of(folder, "scene.py", table=TABLE, **{"scene.py": SCENE})
        checks.that("yade-batch", batch.returncode == 0, batch.stdout[-600:] + logs)
        for name, radius in (("wide", 1e-3), ("narrow", 0.5e-3)):
            path = os.path.join(folder, f"{name}.txt")
            if checks.that(f"job {name} wrote its data", os.path.exists(path), logs):
                force, _, y = numpy.loadtxt(path).T
                checks.that(f"job {name}: the disc meets the wall", force.min() < 0 and y.min() > -0.2 * radius)


run_tests(two_jobs, an_example)
