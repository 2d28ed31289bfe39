# SPDX-License-Identifier: GPL-2.0-or-later
"""What a person sets on a soft grain once it runs takes effect, or is refused by one sentence: position, velocity, blocked
degrees of freedom, forces in O.forces, material; not orientation and shape."""
import math
import os
import random
import re
import sys

import numpy
from yade import O
from yade.minieigenHP import Quaternion, Vector3
from yade.utils import wall
from yade.wrapper import ForceEngine, FrictMat, PyRunner, RotationEngine, TorqueEngine, TranslationEngine

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import MooneyRivlinMat, NeoHookeanMat, arrays, measures, softDisc, softEngines  # noqa: E402

RADIUS = 1e-3
MASS = 1000 * math.pi * RADIUS**2       # kg/m
NAN = math.nan


def run(steps=50):
    for _ in range(steps):
        O.step()


def scene(*discs, engines=None, walls=(), **options):
    """Discs, each given by its x and further arguments of softDisc, over walls; the first disc's body, ten steps on."""
    O.reset()
    O.materials.append(NeoHookeanMat(frictionAngle=0.3, label="gel"))
    O.materials.append(FrictMat(frictionAngle=0.3, label="stone"))
    for x, more in discs or ((0, {}),):
        O.bodies.append(softDisc((x, 0), RADIUS, "gel", points=60, **more))
    for y, sense in walls:
        O.bodies.append(wall(y, axis=1, sense=sense, material="stone"))
    O.engines = (engines or (lambda soft: soft))(softEngines(**options))
    run(10)
    return O.bodies[0]


def before_newton(*more):
    return lambda soft: [*soft[:-2], *more, *soft[-2:]]


def balance():
    """Energy that came from nowhere [J/m]."""
    soft = measures.softIntegrator()
    return measures.heldOrLost(soft) - soft.externalWork


def position(checks):
    body = scene(walls=[(-1.5e-3, 1)])
    points = arrays.points(body)
    body.state.pos = (5e-3, 1e-3, 0)
    checks.close_to("the centre is there", (body.state.pos - Vector3(5e-3, 1e-3, 0)).norm(), 0, 1e-15)
    checks.close_to("all points go along", abs(arrays.points(body) - points - (5e-3, 1e-3)).max(), 0, 1e-15)
    run()
    checks.close_to("and stay there", (body.state.pos - Vector3(5e-3, 1e-3, 0)).norm(), 0, 1e-14)
    checks.close_to("without strain", measures.softIntegrator().minJ(), 1, 1e-12)
    body.state.pos = (0, -4.5e-4, 0)
    body.state.vel = (0, -1, 0)
    run(200)
    checks.that("it meets the wall near which it was put", O.forces.f(1)[1] < 0 or body.state.vel[1] > -0.9, body.state.vel)

    body = scene((0, {}), (3e-3, {}))
    body.state.pos = (1.5e-3, 0, 0)
    checks.raises("into another grain", RuntimeError, ["#0", "#1", "overlap", "0.00049"], run)
    body.state.pos = (0, 0, 0)
    run()
    checks.raises("NaN", ValueError, ["#0", "position", "finite"], lambda: setattr(body.state, "pos", (NAN, 0, 0)))


def velocity(checks):
    body = scene((0, {"spin": 100}), gravity=(0, -10, 0))
    start, time = balance(), O.time
    body.state.vel = (2, 0, 0)
    body.state.angVel = (0, 0, -300)
    checks.close_to("reads as set", body.state.vel[0], 2, 0)
    run()
    time = O.time - time
    checks.close_to("flies", body.state.vel[0], 2, 1e-12)
    checks.close_to("falls", body.state.vel[1], -10 * time, 1e-9)
    checks.close_to("spins", body.state.angVel[2], -300, 1)     # it stretches, and so turns a little slower
    speeds = arrays.pointVelocities(body) - (2, -10 * time)
    arms = arrays.points(body) - tuple(body.state.pos)[:2]
    checks.close_to("as a rigid body", abs(speeds + 300 * numpy.stack([-arms[:, 1], arms[:, 0]], 1)).max(), 0, 0.02)
    checks.close_to("its energy is accounted for", balance(), start, 1e-5 * measures.softIntegrator().kineticEnergy())
    body.state.vel[1] = 5
    run(1)
    checks.close_to("one component", body.state.vel[1], 5, 1e-3)
    for what, vel, angVel in (("NaN", (NAN, 0, 0), (0, 0, 0)), ("out of the plane", (0, 0, 1), (0, 0, 0)),
                              ("spin out of the plane", (0, 0, 0), (1, 0, 0))):
        body.state.vel, body.state.angVel = vel, angVel
        checks.raises(what, ValueError, ["#0", "velocity", "plane"], run)
    body.state.vel = body.state.angVel = (0, 0, 0)
    run()
    checks.close_to("mended", body.state.vel[0], 0, 1e-12)

    def kick():
        if O.iter == 30:
            O.bodies[0].state.vel += (1, 0, 0)

    sys.modules["builtins"].kick = kick
    for place in "first", "last":
        runner = [PyRunner(command="kick()", iterPeriod=1)]
        body = scene(engines=(lambda soft: runner + soft) if place == "first" else (lambda soft: soft + runner))
        run(30)
        checks.close_to(f"by a PyRunner, {place} in the list", body.state.vel[0], 1, 1e-12)


def saved_and_loaded(checks):
    with Folder() as folder:
        path = os.path.join(folder, "scene.yade")
        for what in "before saving", "after loading":
            scene((0, {"velocity": (1, 0, 0)}))

            def change():
                O.bodies[0].state.pos += (0, 1e-3, 0)
                O.bodies[0].state.vel = (3, 0, 0)

            if what == "before saving":
                change()
            O.save(path, quiet=True)
            O.load(path, quiet=True)
            if what == "after loading":
                change()
            x = O.bodies[0].state.pos[0]
            time = O.time
            run()
            state = O.bodies[0].state
            checks.close_to(f"velocity set {what}", state.pos[0], x + 3 * (O.time - time), 1e-12)
            checks.close_to(f"position set {what}", state.pos[1], 1e-3, 1e-12)
            checks.close_to(f"points, {what}", arrays.points(O.bodies[0])[:, 1].mean(), 1e-3, 1e-7)


def a_held_grain_goes_on_when_loaded(checks):
    with Folder() as folder:
        path = os.path.join(folder, "scene.yade")
        found = []
        for saving in False, True:
            body = scene(walls=[(1.001e-3, -1)], engines=before_newton(TorqueEngine(ids=[0], moment=(0, 0, 1e-3))))
            body.state.blockedDOFs = "y"
            O.bodies[1].state.vel = (0, -2, 0)
            run(200)
            body.state.vel[0] = 0.5
            body.state.vel = (0.5, 0.1, 0)
            if saving:
                O.save(path, quiet=True)
                O.load(path, quiet=True)
            run(200)
            soft = measures.softIntegrator()
            found.append([*arrays.points(O.bodies[0]).ravel() / RADIUS, O.bodies[0].state.vel[0], balance(), soft.externalWork])
        difference = abs(numpy.subtract(*found)).max()
        checks.that("the same as without a break", difference < 1e-9, difference)
        checks.close_to("and goes its way", O.bodies[0].state.vel[1], 0.1, 1e-9)


def forces(checks):
    force, torque = 50.0, 5e-3
    body = scene(engines=before_newton(ForceEngine(ids=[0], force=(force, 0, 0)), TorqueEngine(ids=[0], moment=(0, 0, torque))))
    checks.close_to("a ForceEngine", body.state.vel[0], force / MASS * O.time, 1e-6 * body.state.vel[0])
    inertia = body.state.inertia[2]
    checks.close_to("a TorqueEngine", body.state.angVel[2], torque / inertia * O.time, 1e-3 * body.state.angVel[2])
    checks.close_to("bends nothing", measures.softIntegrator().minJ(), 1, 1e-6)
    run(200)
    checks.close_to("its work", balance(), 0, 1e-6 * measures.softIntegrator().kineticEnergy())

    body = scene()
    O.forces.setPermF(0, (0, force, 0))
    O.forces.setPermT(0, (0, 0, torque))
    start = O.time
    run()
    checks.close_to("O.forces.setPermF", body.state.vel[1], force / MASS * (O.time - start), 1e-6 * body.state.vel[1])
    checks.that("O.forces.setPermT", body.state.angVel[2] > 0)
    O.forces.setPermF(0, (0, 0, 1))
    checks.raises("out of the plane", RuntimeError, ["#0", "force", "xy-plane"], run)
    O.forces.setPermF(0, (0, NAN, 0))
    checks.raises("NaN", RuntimeError, ["#0", "force", "finite"], run)

    body = scene(walls=[(-1.0001e-3, 1)], engines=before_newton(ForceEngine(ids=[0], force=(0, -force, 0))))
    largest = 0
    for _ in range(3000):
        O.step()
        largest = max(largest, measures.softIntegrator().maxPenetration())
    checks.that("presses the grain on a wall", O.forces.f(1)[1] < 0 and largest < 2e-3, largest)


def blocked(checks):
    body = scene((0, {"velocity": (1, 0, 0)}), gravity=(0, -10, 0))
    body.state.blockedDOFs = "y"
    y = body.state.vel[1]
    run(100)
    checks.close_to("y is held at its velocity", body.state.vel[1], y, 1e-12)
    checks.close_to("x is free", body.state.vel[0], 1, 1e-12)
    body.dynamic = False
    run(100)
    checks.that("body.dynamic = False stops it", body.state.vel.norm() == 0 and body.state.angVel.norm() == 0)
    place = body.state.pos
    run(100)
    checks.close_to("for good", (body.state.pos - place).norm(), 0, 1e-12)
    checks.that("it comes to rest", measures.softIntegrator().kineticEnergy() < 1e-6)

    # a grain between one that is held and a wall that comes down on it
    for blocking in "xyZ", "yZ":
        body = scene((0, {}), (5e-3, {}), walls=[(1.001e-3, -1)], safety=0.6)
        body.state.blockedDOFs = blocking
        O.bodies[2].state.vel = (0, -2, 0)
        largest = 0
        while O.bodies[2].state.pos[1] > 0.8e-3:
            O.step()
            largest = max(largest, measures.softIntegrator().maxPenetration())
        checks.close_to(f"{blocking}: held against a wall", body.state.pos[1], 0, 1e-9)
        checks.that(f"{blocking}: it is pressed, not passed", largest < 2e-3 and O.forces.f(2)[1] > 10, (largest, O.forces.f(2)))
        soft = measures.softIntegrator()
        checks.close_to(f"{blocking}: energy", balance(), 0, 5e-3 * soft.externalWork)

    body = scene((0, {}), (2.001e-3, {}))
    body.state.blockedDOFs = "xyZ"
    body.state.vel = (2, 0, 0)
    O.bodies[1].state.blockedDOFs = "Z"
    run(1)
    x, time = body.state.pos[0], O.time
    run(1500)
    checks.close_to("a driven grain keeps its way", body.state.pos[0], x + 2 * (O.time - time), 1e-9)
    checks.that("and pushes another", O.bodies[1].state.vel[0] > 1.5, O.bodies[1].state.vel)
    checks.close_to("energy", balance(), 0, 5e-3 * measures.softIntegrator().externalWork)


def driven_by_engines(checks):
    slide = TranslationEngine(ids=[0], velocity=3, translationAxis=(1, 0, 0))
    turn = RotationEngine(ids=[0], angularVelocity=100, rotationAxis=(0, 0, 1))

    def held(engine):
        def with_engine(soft):
            O.bodies[0].state.blockedDOFs = "xyZ"
            return before_newton(engine)(soft)
        return with_engine

    body = scene(engines=held(slide))
    x, time = body.state.pos[0], O.time
    run(200)
    checks.close_to("TranslationEngine on a blocked grain", body.state.pos[0] - x, 3 * (O.time - time), 1e-9)
    body = scene(engines=held(turn))
    checks.close_to("RotationEngine on a blocked grain", body.state.angVel[2], 100, 1e-9)
    displaced = scene()
    O.engines = [StepDisplacer(ids=[displaced.id], mov=(1e-6, 0, 0))] + O.engines
    checks.raises("StepDisplacer", RuntimeError, ["StepDisplacer", "#0", "state.pos"], run)
    checks.raises("on a free grain", RuntimeError, ["TranslationEngine", "#0", "blockedDOFs"],
                  lambda: scene(engines=before_newton(slide)))


def materials(checks):
    body = scene(walls=[(-1.001e-3, 1), (1.001e-3, -1)])
    for wall_id, speed in ((1, 1), (2, -1)):
        O.bodies[wall_id].state.vel = (0, speed, 0)
    run(200)
    for wall_id in 1, 2:
        O.bodies[wall_id].state.vel = (0, 0, 0)
    soft = measures.softIntegrator()
    elastic, critical = soft.elasticEnergy(), soft.criticalStep
    for name in "lambda_", "mu":
        setattr(body.material, name, 4 * getattr(body.material, name))
    run(1)
    checks.close_to("four times the moduli, four times the energy", soft.elasticEnergy() / elastic, 4, 0.2)
    checks.close_to("and half the stable step", soft.criticalStep / critical, 0.5, 0.01)
    checks.that("the time step follows", O.dt < soft.criticalStep)
    body.material.density = 2000
    run(1)
    checks.close_to("mass follows density", body.state.mass, 2 * MASS, 1e-9)
    checks.raises("a mass by hand", ValueError, ["#0", "mass", "density"], lambda: setattr(body.state, "mass", 1))
    checks.raises("inertia by hand", ValueError, ["#0", "inertia", "density"],
                  lambda: setattr(body.state, "inertia", Vector3(1, 1, 1)))
    body.material.mu = -1
    checks.raises("a bad value", (RuntimeError, ValueError), ["#0", "mu", "-1"], run)
    body.material.mu = 1e6
    run(1)
    body.material = MooneyRivlinMat(density=2000)
    run(20)
    checks.that("another law", numpy.isfinite(soft.elasticEnergy()))
    body.material = FrictMat()
    checks.raises("a material that is not soft", (RuntimeError, ValueError), ["#0", "NeoHookeanMat"], run)


def friction_of_a_contact(checks):
    body = scene((0, {"velocity": (1, 0, 0)}), walls=[(-1.0001e-3, 1)], gravity=(0, -1e5, 0))
    run(100)
    contact = O.interactions[0, 1].phys
    body.material.frictionAngle = O.bodies[1].material.frictionAngle = 0.8
    run(10)
    checks.close_to("keeps that of its start", contact.tangensOfFrictionAngle, math.tan(0.3), 1e-15)
    contact.tangensOfFrictionAngle = 0
    force = O.forces.f(1)[0]
    run(10)
    checks.that("can be set", force > 0 and O.forces.f(1)[0] == 0, (force, O.forces.f(1)))


def shape_and_orientation(checks):
    for name, value in (("radius", 2e-3), ("points", 124), ("vertices", [(0, 0, 0), (1, 0, 0), (0, 1, 0)])):
        body = scene()
        kept = getattr(body.shape, name)
        setattr(body.shape, name, value)
        for attempt in "first", "second":
            checks.raises(f"shape.{name}, {attempt} time", (RuntimeError, ValueError), ["#0", "shape", "append"], run)
        setattr(body.shape, name, kept)
        run(5)
    body = scene()
    body.state.ori = body.state.ori
    body.state.se3 = ((0, 1e-3, 0), body.state.ori)
    checks.close_to("state.se3", arrays.points(body)[:, 1].mean(), 1e-3, 1e-6)
    checks.raises("state.se3 with a turn", (RuntimeError, ValueError), ["#0", "turned"],
                  lambda: setattr(body.state, "se3", ((0, 0, 0), Quaternion((0, 0, 1), 0.5))))
    checks.raises("state.ori", (RuntimeError, ValueError), ["#0", "turned", "angVel"],
                  lambda: setattr(body.state, "ori", Quaternion((0, 0, 1), 0.5)))
    run(5)


def spoil(grain, amount):
    """Moves the nodes of a grain of the scene at random [R], which a saved scene alone allows; loads it."""
    generator = random.Random(1)
    with Folder() as folder:
        path = os.path.join(folder, "scene.xml")
        O.save(path, quiet=True)
        with open(path, encoding="utf-8") as file:
            parts = re.split("(<nodeDisplacement.*?</nodeDisplacement>)", file.read(), flags=re.DOTALL)
        parts[2 * grain + 1] = re.sub("<item>.*?</item>", lambda _: f"<item>{generator.uniform(-amount, amount)}</item>",
                                      parts[2 * grain + 1])
        with open(path, "w", encoding="utf-8") as file:
            file.write("".join(parts))
        O.load(path, quiet=True)


def untangled(checks):
    def start():
        scene(*[(3 * RADIUS * k, {"velocity": (0.1 * k, 0, 0)}) for k in range(9)], safety=0.1)
        spoil(4, 1)
        measures.softIntegrator().elasticEnergy()   # grains are in batches now
        return O.bodies[4].state

    state = start()
    checks.that("points are turned inside out", state.minJ() < 0, state.minJ())
    checks.raises("no step goes on", RuntimeError, ["#4", "inside out", "untangle()"], run)
    state = start()
    others = [arrays.points(body) for body in O.bodies if body.id != 4]
    place, velocity, time = state.pos, state.vel, O.time
    state.untangle(0.7)
    checks.that("J is what was asked for", state.minJ() >= 0.7, state.minJ())
    checks.close_to("the centre stays", (state.pos - place).norm(), 0, 1e-15)
    checks.close_to("and its velocity", (state.vel - velocity).norm(), 0, 1e-14)
    checks.close_to("others stay", max(abs(arrays.points(body) - points).max() for body, points in
                                       zip([body for body in O.bodies if body.id != 4], others)), 0, 0)
    soft = measures.softIntegrator()
    whole = soft.kineticEnergy() + soft.elasticEnergy()
    least = 1
    for _ in range(300):
        O.step()
        least = min(least, soft.minJ())
    checks.that("goes on without a point turned", least > 0.5, least)
    checks.close_to("and without energy from nowhere", soft.kineticEnergy() + soft.elasticEnergy(), whole, 0.01 * whole)
    checks.close_to("along its way", (state.pos - place - velocity * (O.time - time)).norm(), 0, 1e-9 * RADIUS)
    points = arrays.points(O.bodies[3])
    O.bodies[3].state.untangle()
    checks.close_to("a sound grain stays", abs(arrays.points(O.bodies[3]) - points).max(), 0, 0)
    for least in (0, -1, 1.1, NAN):
        checks.raises(f"leastJ = {least}", ValueError, ["#3", "least J"], lambda: O.bodies[3].state.untangle(least))
    checks.raises("an updated-Lagrangian grain", ValueError, ["#0", "total"],
                  lambda: scene((0, {"formulation": "updated"})).state.untangle())
    checks.raises("a grain that runs nowhere", ValueError, ["O.bodies"], softDisc((0, 0), RADIUS, "gel").state.untangle)


run_tests(untangled, position, velocity, saved_and_loaded, a_held_grain_goes_on_when_loaded, forces, blocked,
          driven_by_engines, materials, friction_of_a_contact, shape_and_orientation)
