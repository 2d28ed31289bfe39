# SPDX-License-Identifier: GPL-2.0-or-later
"""Rigid bodies that are free to move among soft grains: they take part in the contact solve with mass and inertia."""
import math
import os
import sys

from yade import O
from yade.minieigenHP import Vector3
from yade.utils import box, sphere, wall
from yade.wrapper import (FrictMat, Ig2_Sphere_Sphere_ScGeom, Ip2_FrictMat_FrictMat_FrictPhys,
                          Law2_ScGeom_FrictPhys_CundallStrack, PyRunner)

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import NeoHookeanMat, measures, rigidDisc, softDisc, softEngines  # noqa: E402

R = 1e-3


def start(friction=0.0, stone=1000.0, **disc):
    """A soft disc of radius R at the origin, and the material of rigid bodies [kg/m³]."""
    O.reset()
    O.materials.append(NeoHookeanMat(frictionAngle=math.atan(friction), label="gel"))
    O.materials.append(FrictMat(frictionAngle=math.atan(friction), density=stone, label="stone"))
    return O.bodies.append(softDisc((0, 0), R, "gel", **{"points": 124, **disc}))


def momentum(*bodies):
    return sum((O.bodies[body].state.mass * O.bodies[body].state.vel for body in bodies), Vector3.Zero)


def kinetic(body):
    """Kinetic energy of a rigid body [J/m]."""
    state = O.bodies[body].state
    return (state.mass * state.vel.squaredNorm() + state.inertia[2] * state.angVel[2]**2) / 2


def run_until(time):
    while O.time < time:
        O.step()


def mean_force(body, begin, end):
    """Along y, from one time to the other, which the scene runs to [N/m]."""
    total, first = 0.0, None
    while O.time < end:
        O.step()
        if O.time > begin:
            first = first or O.time
            total += O.forces.f(body)[1] * O.dt
    return total / (O.time - first)


def impact(sign=1, friction=0.0, dt=None, duration=6e-4, **disc):
    """A rigid disc flies into the soft one, from the right or, all turned by pi, from the left; the two bodies."""
    grain = start(friction, **disc)
    stone = O.bodies.append(rigidDisc((sign * 1.65 * R, sign * 0.3 * R), 0.6 * R, "stone", velocity=(-sign * 3, 0), spin=500))
    O.engines = softEngines(tolerance=1e-8, dt=dt)
    O.trackEnergy = True
    run_until(duration)
    return grain, stone


def momentum_is_kept(checks):
    for friction in (0.0, 0.5):
        grain, stone = impact(friction=friction)
        states = [O.bodies[body].state for body in (grain, stone)]
        before = -3 * states[1].mass
        total = momentum(grain, stone)
        checks.that("apart again", measures.softIntegrator().contactCount == 0)
        checks.that("momentum", (total - Vector3(before, 0, 0)).norm() < 1e-12 * abs(before), total / before)
        checks.that("they have met", states[0].vel.norm() > 1, states[0].vel)
        energy = measures.heldOrLost(measures.softIntegrator()) + kinetic(stone)
        first = states[1].mass * 9 / 2 + states[1].inertia[2] * 500**2 / 2
        checks.close_to("energy", energy / first, 1, 2e-3)
        soft = measures.softIntegrator()
        checks.that("the work on the grain is that of the stone",
                    abs(soft.externalWork + kinetic(stone) - first) < 1e-9 * first, soft.externalWork / first)
        tracked = sum(O.energy[name] for name in O.energy.keys() if name.startswith("soft"))
        checks.close_to("tracked energies", tracked / first, 0, 2e-3)
        spin = states[1].angVel[2]
        if friction:
            checks.that("friction changes the spin", abs(spin - 500) > 50 and soft.frictionDissipation > 0, spin)
        else:
            checks.that("nothing turns it without friction", abs(spin - 500) < 0.5, spin)


def all_turned_is_the_same(checks):
    found = []
    for sign in (1, -1):
        bodies = impact(sign, 0.5, angle=0 if sign > 0 else math.pi, dt=2e-7)
        found.append([O.bodies[body].state for body in bodies])
    for a, b in zip(*found):
        checks.that("velocity", (a.vel + b.vel).norm() < 1e-9 * a.vel.norm(), (a.vel, b.vel))
        checks.close_to("spin", b.angVel[2] / a.angVel[2], 1, 1e-9)


def it_rests_on_a_grain(checks):
    grain = start(points=276)
    O.bodies.append(wall(-R, axis=1, material="stone"))
    O.bodies[grain].state.blockedDOFs = "xZ"
    stone = O.bodies.append(rigidDisc((0, 1.5 * R), 0.5 * R, "stone"))
    O.bodies[stone].state.blockedDOFs = "zxXYZ"
    O.engines = softEngines(gravity=(0, -300, 0))
    mean = mean_force(stone, 0.01, 0.03)
    weight = O.bodies[stone].state.mass * 300
    checks.close_to("the grain carries it", mean / weight, 1, 0.02)
    checks.that("and it stays above", O.bodies[stone].state.pos[1] > 1.4 * R, O.bodies[stone].state.pos[1] / R)


def heavy_is_driven(checks):
    def speeds(heavy):
        grain = start(points=124)
        stone = O.bodies.append(rigidDisc((0, 1.62 * R), 0.6 * R, "stone", velocity=(0, -1)))
        state = O.bodies[stone].state
        if heavy:
            state.mass, state.inertia = 1e6 * O.bodies[grain].state.mass, Vector3(1, 1, 1) * 1e6 * R**2
        else:
            state.blockedDOFs = "xyzXYZ"
        O.engines = softEngines(tolerance=1e-10, dt=2e-7)
        found = []
        while O.iter < 2000:
            O.step()
            found.append(O.bodies[grain].state.vel[1])
        return found, state.vel[1]

    free, of_stone = speeds(True)
    driven, _ = speeds(False)
    checks.that("it went on", abs(of_stone + 1) < 1e-5, of_stone)
    worst = max(abs(a - b) for a, b in zip(free, driven))
    checks.that("the grain moves as under a driven one", worst < 2e-6 * -min(driven), worst)
    checks.that("it has moved", min(driven) < -0.5, min(driven))


def light_follows(checks):
    # a disc of a millionth of the grain's mass between the grain and a wall: the grain is pressed as by the wall itself
    grain = start(points=124)
    state = O.bodies[O.bodies.append(rigidDisc((0, 1.3 * R), 0.3 * R, "stone"))].state
    state.mass, state.inertia = 1e-6 * O.bodies[grain].state.mass, Vector3(1, 1, 1) * 1e-6 * 1e-3 * R**2 / 10
    O.bodies.append(softDisc((0, 2.6 * R), R, "gel", points=124, velocity=(0, -1)))
    for body in (grain, 2):
        O.bodies[body].state.blockedDOFs = "xZ"
    state.blockedDOFs = "zxXYZ"
    O.engines = softEngines(tolerance=1e-6)
    worst = steps = 0
    while O.time < 8e-4:
        O.step()
        forces = [force[1] for one, other, _, _, force in measures.softIntegrator().contacts()]
        worst = max(worst, measures.softIntegrator().maxPenetration())
        steps += len(forces) == 2
    total = momentum(grain, 1, 2)[1]
    checks.that("both were in touch", steps > 40, steps)
    checks.that("penetration", worst < 5e-3, worst)
    checks.that("momentum", abs(total / O.bodies[grain].state.mass + 1) < 1e-9, total / O.bodies[grain].state.mass)
    checks.close_to("the speed went through it", O.bodies[grain].state.vel[1], -1, 0.3)
    checks.that("the sweeps suffice", measures.softIntegrator().totalIterations < 40 * O.iter,
                measures.softIntegrator().totalIterations / O.iter)


def a_clump_turns(checks):
    # two spheres, hit off centre by a grain: angular momentum of the clump about its centre is the moment of the impulse
    grain = start(velocity=(2, 0))
    clump, members = O.bodies.appendClumped([sphere((2.1 * R, y * R, 0), 0.6 * R, material="stone") for y in (0.2, 1.4)])
    state = O.bodies[clump].state
    O.engines = softEngines(tolerance=1e-8)
    O.bodies[clump].state.blockedDOFs = "zXY"
    before = momentum(grain)
    turn, impulse = 0.0, Vector3.Zero
    while O.time < 8e-4:
        centre = Vector3(state.pos)
        O.step()
        for member in members:
            force, there = O.forces.f(member), O.bodies[member].state.pos
            impulse += O.dt * force
            turn += O.dt * ((there - centre).cross(force)[2] + O.forces.t(member)[2])
    checks.that("momentum", (momentum(grain, clump) - before).norm() < 1e-12 * before.norm())
    checks.that("it turns", state.angVel[2] > 50, state.angVel)
    checks.close_to("by the moment of the impulses", turn / (state.inertia[2] * state.angVel[2]), 1, 1e-3)
    for member in members:
        place, its = O.bodies[member].state.pos - state.pos, O.bodies[member].state
        checks.that("members stay in place", abs(place.norm() / (0.6 * R) - 1) < 1e-12, place.norm() / R)
        checks.that("and move with the clump", (its.vel - state.vel - state.angVel.cross(place)).norm() < 1e-12)


def a_free_clump_turns_by_its_momentum(checks):
    # without blocked turns NewtonIntegrator goes by the angular momentum
    grain = start(velocity=(2, 0))
    clump, _ = O.bodies.appendClumped([sphere((2.1 * R, y * R, 0), 0.6 * R, material="stone") for y in (0.2, 1.4)])
    O.engines = softEngines()
    run_until(8e-4)
    state = O.bodies[clump].state
    checks.that("it turns", state.angVel[2] > 50, state.angVel)
    before = Vector3(state.angVel)
    O.step()
    checks.close_to("and goes on", state.angVel[2] / before[2], 1, 1e-9)


def blocked_stays(checks):
    start(friction=0.5, velocity=(0, 2))
    stone = O.bodies.append(rigidDisc((0.5 * R, 1.6 * R), 0.6 * R, "stone", velocity=(0.1, 0)))
    state = O.bodies[stone].state
    state.blockedDOFs = "xzXYZ"
    O.engines = softEngines()
    run_until(5e-4)
    checks.that("x and Z stay", state.vel[0] == 0.1 and state.angVel[2] == 0, (state.vel, state.angVel))
    checks.that("y moves", state.vel[1] > 0.5, state.vel)


def a_piston_is_thrown(checks):
    grain = start(velocity=(0, 2))
    piston = O.bodies.append(wall(1.02 * R, axis=1, material="stone"))
    state = O.bodies[piston].state
    state.mass, state.blockedDOFs = 2 * O.bodies[grain].state.mass, "xzXYZ"
    O.engines = softEngines(tolerance=1e-8)
    run_until(6e-4)
    total = momentum(grain, piston)[1]
    checks.that("momentum", abs(total / (2 * O.bodies[grain].state.mass) - 1) < 1e-12, total)
    checks.that("it flies", state.vel[1] > 0.8, state.vel)


def a_lid_rests_among_walls(checks):
    start(points=60)
    O.bodies.append([wall(x * R, axis=0, material="stone") for x in (-1, 1)] + [wall(-R, axis=1, material="stone")])
    lid = O.bodies.append(wall(1.001 * R, axis=1, sense=-1, material="stone"))
    O.bodies[lid].state.mass, O.bodies[lid].state.blockedDOFs = 1e-2, "xzXYZ"
    O.engines = softEngines(gravity=(0, -100, 0))
    checks.close_to("the grain carries it", mean_force(lid, 0.002, 0.02) / (1e-2 * 100), 1, 0.02)


def a_box_is_hit(checks):
    grain = start(velocity=(2, 0))
    block = O.bodies.append(box((1.55 * R, 0.6 * R, 0), (0.5 * R, 1 * R, R), material="stone"))
    O.engines = softEngines(tolerance=1e-8)
    before = momentum(grain)
    run_until(8e-4)
    state = O.bodies[block].state
    checks.that("momentum", (momentum(grain, block) - before).norm() < 1e-12 * before.norm())
    checks.that("it turns", state.angVel[2] > 20, state.angVel)


def rebound_converges_with_dt(checks):
    speeds = []
    for dt in (4e-7, 2e-7, 1e-7, 2.5e-8):
        _, stone = impact(dt=dt, points=60)
        speeds.append(O.bodies[stone].state.vel.norm())
    errors = [abs(speed - speeds[-1]) for speed in speeds[:-1]]
    checks.that("errors fall", errors[0] > errors[1] > errors[2] or max(errors) < 1e-3, errors)
    checks.that("and are small", errors[2] < 5e-3, errors)


def state_of_all():
    return [value for body in O.bodies for vector in (body.state.pos, body.state.vel, body.state.angVel) for value in vector]


def goes_on_after_a_break(checks):
    def build():
        start(friction=0.3, velocity=(0, 1))
        O.bodies.append(rigidDisc((0.3 * R, 1.55 * R), 0.5 * R, "stone", velocity=(0, -1)))
        O.bodies.appendClumped([sphere((2.1 * R, y * R, 0), 0.6 * R, material="stone") for y in (0.2, 1.2)])
        for body in O.bodies:
            body.state.blockedDOFs = body.state.blockedDOFs or "zXY"
        O.engines = softEngines()

    build()
    O.run(1500, True)
    whole = state_of_all()
    with Folder() as folder:
        build()
        O.run(700, True)
        O.save(os.path.join(folder, "half.yade.gz"))
        O.reset()
        O.load(os.path.join(folder, "half.yade.gz"))
        O.run(800, True)
    size = max(abs(value) for value in whole)
    worst = max(abs(a - b) for a, b in zip(whole, state_of_all())) / size
    checks.that("a saved and loaded run is the same", worst < 1e-9, worst)


def rigid_bodies_meet_by_yades_law(checks):
    start()
    O.bodies.append([rigidDisc((2.05 * R, 0), R, "stone"), rigidDisc((4.1 * R, 0), R, "stone", velocity=(-1, 0))])
    functors = [Ig2_Sphere_Sphere_ScGeom(), Ip2_FrictMat_FrictMat_FrictPhys(), Law2_ScGeom_FrictPhys_CundallStrack()]
    O.engines = softEngines(functors=functors)
    mass = O.bodies[1].state.mass
    run_until(4e-3)
    checks.that("the push went through to the grain", O.bodies[0].state.vel[0] < -0.3, O.bodies[0].state.vel)
    checks.that("momentum", abs(momentum(0, 1, 2)[0] / mass + 1) < 1e-9, momentum(0, 1, 2))


def gravity_and_forces_act_once(checks):
    start()
    stone = O.bodies.append(rigidDisc((0, 5 * R), R, "stone"))
    O.engines = softEngines(gravity=(0, -10, 0), more=[PyRunner(iterPeriod=1, command="pass")])
    O.run(300, True)
    checks.close_to("free fall", O.bodies[stone].state.vel[1] / (-10 * O.time), 1, 1e-9)
    checks.close_to("as the grain", O.bodies[0].state.vel[1] / (-10 * O.time), 1, 0.02)


run_tests(momentum_is_kept, all_turned_is_the_same, it_rests_on_a_grain, heavy_is_driven, light_follows, a_clump_turns,
          a_free_clump_turns_by_its_momentum, blocked_stays, a_piston_is_thrown, a_lid_rests_among_walls, a_box_is_hit,
          rebound_converges_with_dt, goes_on_after_a_break, rigid_bodies_meet_by_yades_law, gravity_and_forces_act_once)
