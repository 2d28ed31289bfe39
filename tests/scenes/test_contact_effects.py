# SPDX-License-Identifier: GPL-2.0-or-later
"""What a pair of materials may have besides Signorini's law: friction, restitution, adhesion."""
import math
import os
import sys

from yade import O
from yade.minieigenHP import Vector3
from yade.utils import wall
from yade.wrapper import FrictMat, InteractionLoop, MatchMaker

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import InputError, NeoHookeanMat, measures, rigidDisc, softDisc, softEngines, softPolygon  # noqa: E402

SIDE = 1e-3
PULL = (1e3, 1e-5)      # of adhesion: Pa, m


def start():
    """The ids of three materials: gel, rubber, and stone for rigid bodies."""
    O.reset()
    return [O.materials.append(material) for material in (
        NeoHookeanMat(lambda_=1e6, mu=1e6, frictionAngle=0.1, label="gel"),
        NeoHookeanMat(lambda_=1e6, mu=1e6, frictionAngle=0.1, label="rubber"), FrictMat(frictionAngle=0.1, label="stone"))]


def block(bottom=0.0, material="gel", **more):
    """A soft square that stands on the height `bottom`."""
    half = SIDE / 2
    return O.bodies.append(softPolygon([(-half, bottom), (half, bottom), (half, bottom + SIDE), (-half, bottom + SIDE)],
                                       material, points=64, **more))


def physics():
    """The Ip2 functors."""
    loop, = (engine for engine in O.engines if isinstance(engine, InteractionLoop))
    return [functor for functor in loop.physDispatcher.functors if "Soft" in type(functor).__name__]


def run_until(time):
    while O.time < time:
        O.step()


def friction_follows_the_pair_of_materials(checks):
    gel, rubber, stone = start()
    O.bodies.append(wall(0, axis=1, material="stone"))
    grains = block(0, "gel"), block(SIDE, "rubber")
    O.engines = softEngines(gravity=(0, -10, 0))
    for functor in physics():
        functor.frictAngle = MatchMaker(matches=((gel, rubber, 0.2), (gel, stone, 0.5)), algo="max")
    for _ in range(200):
        O.step()
    for pair, angle in (((0, grains[0]), 0.5), (grains, 0.2)):
        found = O.interactions[pair].phys.tangensOfFrictionAngle
        checks.close_to(f"friction of {pair}", found, math.tan(angle), 1e-15)


def pull_off(ramp=0.2, **more):
    """Pulls a block off a wall by its weight: the largest pull on the wall and the weight at which it comes off [N/m]."""
    start()
    O.bodies.append(wall(0, axis=1, material="stone"))
    grain = block()
    O.engines = softEngines(adhesion=PULL, **more)
    O.trackEnergy = True
    soft, mass = measures.softIntegrator(), O.bodies[grain].state.mass
    rate = 1.5 * PULL[0] * SIDE / mass / ramp
    most = 0.0
    while O.bodies[grain].state.pos[1] < SIDE / 2 + 2 * PULL[1]:
        soft.gravity = (0, rate * O.time, 0)
        O.step()
        most = max(most, O.forces.f(0)[1])
    return most, mass * rate * O.time


def a_block_comes_off_at_the_tension_times_its_side(checks):
    most, weight = pull_off()
    checks.close_to("largest pull", most / (PULL[0] * SIDE), 1, 2e-3)
    checks.close_to("weight as it comes off", weight / (PULL[0] * SIDE), 1, 0.03)
    soft = measures.softIntegrator()
    expected = PULL[0] * PULL[1] * SIDE
    checks.close_to("work of separation", soft.adhesionWork / expected, 1, 0.05)
    checks.close_to("energy", (measures.heldOrLost(soft) + soft.adhesionWork - soft.externalWork) / expected, 0, 0.02)
    tracked = sum(O.energy[name] for name in O.energy.keys() if name.startswith("soft"))
    checks.close_to("tracked energies", tracked / expected, 0, 0.02)


def pulls_are_forces_of_the_pair(checks):
    start()
    O.bodies.append(wall(0, axis=1, material="stone"))
    block()
    O.engines = softEngines(adhesion=PULL, gravity=(0, 0.5 * PULL[0] / (1000 * SIDE), 0))
    total = 0.0
    for step in range(4000):
        O.step()
        if step >= 2000:
            total += O.forces.f(0)[1] / 2000
    one, two, point, normal, force = measures.softIntegrator().contacts()[0]
    checks.close_to("the wall bears the weight", total / (PULL[0] * SIDE), 0.5, 0.02)
    checks.that("the normal goes from the wall to the block", (one, two) == (0, 1) and normal[1] == 1, (one, two, normal))
    checks.that("the block is pulled", force[1] < 0, force)
    checks.close_to("in the middle", point[0] / SIDE, 0, 0.05)
    checks.close_to("as the pair says", O.interactions[0, 1].phys.normalForce[1], force[1], 1e-15)


def a_stone_sticks_to_a_grain(checks):
    start()
    grain = O.bodies.append(softDisc((0, 0), 1e-3, "gel", points=276))
    stone = O.bodies.append(rigidDisc((1.61e-3, 0.2e-3), 0.6e-3, "stone", velocity=(-0.02, 0, 0), spin=5))
    O.engines = softEngines(adhesion=(1e5, 4e-5), tolerance=1e-6, wallFriction=0)
    soft, states = measures.softIntegrator(), [O.bodies[body].state for body in (grain, stone)]
    momentum, kinetic = states[1].mass * states[1].vel, lambda: (states[1].mass * states[1].vel.squaredNorm()
                                                               + states[1].inertia[2] * states[1].angVel[2]**2) / 2
    first = kinetic()
    run_until(3e-3)
    total = sum((state.mass * state.vel for state in states), Vector3.Zero)
    checks.that("momentum", (total - momentum).norm() < 1e-12 * momentum.norm(), (total, momentum))
    checks.that("they stick", soft.contactCount > 0 and (states[0].pos - states[1].pos).norm() < 1.605e-3,
                (soft.contactCount, (states[0].pos - states[1].pos).norm(), soft.adhesionWork))
    checks.close_to("without friction only feet beside the radii turn it", states[1].angVel[2], 5, 0.2)
    energy = (measures.heldOrLost(soft) + soft.adhesionWork + kinetic() - first) / -soft.adhesionWork
    checks.close_to("energy over the work of adhesion", energy, 0, 0.01)


def bounce(reversible, interrupt=None):
    """A block that flies at a wall, off it, and is drawn down again: the largest pull on the wall before and after that."""
    start()
    O.bodies.append(wall(0, axis=1, material="stone"))
    grain = block(2e-5, velocity=(0, -0.2, 0))
    O.engines = softEngines(adhesion=(10.0, 1e-5), reversible=reversible, dt=1e-7)
    most = [0.0, 0.0]
    for fall, gravity in enumerate((0, -3000)):
        measures.softIntegrator().gravity = (0, gravity, 0)
        low = False
        for _ in range(200000):
            O.step()
            most[fall] = max(most[fall], O.forces.f(0)[1])
            height, speed = O.bodies[grain].state.pos[1] - SIDE / 2, O.bodies[grain].state.vel[1]
            low |= height < 1e-6
            if low and speed > 0 and height > 4e-4 / (1 + 9 * fall):
                break
        if interrupt and fall == 0:
            O.save(interrupt)
            O.load(interrupt)
    return most, [O.bodies[grain].state.pos[1], O.bodies[grain].state.vel[1]]


def irreversible_adhesion_is_remembered(checks):
    (first, second), _ = bounce(True)
    checks.that("reversible adhesion pulls again", first > 0.9 * 10 * SIDE and second > 0.9 * 10 * SIDE, (first, second))
    (first, second), end = bounce(False)
    checks.that("irreversible adhesion pulls once", first > 0.9 * 10 * SIDE and second == 0, (first, second))
    with Folder() as folder:
        again, same = bounce(False, os.path.join(folder, "apart.yade"))
    checks.that("also after O.save and O.load", again == [first, second] and same == end, (again, same, end))


def held_points_survive_a_file(checks):
    def run(interrupt=None):
        start()
        O.bodies.append(wall(0, axis=1, material="stone"))
        grain = block()
        O.engines = softEngines(adhesion=PULL, reversible=False, dt=1e-7, gravity=(0, 1.2 * PULL[0] / (1000 * SIDE), 0))
        for step in range(3000):
            if interrupt and step == 100:
                held = O.interactions[0, grain].phys.held
                checks.that("points are held", len(held) > 3, held)
                O.save(interrupt)
                O.load(interrupt)
            O.step()
        return O.bodies[grain].state.pos[1], measures.softIntegrator().adhesionWork
    with Folder() as folder:
        through, broken = run(), run(os.path.join(folder, "held.yade"))
    checks.that("the same digits", through == broken, (through, broken))


def impact(restitution, friction=None):
    """A rigid disc flies into a heavy, soft block that lies on a wall; its velocity and spin just after the impact, the
    engine, and the kinetic energy of the fall [J/m]."""
    start()
    O.bodies.append(wall(0, axis=1, material="stone"))
    O.bodies.append(softPolygon([(-5e-3, 0), (5e-3, 0), (5e-3, 5e-3), (-5e-3, 5e-3)], "gel", points=400))
    stone = O.bodies.append(rigidDisc((0, 6.001e-3), 1e-3, "stone", velocity=(0.5, -1, 0)))
    state = O.bodies[stone].state
    state.mass, state.inertia = 1e-3 * state.mass, 1e-3 * state.inertia
    O.engines = softEngines(restitution=restitution, friction=friction, wallFriction=friction)
    soft = measures.softIntegrator()
    while state.vel[1] <= -1:
        O.step()
    return state.vel, state.angVel[2], soft, state.mass / 2


def a_light_stone_rebounds_by_newtons_law(checks):
    for e in (0.4, 1.0):
        velocity, spin, soft, kinetic = impact(e, friction=0.0)
        checks.close_to(f"e = {e}", velocity[1], e, 0.02)
        checks.close_to("no friction", velocity[0], 0.5, 1e-9)
        checks.that("no energy is made", soft.contactDissipation > -1e-12 * kinetic, soft.contactDissipation)
    velocity, spin, *_ = impact((0.4, 0.6), friction=10.0)
    # the slide at the lowest point of the disc turns around: v + w r = -0.6 * 0.5; with the inertia m r²/2, v is 1/3 of the way
    checks.close_to("the slide turns around", velocity[0] + spin * 1e-3, -0.6 * 0.5, 0.03)
    checks.close_to("by the impulse of friction", velocity[0], 0.5 - 1.6 * 0.5 / 3, 0.03)


def numbers_may_differ_from_pair_to_pair(checks):
    gel, rubber, stone = start()
    O.bodies.append(wall(0, axis=1, material="stone"))
    grains = block(0, "gel"), block(SIDE, "rubber")
    O.engines = softEngines(restitution=(MatchMaker(matches=((gel, rubber, 0.3),), algo="zero"), 0.1), gravity=(0, -10, 0),
                            adhesion=(MatchMaker(matches=((gel, stone, 5.0),), algo="zero"), 1e-5))
    for _ in range(200):
        O.step()
    low, high = O.interactions[0, grains[0]].phys, O.interactions[grains].phys
    checks.that("of the wall", (low.en, low.et, low.adhesion, low.adhesionRange) == (0, 0.1, 5, 1e-5), low.dict())
    checks.that("of the grains", (high.en, high.et, high.adhesion) == (0.3, 0.1, 0), high.dict())


BAD_NUMBERS = [
    ("restitution above one", dict(restitution=1.2), ["normal restitution", "1.2", "0 to 1"]),
    ("restitution below zero", dict(restitution=(0.5, -0.1)), ["tangential restitution", "-0.1"]),
    ("restitution of three numbers", dict(restitution=(1, 0, 0)), ["restitution", "3", "(normal, tangential)"]),
    ("restitution that is no number", dict(restitution="high"), ["restitution", "high", "number"]),
    ("adhesion without a range", dict(adhesion=5.0), ["adhesion", "5.0", "range"]),
    ("adhesion that pushes", dict(adhesion=(-5, 1e-5)), ["tension", "-5", "Pa"]),
    ("adhesion of no range", dict(adhesion=(5, 0)), ["range", "0", "m"]),
    ("adhesion in implicit steps", dict(adhesion=PULL, integrator="implicit", dt=1e-5), ["adhesion", "implicit", "explicit"]),
    ("restitution in implicit steps", dict(restitution=1, integrator="implicit", dt=1e-5), ["restitution", "implicit"]),
]

BAD_PAIRS = [
    ("en", 1.5, ["#0", "#1", "coefficient of restitution", "1.5", "en", "[0, 1]"]),
    ("et", -1.0, ["coefficient of restitution", "-1", "et"]),
    ("adhesion", -2.0, ["tension", "-2", "adhesion"]),
    ("adhesionRange", 0.0, ["range", "0", "adhesionRange"]),
]


def mistakes_get_one_sentence(checks):
    for what, arguments, words in BAD_NUMBERS:
        start()
        checks.raises(what, InputError, words, lambda: softEngines(**arguments))
    for attribute, value, words in BAD_PAIRS:
        start()
        O.bodies.append(wall(0, axis=1, material="stone"))
        block()
        O.engines = softEngines(adhesion=PULL)
        for functor in physics():
            setattr(functor, attribute, MatchMaker(algo="val", val=value))
        checks.raises(f"{attribute} = {value}", RuntimeError, words, lambda: O.step() or O.step())
    for name, attributes in (("adhesion", dict(adhesion=5.0, adhesionRange=1e-5)), ("restitution", dict(en=0.5))):
        start()
        O.bodies.append(wall(0, axis=1, material="stone"))
        block()
        O.engines = softEngines(integrator="implicit", dt=1e-5)
        for functor in physics():
            functor.updateAttrs({key: MatchMaker(algo="val", val=value) for key, value in attributes.items()})
        checks.raises(f"{name} of a functor in implicit steps", RuntimeError, ["#0", "#1", name, "SoftIntegrator"],
                      lambda: [O.step() for _ in range(5)])


run_tests(friction_follows_the_pair_of_materials, a_block_comes_off_at_the_tension_times_its_side,
          pulls_are_forces_of_the_pair, a_stone_sticks_to_a_grain, irreversible_adhesion_is_remembered, held_points_survive_a_file,
          a_light_stone_rebounds_by_newtons_law, numbers_may_differ_from_pair_to_pair, mistakes_get_one_sentence)
