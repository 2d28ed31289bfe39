# SPDX-License-Identifier: GPL-2.0-or-later
"""Restitution and adhesion of rigid bodies among each other by Contact Dynamics, against closed forms."""
import math
import os
import sys

from yade import O
from yade.minieigenHP import Vector3
from yade.utils import wall
from yade.wrapper import FrictMat, MatchMaker

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_tests  # noqa: E402
from softgrain import measures, rigidContacts, rigidDisc, softEngines  # noqa: E402

R, G = 0.01, 9.81
DT = 1e-4
TENSION, RANGE = 1e3, 5e-4      # of adhesion


def start(friction=0.0):
    """Materials stone and steel; their ids."""
    O.reset()
    return [O.materials.append(FrictMat(density=2000, frictionAngle=math.atan(friction), label=label))
            for label in ("stone", "steel")]


def disc(x, y, material="stone", radius=R, **motion):
    return O.bodies[O.bodies.append(rigidDisc((x, y), radius, material, **motion))]


def floor():
    return O.bodies.append(wall(0, axis=1, sense=1, material="stone"))


def use(gravity=0.0, dt=DT, **effects):
    O.engines = softEngines(dt=dt, gravity=(0, -gravity, 0), functors=rigidContacts(), tolerance=1e-9, **effects)
    return measures.softIntegrator()


def apex(state):
    """Steps until it has come down, and turned down again after that; the height of its centre then."""
    while state.vel[1] <= 0:
        O.step()
    while state.vel[1] > 0:
        O.step()
    return state.pos[1]


def a_disc_bounces_to_e_squared(checks):
    for e in (0.5, 0.9, 1.0):
        start()
        floor()
        body = disc(0, R + 0.2)
        soft = use(gravity=G, restitution=e)
        O.step()
        first = apex(body.state) - R
        lost = soft.contactDissipation / (body.state.mass * G * 0.2)
        way = DT * math.sqrt(2 * G * 0.2)       # it turns around within a step
        checks.close_to(f"e = {e}: height", first / 0.2, e**2, 4 * way / 0.2)
        checks.close_to(f"e = {e}: energy lost", lost, 1 - e**2, 4 * way / 0.2)
        checks.close_to(f"e = {e}: second height", (apex(body.state) - R) / 0.2, e**4, 8 * way / 0.2)


def two_discs_meet_by_newtons_law(checks):
    for e in (0.0, 0.3, 1.0):
        for ratio in (1.0, 3.0):
            start()
            one, two = disc(0, 0, velocity=(1, 0, 0)), disc(2.05 * R, 0)
            two.state.mass *= ratio
            energy = one.state.mass / 2
            soft = use(restitution=e)
            for _ in range(20):
                O.step()
            centre = 1 / (1 + ratio)
            name = f"e = {e}, masses 1 and {ratio}"
            checks.close_to(f"{name}: the one that came", one.state.vel[0], centre - e * ratio * centre, 1e-9)
            checks.close_to(f"{name}: the one that is struck", two.state.vel[0], centre + e * centre, 1e-9)
            checks.close_to(f"{name}: energy lost", soft.contactDissipation / energy, (1 - e**2) * ratio * centre, 1e-9)


def a_cradle_passes_it_on(checks):
    """A row with gaps of more than a step's way: the last one flies off."""
    start()
    row = [disc(0, 0, velocity=(1, 0, 0))] + [disc(2.03 * R * (i + 1), 0) for i in range(4)]
    use(restitution=1)
    for _ in range(60):
        O.step()
    checks.that("the last one alone", all(abs(b.state.vel[0] - (b is row[-1])) < 1e-9 for b in row),
                [b.state.vel[0] for b in row])


def a_slide_turns_around(checks):
    """With et and friction enough the slide v + w R of a disc's lowest point becomes -et times that; v is a third of the way."""
    start(friction=10)
    floor()
    body = disc(0, 1.05 * R, velocity=(0.5, -1, 0))
    use(restitution=(0.4, 0.6))
    while body.state.vel[1] < 0:
        O.step()
    checks.close_to("upwards", body.state.vel[1], 0.4, 1e-9)
    checks.close_to("the slide", body.state.vel[0] + body.state.angVel[2] * R, -0.6 * 0.5, 1e-9)
    checks.close_to("along", body.state.vel[0], 0.5 - 1.6 * 0.5 / 3, 1e-9)


def rest_is_not_kicked(checks):
    """A bouncing disc comes to rest, and stays there though e = 0.9."""
    start()
    ground = floor()
    body = disc(0, 1.2 * R)
    use(gravity=G, restitution=0.5)
    for _ in range(6000):
        O.step()
    height = body.state.pos[1]
    checks.close_to("weight", -O.forces.f(ground)[1] / (G * body.state.mass), 1, 1e-6)
    for _ in range(100):
        O.step()
    checks.close_to("it stays", body.state.pos[1], height, 1e-9 * R)


def reduced(one, two=math.inf):
    return 1 / (1 / one + 1 / two)


def adhesion_holds_up_to_its_force(checks):
    """Arcs nearer than the range are sqrt(8 R' range) wide at touch; the tension times that is borne."""
    for name, radii in (("two discs", (R, 2 * R)), ("disc and wall", (R, math.inf))):
        for share in (0.98, 1.02):
            start()
            if math.isinf(radii[1]):
                floor()
                bodies = [disc(0, R)]
            else:
                bodies = [disc(0, radii[0] + radii[1]), disc(0, 0, radius=radii[1])]
                bodies[1].state.blockedDOFs = "xyzXYZ"
            soft = use(adhesion=(TENSION, RANGE))
            force = TENSION * math.sqrt(8 * reduced(*radii) * RANGE)
            O.forces.setPermF(bodies[0].id, (0, share * force, 0))
            start_height = bodies[0].state.pos[1]
            for _ in range(1500):
                O.step()
            rise = bodies[0].state.pos[1] - start_height
            checks.that(f"{name}: {share} of the force {'holds' if share < 1 else 'parts them'}",
                        (rise < 1e-9) == (share < 1) and (rise > RANGE) == (share > 1), rise)
            if share < 1:
                checks.that(f"{name}: it is a contact that pulls", len(soft.contacts()) == 1, soft.contacts())
                _, _, _, normal, force_on_two = soft.contacts()[0]
                checks.close_to(f"{name}: it bears the pull", abs(force_on_two[1]) / (share * force), 1, 1e-6)


def work_of_adhesion(checks):
    """A disc that flies off a wall loses tension * 2/3 sqrt(8 R) range^(3/2), and gains that when it comes back."""
    work = TENSION * 2 / 3 * math.sqrt(8 * R) * RANGE**1.5
    for reversible in (True, False):
        start()
        floor()
        body = disc(0, R)
        speed = math.sqrt(4 * work / body.state.mass)      # half of its energy is the work
        body.state.vel = (0, speed, 0)
        soft = use(adhesion=(TENSION, RANGE), reversible=reversible, dt=2e-6)
        while body.state.pos[1] < R + 1.5 * RANGE:
            O.step()
        # what a gap opens by in a step counts after it
        off = 3 * 2e-6 * speed / RANGE
        checks.close_to("energy after", (body.state.vel[1] / speed)**2, 0.5, off)
        checks.close_to("its work", soft.adhesionWork / work, 1, off)
        body.state.vel = (0, -1e-3, 0)
        while body.state.pos[1] > R + 0.9 * RANGE:
            O.step()
        drawn = body.state.vel[1] < -1.01e-3
        checks.that(f"{'reversible' if reversible else 'irreversible'}: drawn down again {reversible}", drawn == reversible,
                    body.state.vel[1])


def what_sticks_rebounds_too(checks):
    """A disc drawn to a fixed one strikes it faster, rebounds with e, and is slowed down by the same work; in any direction."""
    for angle in (0.0, 1.0, 2.5):
        start()
        way = Vector3(math.cos(angle), math.sin(angle), 0)
        far = 2 * R + 1.5 * RANGE
        fixed, body = disc(0, 0), disc(far * way[0], far * way[1])
        fixed.state.blockedDOFs = "xyzXYZ"
        e, gained = 0.8, 2 / body.state.mass * TENSION * 2 / 3 * math.sqrt(8 * reduced(R, R)) * RANGE**1.5
        speed = math.sqrt(4 * gained)
        body.state.vel = -speed * way
        use(adhesion=(TENSION, RANGE), restitution=e, dt=2e-6)
        for _ in range(40000):
            O.step()
            if body.state.vel.dot(way) > 0 and body.state.pos.dot(way) > far:
                break
        checks.close_to(f"speed after, towards {angle}", (body.state.vel.dot(way) / speed)**2, e**2 * 1.25 - 0.25,
                        6 * 2e-6 * speed / RANGE)


def friction_bears_under_tension(checks):
    """An upright load below mu times the adhesion does not move a disc that cannot turn along a wall."""
    for share in (0.9, 1.1):
        start(friction=0.5)
        O.bodies.append(wall(0, axis=0, sense=1, material="stone"))
        body = disc(R, 0)
        body.state.blockedDOFs = "zXYZ"
        use(adhesion=(TENSION, RANGE))
        O.forces.setPermF(body.id, (0, share * 0.5 * TENSION * math.sqrt(8 * R * RANGE), 0))
        for _ in range(200):
            O.step()
        checks.that(f"{share} of what friction bears", (abs(body.state.pos[1]) > 1e-6) == (share > 1), body.state.pos)


def energy_is_accounted_for(checks):
    """Many discs that stick, rub and rebound in a box that nobody works on."""
    start(0.3)
    O.bodies.append([wall(0, axis=0, sense=1, material="stone"), wall(12 * R, axis=0, sense=-1, material="stone"),
                     wall(0, axis=1, sense=1, material="stone"), wall(12 * R, axis=1, sense=-1, material="stone")])
    bodies = [disc((1.2 + 2.3 * i) * R, (1.2 + 2.3 * j) * R, velocity=(math.sin(5 * i + j), math.cos(3 * j - i), 0), spin=20 * (i - j))
              for i in range(5) for j in range(5)]

    def kinetic():
        return sum((b.state.mass * b.state.vel.squaredNorm() + b.state.inertia[2] * b.state.angVel[2]**2) / 2 for b in bodies)
    first = kinetic()
    soft = use(restitution=0.6, adhesion=(TENSION, RANGE))
    for _ in range(1000):
        O.step()
    lost = soft.contactDissipation + soft.frictionDissipation + soft.adhesionWork
    checks.close_to("balance", (kinetic() + lost) / first, 1, 1e-9)
    checks.that("adhesion has acted", abs(soft.adhesionWork) > 1e-4 * first, soft.adhesionWork / first)
    checks.that("no penetration", soft.maxPenetration() < 0.01, soft.maxPenetration())


def pairs_of_materials(checks):
    stone, steel = start()
    disc(0, 0), disc(2.01 * R, 0, "steel"), disc(0, 2.01 * R)
    use(restitution=MatchMaker(matches=((stone, steel, 0.7),), algo="zero"), adhesion=(MatchMaker(
        matches=((stone, stone, 5.0),), algo="zero"), 1e-4))
    O.step()
    mixed, same = O.interactions[0, 1].phys, O.interactions[0, 2].phys
    checks.that("stone and steel", (mixed.en, mixed.adhesion) == (0.7, 0), mixed.dict())
    checks.that("stone and stone", (same.en, same.adhesion, same.adhesionRange) == (0, 5, 1e-4), same.dict())


def saved(checks):
    """What irreversible adhesion has let go of is still so after O.save and O.load: the same digits."""
    def final(path=None):
        start()
        floor()
        body = disc(0, R, velocity=(0, 0.3, 0))
        use(adhesion=(TENSION, RANGE), reversible=False, restitution=0.5, gravity=G)
        for step in range(2000):
            if path and step == 100:
                O.save(path)
                O.load(path)
                body = O.bodies[1]
            O.step()
        return tuple(body.state.pos), tuple(body.state.vel)
    with Folder() as folder:
        whole, broken = final(), final(os.path.join(folder, "apart.yade"))
        checks.that("the same digits", whole == broken, (whole, broken))


def mistakes_get_one_sentence(checks):
    for name, value, words in (("en", 1.5, ["#0", "#1", "coefficient of restitution", "1.5", "en", "[0, 1]"]),
                               ("adhesion", -2.0, ["tension", "-2", "adhesion"]),
                               ("adhesionRange", 0.2 * R, ["#0", "#1", "range", "0.002", "0.001"])):
        start()
        disc(0, 0), disc(1.99 * R, 0)
        use(adhesion=(TENSION, RANGE))
        setattr(next(f for f in O.engines[2].physDispatcher.functors if type(f).__name__ == "Ip2_FrictMat_FrictMat_SoftPhys"), name,
                MatchMaker(algo="val", val=value))
        checks.raises(f"{name} = {value}", RuntimeError, words, lambda: O.step() or O.step())


def walls_are_seen_ahead(checks):
    """A fast disc does not enter a wall or a box, whichever side the wall faces."""
    start()
    O.bodies.append([wall(0, axis=1, sense=0, material="stone"), wall(20 * R, axis=1, sense=-1, material="stone")])
    low, high = disc(0, 3 * R, velocity=(0, -0.8, 0)), disc(5 * R, 17 * R, velocity=(0, 0.8, 0))
    soft = use(dt=1e-3)
    deepest = 0.0
    for _ in range(60):
        O.step()
        deepest = max(deepest, soft.maxPenetration())
    checks.that("they lie at the walls", max(low.state.vel.norm(), high.state.vel.norm()) < 1e-9,
                (low.state.vel, high.state.vel))
    checks.that("no penetration", deepest < 1e-9, deepest)


run_tests(a_disc_bounces_to_e_squared, two_discs_meet_by_newtons_law, a_cradle_passes_it_on, a_slide_turns_around, rest_is_not_kicked,
          adhesion_holds_up_to_its_force, work_of_adhesion, what_sticks_rebounds_too, friction_bears_under_tension, energy_is_accounted_for, pairs_of_materials,
          saved, mistakes_get_one_sentence, walls_are_seen_ahead)
