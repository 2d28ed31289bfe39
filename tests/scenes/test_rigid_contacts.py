# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies among each other by Contact Dynamics, alone and with soft grains, against closed forms."""
import math
import os
import sys

from yade import O
from yade.minieigenHP import Vector3
from yade.utils import box, facet, sphere, wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import (NeoHookeanMat, discCloud, measures, rigidContacts, rigidDisc, softBox, softDisc,  # noqa: E402
                       softEngines)

R, G = 0.01, 9.81


def start(friction=0.0):
    O.reset()
    O.materials.append(FrictMat(density=2000, frictionAngle=math.atan(friction), label="stone"))


def go(steps, dt=1e-4, gravity=(0, 0, 0), **engines):
    O.engines = softEngines(dt=dt, gravity=gravity, functors=rigidContacts(), **engines)
    for _ in range(steps):
        O.step()


def disc(x, y, radius=R, **motion):
    return O.bodies[O.bodies.append(rigidDisc((x, y), radius, "stone", **motion))]


def kinetic(bodies):
    return sum((b.state.mass * b.state.vel.squaredNorm() + b.state.inertia[2] * b.state.angVel[2]**2) / 2 for b in bodies)


def impact(checks):
    """Two discs go on with the velocity of their centre of mass; what they lose is accounted for."""
    for friction in (0.0, 0.3):
        start(friction)
        pair = [disc(0, 0, velocity=(1, 0, 0)), disc(5 * R, 0.8 * R, 2 * R, velocity=(-1, 0, 0), spin=20)]
        momentum = sum((b.state.mass * b.state.vel for b in pair), Vector3.Zero)
        angular = sum((b.state.mass * b.state.pos.cross(b.state.vel) + b.state.inertia[2] * b.state.angVel for b in pair),
                      Vector3.Zero)
        energy = kinetic(pair)
        go(400)
        after = sum((b.state.mass * b.state.vel for b in pair), Vector3.Zero)
        turned = sum((b.state.mass * b.state.pos.cross(b.state.vel) + b.state.inertia[2] * b.state.angVel for b in pair),
                     Vector3.Zero)
        soft = measures.softIntegrator()
        lost = soft.contactDissipation + soft.frictionDissipation
        checks.that("they have met", pair[0].state.vel[0] < 0.5, pair[0].state.vel)
        checks.that("momentum", (after - momentum).norm() < 1e-12, (after, momentum))
        checks.that("angular momentum", abs(turned[2] - angular[2]) < 1e-6 * abs(angular[2]), (turned[2], angular[2]))
        checks.close_to("energy", (kinetic(pair) + lost) / energy, 1, 1e-9)
        checks.that("work of rigid bodies", abs(soft.externalWork - lost) < 1e-9 * energy, soft.externalWork)
        checks.that("no overlap", (pair[1].state.pos - pair[0].state.pos).norm() > 3 * R * (1 - 1e-6))


def incline(checks):
    """A disc rolls with 2/3 of what pulls it, or slides."""
    for friction, angle in ((0.5, 0.3), (0.05, 0.6)):
        start(friction)
        O.bodies.append(wall(0, axis=1, sense=1, material="stone"))
        one = disc(0, R)
        go(2000, gravity=(G * math.sin(angle), -G * math.cos(angle), 0))
        rolls = friction > math.tan(angle) / 3
        pull = 2 / 3 * math.sin(angle) if rolls else math.sin(angle) - friction * math.cos(angle)
        turn = G * pull / R if rolls else 2 * friction * G * math.cos(angle) / R
        checks.close_to(f"acceleration at friction {friction}", one.state.vel[0] / (0.2 * G * pull), 1, 1e-3)
        checks.close_to(f"turning at friction {friction}", -one.state.angVel[2] / (0.2 * turn), 1, 1e-3)


def stack(checks):
    """On walls, boxes, facets: the floor bears the weight, and none sinks in."""
    floors = {"wall": lambda: wall(0, axis=1, sense=1, material="stone"),
              "box": lambda: box((0, -R, 0), (5 * R, R, R), fixed=True, material="stone"),
              "facet": lambda: facet([(-5 * R, 0, -R), (5 * R, 0, -R), (0, 0, 5 * R)], fixed=True, material="stone")}
    for name, floor in floors.items():
        start(0.5)
        ground = O.bodies.append(floor())
        discs = [disc(0, (1 + 2.001 * i) * R) for i in range(5)]
        go(3000, gravity=(0, -G, 0), tolerance=1e-6)
        weight = G * sum(b.state.mass for b in discs)
        checks.close_to(f"{name}: it bears the weight", -O.forces.f(ground)[1] / weight, 1, 1e-3)
        soft = measures.softIntegrator()
        checks.that(f"{name}: no penetration", soft.maxPenetration() < 1e-3, soft.maxPenetration())
        checks.that(f"{name}: at rest", max(b.state.vel.norm() for b in discs) < 1e-6)
        checks.that(f"{name}: in contacts()", len(soft.contacts()) == 5, soft.contacts())


def masses(checks):
    """A disc a million times heavier on a light one: no stiffness, no shorter step."""
    start(0.3)
    ground = O.bodies.append(wall(0, axis=1, sense=1, material="stone"))
    light, heavy = disc(0, R), disc(0, 3 * R)
    heavy.state.mass *= 1e6
    heavy.state.inertia *= 1e6
    go(2000, gravity=(0, -G, 0), tolerance=1e-8)
    checks.close_to("weight", -O.forces.f(ground)[1] / (G * (light.state.mass + heavy.state.mass)), 1, 1e-3)
    checks.that("in place", abs(heavy.state.pos[1] / R - 3) < 1e-3, heavy.state.pos[1] / R)


def clumps(checks):
    """A clump of two discs on a floor is one body."""
    start(0.5)
    ground = O.bodies.append(wall(0, axis=1, sense=1, material="stone"))
    clump, _ = O.bodies.appendClumped([rigidDisc((-R, R), R, "stone"), rigidDisc((R, R), R, "stone")])
    O.bodies[clump].state.blockedDOFs = "zXY"
    top = disc(0, (1 + math.sqrt(3)) * R)
    go(2000, gravity=(0, -G, 0), tolerance=1e-6)
    weight = G * (O.bodies[clump].state.mass + top.state.mass)
    checks.close_to("the floor bears both", -O.forces.f(ground)[1] / weight, 1, 1e-2)
    checks.that("the clump does not sink", abs(O.bodies[clump].state.pos[1] - R) < 1e-3 * R, O.bodies[clump].state.pos)


def with_a_grain(checks):
    """Two rigid discs, one on the other, on a soft grain between guides: it bears both, in one contact solve."""
    start(0.0)
    O.materials.append(NeoHookeanMat(lambda_=61e6, mu=1.26e6, label="gel"))
    O.bodies.append(softDisc((0, 0), R, "gel", points=60))
    ground = O.bodies.append(wall(-R, axis=1, sense=1, material="stone"))
    discs = [disc(0, 2 * R), disc(0, 4 * R)]
    for body in discs:
        body.state.blockedDOFs = "zxXYZ"
    gravity = (0, -300, 0)
    O.engines = softEngines(gravity=gravity, functors=rigidContacts())
    force = begin = time = 0.0
    while O.time < 0.3:
        O.step()
        if O.time > 0.1:
            begin = begin or O.time
            force += O.dt * O.forces.f(ground)[1]
            time = O.time - begin
    weight = 300 * (sum(b.state.mass for b in discs) + O.bodies[0].state.mass)
    checks.close_to("weight", -force / time / weight, 1, 0.02)
    checks.that("they touch", abs((discs[1].state.pos - discs[0].state.pos).norm() / R - 2) < 1e-3)


def packing(checks):
    """A compacted packing: all stay inside."""
    start(0.3)
    radii, places, _, height = discCloud(20 * R, 60, (1.4 * R, 2.4 * R), 0.6, seed=5)
    for radius, (x, y) in zip(radii, places):
        disc(x, y, radius)
    *_, top = O.bodies.append(softBox(20 * R, height, "stone"))
    O.bodies[top].state.vel = (0, -0.5, 0)
    go(400, dt=1e-4)
    soft = measures.softIntegrator()
    checks.that("residual", soft.residual() < 0.05, soft.residual())
    checks.that("penetration", soft.maxPenetration() < 0.02, soft.maxPenetration())
    inside = [b for b in O.bodies if b.id < 60 and not (0 < b.state.pos[0] < 20 * R and 0 < b.state.pos[1])]
    checks.that("all inside", not inside, [b.id for b in inside])


def saved(checks):
    """A saved scene goes on with the same digits."""
    def final():
        return [tuple(O.bodies[i].state.pos) for i in (1, 2, 3)]
    with Folder() as folder:
        path = os.path.join(folder, "scene.yade.gz")
        start(0.4)
        O.bodies.append(wall(0, axis=1, sense=1, material="stone"))
        for i in range(3):
            disc(0.3 * i * R, (1 + 1.95 * i) * R)
        go(300, gravity=(0, -G, 0))
        O.save(path)
        for _ in range(300):
            O.step()
        whole = final()
        O.load(path)
        for _ in range(300):
            O.step()
        checks.that("the same digits", final() == whole, (final(), whole))


def refusals(checks):
    def complaint(steps=20, **engines):
        try:
            go(steps, gravity=(0, -G, 0), **engines)
        except RuntimeError as error:
            return str(error)
        return "nothing was said"

    start()
    O.bodies.append(wall(0, axis=1, sense=1, material="stone"))
    O.bodies.append(sphere((0, 0, 0.99 * R), R, material="stone"))
    O.bodies[1].state.pos = (0, 0.99 * R, 0)
    text = complaint()
    checks.that("off the plane", "#1" in text and "zXY" in text, text)
    start()
    one, other = disc(0, 0), disc(0, 1.9 * R)
    other.state.pos = (0, 1.9 * R, 0.1 * R)
    text = complaint()
    checks.that("different z", "same z" in text, text)
    start()
    one, other = disc(0, 0), disc(0, 1.9 * R)
    one.state.mass = 0
    text = complaint()
    checks.that("no mass", "#0" in text and "mass" in text, text)
    start()
    disc(0, 0), disc(0, 1.9 * R)
    O.engines = softEngines(functors=rigidContacts())
    try:
        O.step()
        text = "nothing was said"
    except RuntimeError as error:
        text = str(error)
    checks.that("no step", "softEngines(dt=" in text, text)


run_tests(impact, incline, stack, masses, clumps, with_a_grain, packing, saved, refusals)
