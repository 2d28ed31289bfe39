# SPDX-License-Identifier: GPL-2.0-or-later
"""Messages that no other test of this folder meets: states that no step can start from, made by hand in a saved scene; implicit
steps that find no balance; what is missing on the machine; reading results that are not there."""
import math
import os
import re
import shutil
import subprocess
import sys

import numpy
from yade import O
from yade.minieigenHP import Quaternion
from yade.wrapper import FrictMat, State

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, run_tests, said  # noqa: E402
from softgrain import (InputError, NeoHookeanMat, SoftGrain, fclib, records, rigidContacts, rigidDisc, softBox,  # noqa: E402
                       softDisc, softEngines, softPolygon)

R = 1e-3
PACKAGE = os.environ["PYTHONPATH"].split(":")[0]    # where softgrain is
SLIT = [(0, 0), (3, 0), (3, 5), (2, 5), (2, 1), (1, 1), (1, 5), (0, 5)]     # two arms on a base [R]


def scene(body, **engines):
    """One grain after a step."""
    O.reset()
    gel = O.materials.append(NeoHookeanMat())
    O.bodies.append(body(gel))
    O.engines = softEngines(**engines)
    O.step()


def steps(count):
    """One by one: an error in O.run(count, True) is lost where it comes before YADE waits."""
    for _ in range(count):
        O.step()


def disc(material):
    return softDisc((0, 0), R, material, points=60)


def slit(material):
    return softPolygon([(x * R, y * R) for x, y in SLIT], material, points=400)


def turned(body):
    def make(material):
        made = body(material)
        made.state.ori = Quaternion((0, 0, 1), math.pi)
        return made
    return make


def saved(path):
    """The text of the scene as saved, and its displacements of nodes [R]."""
    O.save(path, quiet=True)
    with open(path, encoding="utf-8") as file:
        parts = re.split("(<nodeDisplacement.*?</nodeDisplacement>)", file.read(), flags=re.DOTALL)
    return parts, numpy.array([float(item) for item in re.findall("<item>(.*?)</item>", parts[1])]).reshape(-1, 2)


def deform(body, map_, **engines):
    """The scene of a grain whose nodes are where `map_` takes their undeformed places X [R]. Turned by half a turn it has
    displacements -2 X."""
    with Folder() as folder:
        path = os.path.join(folder, "scene.xml")
        scene(turned(body))
        places = saved(path)[1] / -2
        scene(body, **engines)
        parts, _ = saved(path)
        values = iter((map_(places) - places).ravel())
        parts[1] = re.sub("<item>.*?</item>", lambda _: f"<item>{next(values)}</item>", parts[1])
        with open(path, "w", encoding="utf-8") as file:
            file.write("".join(parts))
        O.load(path, quiet=True)
    O.engines[-1].checkInterval = 1


def bent(places, curvature=0.4):
    """Bent so far that the ends of the arms pass through each other."""
    angle, radius = curvature * places[:, 0], 1 / curvature - places[:, 1]
    return numpy.stack((radius * numpy.sin(angle), 1 / curvature - radius * numpy.cos(angle)), axis=1)


def states_that_no_step_can_start_from(checks):
    deform(disc, lambda places: places * (1, 5e-4), dt=1e-15)
    checks.raises("a grain without height", RuntimeError, ["#0", "thousandth", "smallest stretch 0.0005"], O.step)
    deform(slit, bent)
    checks.raises("a grain through itself", RuntimeError, ["#0", "passed through itself"], O.step)
    deform(disc, lambda places: places * (1, -1), integrator="implicit", dt=1e-6)
    checks.raises("a mirrored grain", RuntimeError, ["#0", "inside out", "implicit", "untangle"], O.step)


def implicit_steps_without_balance(checks):
    def press():
        O.reset()
        O.materials.append(NeoHookeanMat(label="gel"))
        O.materials.append(FrictMat(label="glass"))
        O.bodies.append(softDisc((R, R), R, "gel", points=60))
        O.bodies[O.bodies.append(softBox(2 * R, 2 * R, "glass"))[-1]].state.vel = (0, -1, 0)
        O.engines = softEngines(integrator="implicit", dt=1e-4)
        O.engines[-1].maxIterations = 1
        steps(5)
    checks.raises("one iteration is not enough", RuntimeError, ["cannot go on", "no balance", "even in a step of"], press)
    checks.raises("no linear problem", RuntimeError, ["SoftImplicitIntegrator", "SoftIntegrator"], fclib.lastProblem)


def implicit_steps_of_rigid_contacts(checks):
    def touch():
        O.reset()
        O.materials.append(NeoHookeanMat(label="gel"))
        O.materials.append(FrictMat(label="stone"))
        O.bodies.append([softDisc((0, 9 * R), R, "gel", points=60), *(rigidDisc((2 * R * k, 0), R, "stone") for k in (0, 1))])
        O.engines = softEngines(integrator="implicit", dt=1e-6, functors=rigidContacts())
        steps(3)
    checks.raises("rigid contacts", RuntimeError, ["#1", "#2", "SoftImplicitIntegrator", "Law2_ScGeom"], touch)


def grains_put_together_by_hand(checks):
    square = [(0, 0, 0), (R, 0, 0), (R, R, 0), (0, R, 0)]
    for what, vertices, words in [("a corner twice", [*square, square[3]], ["3", "4", "once"]),
                                  ("corners on a line", [(0, 0, 0), (R, 0, 0), (2 * R, 0, 0)], ["no area"])]:
        checks.raises(what, ValueError, words, lambda vertices=vertices: SoftGrain(vertices=vertices).area())

    def other_state(**engines):     # in a running scene; a new one YADE refuses itself
        scene(disc, **engines)
        O.materials.append(FrictMat())
        body = disc(0)
        body.state = State()
        O.bodies.append([body, *softBox(R, R, 1)])
        O.step()
    for engines in ({}, {"dt": 1e-7}):
        checks.raises(f"a state of YADE, {engines}", RuntimeError, ["#1", "SoftState", "softDisc"],
                      lambda: other_state(**engines))


def files_without_results(checks):
    with Folder() as folder:
        path = os.path.join(folder, "compaction.csv")
        for what, text, words, work in [
                ("an empty table", "", [path, "empty", "columns"], lambda: records.read_table(path)),
                ("a column that is not there", "strain\n0.1\n", [path, "stress_bottom_Pa"],
                 lambda: records.read_table(path)["stress_bottom_Pa"])]:
            with open(path, "w", encoding="ascii") as file:
                file.write(text)
            checks.raises(what, ValueError, words, work)
        script = f"import sys; sys.path.insert(0, {PACKAGE!r}); from softgrain import figures; figures.draw_picture('.', 'x.png')"
        run = subprocess.run(["/usr/bin/python3.11", "-c", script], cwd=folder, capture_output=True, text=True, check=False)
        checks.that("a run without snapshots", "holds no snapshots" in run.stderr, run.stderr)
        run = subprocess.run(["yade", "-n", "-x", os.path.join(EXAMPLES, "squeeze.py"), "--threads", "2"], cwd=folder,
                             capture_output=True, text=True, check=False,
                             env=dict(os.environ, SOFTGRAIN_RESTARTED_FOR_THREADS="1"))
        checks.that("threads that cannot be had", run.returncode == 2 and "--threads 2 could not be had" in run.stderr, said(run))


def what_is_missing(checks):
    module, sys.modules["h5py"] = sys.modules.get("h5py"), None
    checks.raises("no h5py", InputError, ["h5py", "python3-h5py"], lambda: fclib.read("nothing"))
    del sys.modules["h5py"]
    if module:
        sys.modules["h5py"] = module
    with Folder() as folder:
        example = shutil.copy(os.path.join(EXAMPLES, "accuracy_cost.py"), folder)
        away = subprocess.run(["yade", "-n", "-x", example], cwd=folder, capture_output=True, text=True, check=False)
        checks.that("no references", away.returncode == 2 and "source tree" in away.stderr, said(away))
        figures = os.path.join(EXAMPLES, "figures.py")
        for what, path, options, words in (("softgrain", "", [figures, "."], "is not installed"),
                                           ("matplotlib", PACKAGE, ["-S", figures, "."], "has no matplotlib"),
                                           ("yade", PACKAGE, ["-c", "from softgrain import softDisc"], "inside YADE only")):
            run = subprocess.run(["/usr/bin/python3.11", *options], cwd=folder, capture_output=True, text=True, check=False,
                                 env=dict(os.environ, PYTHONPATH=path))
            checks.that(f"no {what}", run.returncode == 1 and words in run.stderr, run.stderr)


run_tests(states_that_no_step_can_start_from, implicit_steps_without_balance, implicit_steps_of_rigid_contacts,
          grains_put_together_by_hand, files_without_results, what_is_missing)
