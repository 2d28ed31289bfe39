# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft grains as YADE's own bodies: save, load, reload, erase, several scenes, PyRunner, plot, O.run, O.trackEnergy.
(yade-batch: test_batch.py.)"""
import builtins
import os
import re
import sys
import time

import numpy
from yade import O, plot
from yade.utils import sphere, wall
from yade.wrapper import FrictMat, PyRunner

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import (NeoHookeanMat, arrays, measures, rigidDisc, softBox, softCloud, softDisc, softEngines,  # noqa: E402
                       softPolygon)

WIDTH, SPEED = 8e-3, 2.0


def compaction_scene(more=()):
    """Fifteen grains under a wall that comes down fast; the wall's id."""
    O.reset()
    soft = O.materials.append(NeoHookeanMat(frictionAngle=0.2))
    rigid = O.materials.append(FrictMat(frictionAngle=0.1))
    grains, height = softCloud(WIDTH, 15, (1.4e-3, 2.4e-3), 0.65, soft, points=60, seed=2)
    O.bodies.append(grains)
    top = O.bodies.append(softBox(WIDTH, height, rigid))[-1]
    O.bodies[top].state.vel = (0, -SPEED, 0)
    O.engines = softEngines(more=list(more))
    return top


def everything(top):
    """All that a step changes, as one array."""
    soft = measures.softIntegrator()
    parts = [arrays.points(body).ravel() / WIDTH for body in measures.softBodies()]
    parts += [arrays.pointVelocities(body).ravel() / SPEED for body in measures.softBodies()]
    parts.append([O.bodies[top].state.pos[1] / WIDTH, O.time * SPEED / WIDTH, soft.externalWork, soft.elasticEnergy(),
                  soft.kineticEnergy(), soft.frictionDissipation, soft.contactDissipation, O.forces.f(top)[1] / 1e6])
    return numpy.concatenate(parts)


def run(steps):
    for _ in range(steps):
        O.step()


def continued_equals_uninterrupted(checks):
    with Folder() as folder:
        for ending in ("yade", "xml", "yade.gz", "xml.bz2"):
            top = compaction_scene()
            for _ in range(600):     # a step at which the time step is renewed
                O.step()
            path = os.path.join(folder, f"scene.{ending}")
            O.save(path, quiet=True)
            for _ in range(300):
                O.step()
            expected = everything(top)
            O.reset()
            O.load(path, quiet=True)
            for _ in range(300):
                O.step()
            difference = abs(everything(top) - expected).max()
            checks.that(f"continued from scene.{ending}", difference < 1e-9, difference)


def reload_begins_anew(checks):
    top = compaction_scene()
    for _ in range(50):
        O.step()
    O.saveTmp(quiet=True)
    for _ in range(100):
        O.step()
    expected = everything(top)
    O.reload(quiet=True)
    for _ in range(100):
        O.step()
    difference = abs(everything(top) - expected).max()
    checks.that("O.reload", difference < 1e-9, difference)


def grains_can_be_erased_and_added(checks):
    compaction_scene()
    for _ in range(300):
        O.step()
    before = len(measures.softBodies())
    O.bodies.erase(3)
    for _ in range(50):
        O.step()
    checks.that("erased", len(measures.softBodies()) == before - 1 and O.bodies[3] is None)
    soft = measures.softIntegrator()
    checks.close_to("its area is gone", soft.solidArea() / measures.referenceArea(), 1, 0.01)
    checks.that("no contact with it", all(3 not in pair for pair in measures.contactPairs()))
    O.bodies.append(softDisc((20e-3, 20e-3), 1e-3, 0, points=60))
    for _ in range(50):
        O.step()
    checks.that("added", len(measures.softBodies()) == before)


def a_body_of_no_other_owner_is_erased(checks):
    # what a script has made and not kept ends with the engine, which runs outside of Python's lock
    for make in (lambda: softDisc((0, 2.01e-3), 1e-3, 0, points=60),
                 lambda: rigidDisc((0, 2.01e-3), 1e-3), lambda: sphere((0, 2.01e-3, 0), 1e-3, fixed=True)):
        O.reset()
        O.materials.append(NeoHookeanMat())
        O.bodies.append(softDisc((0, 0), 1e-3, 0, points=60, velocity=(0, 1)))
        other = O.bodies.append(make())
        O.engines = softEngines()
        O.run(300, True)
        O.bodies.erase(other)
        O.run(300, True)
        checks.that("goes on", O.iter == 600)


def saved_in_memory(checks):
    for step in (300, 310):     # with and without a new time step in the next one
        top = compaction_scene()
        run(step)
        O.saveTmp("mark", quiet=True)
        run(200)
        expected = everything(top)
        for attempt in ("first", "second"):
            O.loadTmp("mark", quiet=True)
            run(200)
            difference = abs(everything(top) - expected).max()
            checks.that(f"loadTmp at {step}, {attempt} time", difference < 1e-9, difference)
    O.loadTmp("mark", quiet=True)
    O.bodies.erase(3)
    run(100)
    with Folder() as folder:
        path = os.path.join(folder, "erased.yade")
        O.save(path, quiet=True)
        run(100)
        expected = everything(top)
        O.load(path, quiet=True)
        run(100)
        difference = abs(everything(top) - expected).max()
        checks.that("a scene with a gap in its ids", O.bodies[3] is None and difference < 1e-9, difference)


def a_dense_scene_can_be_loaded(checks):
    """Grains pressed into each other have penetrations that no fresh scene may have."""
    top = compaction_scene()
    while measures.solidFraction(WIDTH * O.bodies[top].state.pos[1]) < 0.99:
        run(50)
    O.saveTmp(quiet=True)
    run(20)
    expected = everything(top)
    O.loadTmp(quiet=True)
    run(20)
    checks.close_to("goes on", abs(everything(top) - expected).max(), 0, 1e-9)
    soft = measures.softIntegrator()
    soft.maxSweeps, soft.recovery = 1, 0    # contacts badly solved: deeper than a new grain may lie
    while soft.maxPenetration() < 2e-3:
        run(10)
    O.bodies.append(softDisc((20e-3, 20e-3), 1e-3, 0, points=60))
    run(20)
    checks.that("and takes another grain in", len(measures.softBodies()) == 16)


def bodies_come_and_go_while_it_runs(checks):
    def change():
        if O.iter == 200:
            O.bodies.erase(3)
        if O.iter == 400:
            O.bodies.append(softDisc((4e-3, 30e-3), 1e-3, 0, points=60))
        if O.iter == 600:
            O.bodies.erase(0)

    builtins.change = change
    compaction_scene([PyRunner(command="change()", iterPeriod=1)])
    O.run(800, True)
    checks.that("O.run", O.iter == 800)
    checks.that("two gone, one come", len(measures.softBodies()) == 14 and O.bodies[0] is None and O.bodies[3] is None)
    for body in measures.softBodies():
        O.bodies.erase(body.id)
    run(60)
    checks.that("no grain left", measures.softIntegrator().elasticEnergy() == 0)


def run_in_the_background_equals_steps(checks):
    top = compaction_scene()
    run(500)
    expected = everything(top)
    top = compaction_scene()
    O.run(500)
    O.wait()
    checks.that("the same to the last digit", (everything(top) == expected).all())
    compaction_scene()
    O.run()
    while O.iter == 0:
        time.sleep(0.01)
    reads = 0
    while O.iter < 1000:
        soft = measures.softIntegrator()
        soft.contacts(), soft.solidArea(), soft.kineticEnergy(), [arrays.points(b) for b in measures.softBodies()]
        reads += 1
    O.pause()
    O.wait()
    checks.that("can be read while it runs", reads > 0)
    stopped = O.iter
    O.stopAtIter = stopped + 20
    O.run()
    O.wait()
    checks.that("O.stopAtIter", O.iter == stopped + 20)


def an_error_in_the_background_is_kept_for_wait(checks):
    compaction_scene([PyRunner(command="import time; time.sleep(0.3)", iterPeriod=10, firstIterRun=10)])
    run(2)
    O.run()
    measures.softIntegrator().tolerance = -1
    checks.raises("O.wait", RuntimeError, ["tolerance", "-1"], O.wait)
    measures.softIntegrator().tolerance = 1e-3
    stopped = O.iter
    run(10)
    checks.that("goes on when mended", O.iter == stopped + 10)


def sub_steps(checks):
    top = compaction_scene()
    run(40)
    expected = everything(top)
    top = compaction_scene()
    run(10)
    O.subStepping = True
    while O.iter < 20:
        O.step()
    O.subStepping = False
    while O.iter < 40:
        O.step()
    checks.that("O.subStepping changes nothing", abs(everything(top) - expected).max() < 1e-12)


def plots(checks):
    def record():
        plot.addData(t=O.time, elastic=measures.softIntegrator().elasticEnergy(), force=O.forces.f(builtins.top)[1])

    builtins.record = record
    plot.reset()
    builtins.top = compaction_scene([PyRunner(command="record()", iterPeriod=50)])
    O.run(1000, True)
    checks.that("plot.addData", len(plot.data["t"]) in (19, 20) and max(plot.data["force"]) > 0, plot.data["force"])
    with Folder() as folder:
        path = os.path.join(folder, "data.txt")
        plot.saveDataTxt(path)
        checks.that("plot.saveDataTxt", numpy.loadtxt(path).shape == (len(plot.data["t"]), 3))
    plot.reset()


def energies_are_tracked(checks):
    def soft_sum():
        return sum(value for name, value in O.energy.items() if name.startswith("soft"))

    compaction_scene()
    O.trackEnergy = True
    run(1200)
    work = -dict(O.energy.items())["softExternalWork"]
    checks.that("the sum of O.energy's soft entries vanishes", abs(soft_sum()) < 0.01 * work, O.energy.items())

    def record():
        plot.addData(i=O.iter, soft=soft_sum(), **O.energy)

    builtins.record = record
    plot.reset()
    O.reset()
    O.trackEnergy = True
    O.materials.append(NeoHookeanMat(frictionAngle=0.2))
    O.bodies.append([softDisc((0, 0), 1e-3, points=60, velocity=(1, -1, 0)), softBox(1, 1, FrictMat(frictionAngle=0.2))[2]])
    O.bodies[0].state.pos = (0, 1.1e-3, 0)
    O.engines = softEngines(gravity=(0, -1000, 0), more=[PyRunner(command="record()", iterPeriod=50)])
    O.run(1500, True)
    sums = plot.data["soft"]
    checks.that("with gravity it stays", numpy.ptp(sums) < 2e-3 * sums[0] and O.forces.f(1)[1] <= 0, sums)
    checks.that("plot.addData(**O.energy)", len(plot.data["softFriction"]) == len(sums) and plot.data["softFriction"][-1] > 0)
    plot.reset()


def scenes_do_not_disturb_each_other(checks):
    top = compaction_scene()
    for _ in range(100):
        O.step()
    first = O.thisScene
    second = O.addScene()
    O.switchToScene(second)
    O.materials.append(NeoHookeanMat())
    O.bodies.append(softDisc((0, 0), 1e-3, points=60, velocity=(1, 0, 0)))
    O.engines = softEngines()
    for _ in range(100):
        O.step()
    checks.close_to("the second scene's disc flies", O.bodies[0].state.pos[0], O.time, 1e-9)
    O.switchToScene(first)
    for _ in range(100):
        O.step()
    found = everything(top)
    top = compaction_scene()
    for _ in range(200):
        O.step()
    checks.that("the first scene goes on as if alone", abs(found - everything(top)).max() < 1e-12)


def engines_of_yade_work_along(checks):
    top = compaction_scene([PyRunner(command="seen.append(O.iter)", iterPeriod=20)])
    builtins.seen = []
    O.trackEnergy = True
    O.run(200, True)
    checks.that("O.run", O.iter == 200, O.iter)
    checks.that("PyRunner", len(builtins.seen) in (9, 10), builtins.seen)
    soft = measures.softIntegrator()
    tracked = dict(O.energy.items())
    checks.close_to("O.trackEnergy: elastic", tracked["softElastic"], soft.elasticEnergy(), 1e-12)
    checks.that("wall reaction in O.forces", abs(O.forces.f(top)[1]) >= 0)


def bodies_move_as_bodies(checks):
    O.reset()
    O.materials.append(NeoHookeanMat())
    hexagon = [(1e-3 * numpy.cos(a), 5e-3 + 1e-3 * numpy.sin(a), 0) for a in numpy.arange(6) * numpy.pi / 3]
    O.bodies.append([softDisc((0, 0), 1e-3, velocity=(2, 1, 0), points=60), softPolygon(hexagon, velocity=(0, 3, 0))])
    O.engines = softEngines(gravity=(0, -9.81, 0))
    for _ in range(500):
        O.step()
    disc, polygon = O.bodies[0].state, O.bodies[1].state
    time, step = O.time, O.dt
    checks.close_to("x of the disc", disc.pos[0], 2 * time, 1e-12)
    checks.close_to("y of the disc", disc.pos[1], time - 9.81 / 2 * time**2, 9.81 * time * step)
    checks.close_to("velocity of the polygon", polygon.vel[1], 3 - 9.81 * time, 1e-9)
    checks.close_to("centroid of the polygon", polygon.pos[1], 5e-3 + 3 * time - 9.81 / 2 * time**2, 9.81 * time * step)
    checks.close_to("area of the hexagon", O.bodies[1].shape.area(), 1.5 * 3**0.5 * 1e-6, 1e-12 * 1e-6)
    checks.close_to("mass of the disc", disc.mass, 1000 * numpy.pi * 1e-6, 1e-12)


def saved_by_another_version(checks):
    with Folder() as folder:
        O.reset()
        gel = O.materials.append(NeoHookeanMat())
        O.bodies.append([softDisc((0, 0), 1e-3, gel, 60, velocity=(0, -3, 0)), softDisc((2.05e-3, 0), 1e-3, gel, 60, velocity=(-1, 0, 0)),
                         wall(-1.01e-3, axis=1, sense=1, material=O.materials.append(FrictMat()))])
        O.engines = softEngines()
        for _ in range(60):
            O.step()
        path = os.path.join(folder, "scene.xml")
        O.save(path, quiet=True)
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for what, pattern, replacement, words in (
                ("another format", "<format>6</format>", "<format>7</format>", ["#0", "format 7", "version"]),
                ("another number of points", "<points>60</points>", "<points>124</points>", ["#0", "version"])):
            changed, count = re.subn(pattern, replacement, text)
            checks.that(f"{what}: the file is changed", count == 2, count)
            with open(path, "w", encoding="utf-8") as file:
                file.write(changed)
            O.reset()
            O.load(path, quiet=True)
            for attempt in range(2):
                checks.raises(f"{what}, attempt {attempt}", (RuntimeError, ValueError), words, O.step)
        O.reset()


run_tests(continued_equals_uninterrupted, reload_begins_anew, saved_in_memory, a_dense_scene_can_be_loaded,
          grains_can_be_erased_and_added, a_body_of_no_other_owner_is_erased, bodies_come_and_go_while_it_runs,
          scenes_do_not_disturb_each_other, run_in_the_background_equals_steps,
          an_error_in_the_background_is_kept_for_wait, sub_steps, plots, energies_are_tracked, engines_of_yade_work_along, bodies_move_as_bodies,
          saved_by_another_version)
