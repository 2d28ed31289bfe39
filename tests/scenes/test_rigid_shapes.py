# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft grains against YADE's rigid shapes: fixed and driven spheres, facets, clumps."""
import math
import os
import sys

from yade import O
from yade.minieigenHP import Vector3
from yade.utils import facet, sphere, wall
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import NeoHookeanMat, measures, softDisc, softEngines  # noqa: E402

R = 1e-3


def start(friction=0.0, **disc):
    """A soft disc of radius R at the origin, and the material of rigid bodies."""
    O.reset()
    O.materials.append(NeoHookeanMat(frictionAngle=math.atan(friction), label="gel"))
    O.materials.append(FrictMat(frictionAngle=math.atan(friction), label="stone"))
    return O.bodies.append(softDisc((0, 0), R, "gel", **{"points": 124, **disc}))


def strip(ends):
    """Two facets that cut the line between two points of the plane."""
    (x0, y0), (x1, y1) = ends
    a, b, c, d = (x0, y0, -2 * R), (x1, y1, -2 * R), (x1, y1, 3 * R), (x0, y0, 3 * R)
    return [facet((a, b, c), material="stone"), facet((a, c, d), material="stone")]


def press(low, high, squeeze=0.1, speed=0.5, **engines):
    """Drives two lists of bodies towards each other; force on the upper one [N/m] at every tenth step."""
    for body in low:
        O.bodies[body].state.vel = Vector3(0, speed, 0)
    for body in high:
        O.bodies[body].state.vel = Vector3(0, -speed, 0)
    O.engines = softEngines(**engines)
    forces = []
    while O.time * speed < squeeze * R:
        O.step()
        if O.iter % 10 == 0:
            forces.append(sum(O.forces.f(body)[1] for body in high))
    return forces


def balance():
    soft = measures.softIntegrator()
    return measures.heldOrLost(soft) / soft.externalWork - 1


def plates(of_facets):
    start()
    if of_facets:
        sides = [O.bodies.append(strip([(-3 * R, y), (0.5 * R, y)]) + strip([(0.5 * R, y), (3 * R, y)]))
                 for y in (-R, R)]
    else:
        sides = [[O.bodies.append(wall(y, axis=1, material="stone"))] for y in (-R, R)]
    return press(*sides, tolerance=1e-12)


def facets_are_a_wall(checks):
    # joints lie beside the contact: on either side of it the same points meet the same line
    walls, facets = plates(False), plates(True)
    worst = max(abs(a - b) for a, b in zip(walls, facets)) / max(walls)
    checks.that("as many rows", len(walls) == len(facets))
    checks.that("the force of facets is that of walls", worst < 1e-8, worst)
    checks.that("energy is balanced", abs(balance()) < 2e-3, balance())


def slide(floor):
    """A grain slides without friction; its velocity, height and spin at the end."""
    start(velocity=(1, 0))
    O.bodies.append(floor())
    O.engines = softEngines(gravity=(0, -500, 0))
    state = O.bodies[0].state
    while state.pos[0] < 4.5 * R:
        O.step()
    return state.vel[0], state.pos[1] / R, state.angVel[2]


def joints_are_smooth(checks):
    # twelve facets in a line, and as many joints within them
    def line():
        return sum((strip([(i * 0.7 * R, -1.0001 * R), ((i + 1) * 0.7 * R, -1.0001 * R)]) for i in range(-3, 9)), [])

    on_wall, on_line = slide(lambda: [wall(-1.0001 * R, axis=1, material="stone")]), slide(line)
    checks.close_to("nothing stops it at the joints", on_line[0], on_wall[0], 1e-3)
    checks.close_to("height", on_line[1], on_wall[1], 0.05)


def a_large_sphere_is_a_wall(checks):
    expected = plates(False)
    start()
    big = 1e3 * R
    sides = [[O.bodies.append(sphere((0, sign * (R + big), 0), big, material="stone", fixed=True))] for sign in (-1, 1)]
    found = press(*sides)
    error = found[-1] / expected[-1] - 1
    checks.that("force within 1 % of that of walls", abs(error) < 0.01, error)
    checks.that("energy is balanced", abs(balance()) < 2e-3, balance())


def hertz_of_two_spheres(checks):
    # Johnson 1985, section 5.6: a cylinder of radius R between two rigid ones of radius r. Each contact comes nearer by what
    # the elastic half of it gives, and by the geometry of a^2 = 4 F R' / pi E', 1 / R' = 1 / R + 1 / r.
    material = NeoHookeanMat()
    modulus = 4 * material.mu * (material.lambda_ + material.mu) / (material.lambda_ + 2 * material.mu)
    for r in (0.4 * R, 1 * R, 4 * R):
        start(points=1200)
        sides = [[O.bodies.append(sphere((0, sign * (R + r), 0), r, material="stone", fixed=True))] for sign in (-1, 1)]
        force = press(*sides, squeeze=0.08, speed=0.2)[-1]
        half_width = math.sqrt(4 * force / (math.pi * modulus * (1 / R + 1 / r)))
        approach = force / (math.pi * modulus) * (2 * math.log(4 * R / half_width) - 1)
        curved = (half_width / min(r, R))**2    # what the theory of parabolas leaves out
        checks.that(f"approach of a sphere of {r / R:g} R", abs(approach / (0.08 * R) - 1) < 0.02 + curved,
                    (approach / (0.08 * R), curved))
        checks.that("penetration", measures.softIntegrator().maxPenetration() < 1e-3,
                    measures.softIntegrator().maxPenetration())
        checks.that("energy is balanced", abs(balance()) < 3e-3, balance())


def a_driven_sphere_drags_by_friction(checks):
    # a sphere that turns on a grain held from below gives it mu F along x
    grain = start(friction=0.4, points=276)
    O.bodies.append(wall(-R, axis=1, material="stone"))
    ball = O.bodies.append(sphere((0, 1.95 * R, 0), R, material="stone", fixed=True))
    O.bodies[ball].state.angVel = Vector3(0, 0, 20000)
    O.bodies[ball].state.pos = Vector3(0, 2 * R, 0)
    O.bodies[ball].state.vel = Vector3(0, -1, 0)
    O.bodies[grain].state.blockedDOFs = "xZ"
    O.engines = softEngines()
    while O.bodies[ball].state.pos[1] > 1.9 * R:
        O.step()
    force = O.forces.f(ball)
    checks.that("slides: the force along x is mu times that along y", abs(abs(force[0] / force[1]) - 0.4) < 0.02,
                force[0] / force[1])
    torque = O.forces.t(ball)[2]
    checks.that("its torque is force times radius", abs(abs(torque) / (R * abs(force[0])) - 1) < 0.02,
                torque / (R * force[0]))


def a_grain_rests_between_pegs(checks):
    # pegs fixed as a clump carry a grain of weight W; the reactions are W / 2 cos(30 degrees) each
    grain = start(points=276)
    pegs = [sphere((sign * 0.75 * R, -math.sqrt(1.5**2 - 0.75**2) * R, 0), 0.5 * R, material="stone") for sign in (-1, 1)]
    clump, members = O.bodies.appendClumped(pegs)
    O.bodies[clump].state.blockedDOFs = "xyzXYZ"
    O.engines = softEngines(gravity=(0, -300, 0))
    state = O.bodies[grain].state
    sums, steps = {member: Vector3.Zero for member in members}, 0
    while O.time < 0.02:
        O.step()
        if O.time > 0.005:
            steps += 1
            for member in members:
                sums[member] += O.forces.f(member)
    weight = state.mass * 300 * steps
    checks.close_to("the pegs carry the weight", -sum(force[1] for force in sums.values()) / weight, 1, 0.02)
    for force in sums.values():
        checks.close_to("at 30 degrees", abs(force[0] / force[1]), math.tan(math.radians(30)), 0.02)


def a_sphere_out_of_the_plane_is_not_touched(checks):
    start()
    ball = O.bodies.append(sphere((0, 0.5 * R, 1.5 * R), R, material="stone", fixed=True))
    O.bodies[ball].state.vel = Vector3(0, -1, 0)
    O.engines = softEngines()
    O.run(50, True)
    checks.that("no force", O.forces.f(ball).norm() == 0, O.forces.f(ball))


def implicit_meets_the_same_shapes(checks):
    forces = []
    for quasistatic in (False, True):
        start(points=276)
        sides = [O.bodies.append([sphere((x * R, -1.6 * R, 0), R, material="stone", fixed=True) for x in (-1.2, 1.2)]),
                 O.bodies.append(strip([(-3 * R, 1.001 * R), (3 * R, 1.001 * R)]))]
        how = {"integrator": "implicit", "quasistatic": True, "dt": 2e-5} if quasistatic else {}
        forces.append(press(*sides, squeeze=0.1, speed=0.1, **how)[-1])
    checks.close_to("quasi-static force over the explicit one", forces[1] / forces[0], 1, 0.02)


run_tests(facets_are_a_wall, joints_are_smooth, a_large_sphere_is_a_wall, hertz_of_two_spheres,
          a_driven_sphere_drags_by_friction, a_grain_rests_between_pegs, a_sphere_out_of_the_plane_is_not_touched,
          implicit_meets_the_same_shapes)
