# SPDX-License-Identifier: GPL-2.0-or-later
"""Scenes that cannot be computed stop with one sentence that names object, value and fix: bad materials and states,
incomplete engine lists, time steps over the limit, overlaps. Never a crash, never silence."""
import math
import os
import sys

from yade import O
from yade.utils import box, facet, sphere, tetra, wall
from yade.wrapper import (Body, Bo1_Sphere_Aabb, Bo1_Tetra_Aabb, Bo1_Wall_Aabb, ElastMat, ForceResetter,
                          FrictMat, Ig2_Sphere_Sphere_ScGeom, InsertionSortCollider, InteractionLoop,
                          Ip2_FrictMat_FrictMat_FrictPhys, Law2_ScGeom_FrictPhys_CundallStrack, NewtonIntegrator,
                          Omega, State)
from yade.minieigenHP import Quaternion

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import is_sentence, run_tests  # noqa: E402
from softgrain import (Bo1_SoftGrain_Aabb, Ig2_Box_SoftGrain_SoftGeom, Ig2_SoftGrain_SoftGrain_SoftGeom,  # noqa: E402
                       Ig2_Wall_SoftGrain_SoftGeom, Ip2_FrictMat_SoftMat_SoftPhys, Ip2_SoftMat_SoftMat_SoftPhys,
                       Law2_SoftGeom_SoftPhys_ContactDynamics, MooneyRivlinMat, NeoHookeanMat, PlasticMat, SoftGrain,
                       SoftMat, SoftState, measures, softDisc, softEngines, softPolygon)

NAN, INFINITE = math.nan, math.inf
STEPS = 400
YADES_OWN_ENGINES = Omega().engines     # those a scene starts with


def fresh_scene():
    O.reset()
    O.materials.append(FrictMat(label="stone"))
    O.materials.append(NeoHookeanMat(label="gel"))


def disc(x=0.0, y=0.0, radius=1e-3, **more):
    return softDisc((x, y), radius, points=more.pop("points", 60), **more)


def complaint(build):
    """What stops the scene that `build` makes, as text, or None."""
    fresh_scene()
    try:
        build()
        for _ in range(STEPS):
            O.step()
    except (RuntimeError, ValueError) as error:
        return str(error)
    return None


def check_all(checks, cases):
    """Each case: what, function that makes a scene, words of the sentence."""
    for what, build, words in cases:
        text = complaint(build)
        missing = [word for word in words if word not in (text or "")]
        checks.that(what, text and not missing and is_sentence(text), f"said: {text!r}, lacks {missing}")
    O.reset()


# ------------------------------------------------------------------------------------------------- materials, states

def disc_of(material):
    def build():
        O.materials.append(material)
        O.bodies.append(disc())
        O.engines = softEngines()
    return build


MATERIALS = [
    ("shear modulus below zero", disc_of(NeoHookeanMat(mu=-1e6)), ["#0", "mu", "-1e+06"]),
    ("shear modulus zero", disc_of(NeoHookeanMat(mu=0)), ["mu", "0"]),
    ("shear modulus NaN", disc_of(NeoHookeanMat(mu=NAN)), ["mu", "nan"]),
    ("shear modulus infinite", disc_of(NeoHookeanMat(mu=INFINITE)), ["mu", "inf"]),
    ("lambda that makes the energy unstable", disc_of(NeoHookeanMat(lambda_=-5e6, mu=1e6)), ["lambda", "-5e+06"]),
    ("lambda NaN", disc_of(NeoHookeanMat(lambda_=NAN)), ["lambda", "nan"]),
    ("c1 below zero", disc_of(MooneyRivlinMat(c1=-1e6)), ["c1"]),
    ("c2 that makes the energy unstable", disc_of(MooneyRivlinMat(c2=-0.5e6)), ["c2"]),
    ("c below zero", disc_of(MooneyRivlinMat(c=-6e6)), ["c = -6e+06"]),
    ("c NaN", disc_of(MooneyRivlinMat(c=NAN)), ["c", "nan"]),
    ("density zero", disc_of(NeoHookeanMat(density=0)), ["density", "0"]),
    ("density NaN", disc_of(NeoHookeanMat(density=NAN)), ["density", "nan"]),
    ("friction angle below zero", disc_of(NeoHookeanMat(frictionAngle=-0.1)), ["frictionAngle", "-0.1"]),
    ("friction angle over a right angle", disc_of(NeoHookeanMat(frictionAngle=2)), ["frictionAngle", "2"]),
    ("viscosity below zero", disc_of(NeoHookeanMat(viscosity=-0.5)), ["#0", "viscosity", "-0.5"]),
    ("viscosity NaN", disc_of(NeoHookeanMat(viscosity=NAN)), ["#0", "viscosity", "nan"]),
    ("yield stress not given", disc_of(PlasticMat()), ["#0", "yieldStress", "nan"]),
    ("yield stress below zero", disc_of(PlasticMat(yieldStress=-1e4)), ["#0", "yieldStress", "-1"]),
    ("hardening below zero", disc_of(PlasticMat(yieldStress=1e4, hardening=-1e5)), ["#0", "hardening", "-1"]),
    ("the base of the materials", disc_of(SoftMat()), ["SoftMat", "NeoHookeanMat"]),
    ("a label helps to find it", disc_of(NeoHookeanMat(mu=-1, label="jelly")), ["jelly"]),
]


def by_hand(shape=None, material=None, state=None, **attributes):
    """A scene with one body that no builder has checked."""
    def build():
        body = Body()
        body.shape = shape or SoftGrain(radius=1e-3, points=60)
        body.material = material or O.materials["gel"]
        body.state = state or SoftState()
        body.state.mass, body.state.inertia, body.bounded = 1, (1, 1, 1), True
        for name, value in attributes.items():
            setattr(body.state, name, value)
        O.bodies.append(body)
        O.engines = softEngines(verletDist=5e-5)
    return build


STATES = [
    ("radius below zero", by_hand(SoftGrain(radius=-1)), ["radius", "-1"]),
    ("no radius", by_hand(SoftGrain()), ["radius", "nan"]),
    ("too few points", by_hand(SoftGrain(radius=1e-3, points=3)), ["points", "3", "16"]),
    ("two corners", by_hand(SoftGrain(vertices=[(0, 0, 0), (1, 0, 0)])), ["2", "3"]),
    ("a corner NaN", by_hand(SoftGrain(vertices=[(0, 0, 0), (1, 0, 0), (NAN, 1, 0)])), ["2", "finite"]),
    ("crossing edges", by_hand(SoftGrain(vertices=[(0, 0, 0), (2, 0, 0), (0, 1, 0), (1.5, 2, 0)])), ["cross"]),
    ("position NaN", by_hand(pos=(0, NAN, 0)), ["#0", "position", "finite"]),
    ("velocity NaN", by_hand(vel=(NAN, 0, 0)), ["#0", "velocity", "finite"]),
    ("velocity out of the plane", by_hand(vel=(0, 0, 1)), ["#0", "velocity", "plane"]),
    ("spin out of the plane", by_hand(angVel=(1, 0, 0)), ["#0", "spin", "plane"]),
    ("turned out of the plane", by_hand(ori=Quaternion((1, 0, 0), 0.5)), ["#0", "orientation", "z axis"]),
    ("a quaternion of length 5", by_hand(ori=Quaternion(3, 0, 0, 4)), ["#0", "orientation", "unit"]),
    ("orientation NaN", by_hand(ori=Quaternion(NAN, 0, 0, 1)), ["#0", "orientation"]),
    ("a material that is not soft", by_hand(material=FrictMat()), ["#0", "NeoHookeanMat"]),
    ("a state that is not soft", by_hand(state=State()), ["#0", "SoftState"]),
]


def materials_and_states(checks):
    check_all(checks, MATERIALS)
    check_all(checks, STATES)


# ------------------------------------------------------------------------------------------------------------ engines

def grains():
    """Two discs that meet each other and a wall below them."""
    O.bodies.append([disc(0, 0, velocity=(0, -3, 0)), disc(2.05e-3, 0, velocity=(-1, 0, 0)),
                     wall(-1.01e-3, axis=1, sense=1, material="stone")])


def without(*names):
    """The scene of grains() without the engines of these classes."""
    def build():
        grains()
        O.engines = [engine for engine in softEngines() if type(engine).__name__ not in names]
    return build


def with_dead(name):
    def build():
        grains()
        engines = softEngines()
        next(engine for engine in engines if type(engine).__name__ == name).dead = True
        O.engines = engines
    return build


def functors():
    return ([Ig2_SoftGrain_SoftGrain_SoftGeom(), Ig2_Wall_SoftGrain_SoftGeom(), Ig2_Box_SoftGrain_SoftGeom()],
            [Ip2_SoftMat_SoftMat_SoftPhys(), Ip2_FrictMat_SoftMat_SoftPhys()],
            [Law2_SoftGeom_SoftPhys_ContactDynamics()])


def loop_without(*names, more=(), bodies=grains):
    """The scene without the functors of these classes in its InteractionLoop, with more Ip2 functors."""
    def build():
        bodies()
        engines = softEngines()
        ig2, ip2, law2 = ([f for f in group if type(f).__name__ not in names] for group in functors())
        engines[3] = InteractionLoop(ig2, [*ip2, *(kind() for kind in more)], law2)
        O.engines = engines
    return build


def collider_of(*kinds, bodies=grains):
    """The scene with these Bo1 functors."""
    def build():
        bodies()
        engines = softEngines()
        engines[1] = InsertionSortCollider([kind() for kind in kinds], verletDist=5e-5)
        O.engines = engines
    return build


def on_a_box():
    O.bodies.append([disc(0, 0, velocity=(0, -3, 0)),
                     box((0, -1.11e-3, 0), (3e-3, 1e-4, 3e-3), fixed=True, material="stone")])


def engines_of_rigid_bodies():
    grains()
    O.dt = 1e-6
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()]),
                 InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_FrictPhys()],
                                 [Law2_ScGeom_FrictPhys_CundallStrack()]), NewtonIntegrator()]


def engines_of_yade_itself():
    grains()
    O.engines = YADES_OWN_ENGINES


def no_engines():
    grains()
    O.engines = []


def integrator_first():
    grains()
    engines = softEngines()
    O.engines = [engines[-1], *engines[:-1]]


def two_integrators():
    grains()
    O.engines = [*softEngines(), softEngines()[-1]]


def integrator_with(**attributes):
    def build():
        grains()
        O.engines = softEngines()
        O.step()
        for name, value in attributes.items():
            setattr(measures.softIntegrator(), name, value)
    return build


def stepper_with(safety):
    def build():
        grains()
        engines = softEngines()
        engines[2].safety = safety
        O.engines = engines
    return build


ENGINES = [
    ("no SoftIntegrator", without("SoftIntegrator"), ["SoftIntegrator", "softEngines()"]),
    ("a dead SoftIntegrator", with_dead("SoftIntegrator"), ["SoftIntegrator", "dead"]),
    ("no InteractionLoop", without("InteractionLoop"), ["InteractionLoop"]),
    ("a dead InteractionLoop", with_dead("InteractionLoop"), ["InteractionLoop", "dead"]),
    ("no collider", without("InsertionSortCollider"), ["InsertionSortCollider", "Bo1_SoftGrain_Aabb"]),
    ("no integrator, no loop", without("SoftIntegrator", "InteractionLoop"), ["SoftIntegrator"]),
    ("no integrator, loop, stepper", without("SoftIntegrator", "InteractionLoop", "SoftTimeStepper"), ["SoftIntegrator"]),
    ("the engines of rigid bodies", engines_of_rigid_bodies, ["SoftIntegrator"]),
    ("the engines that YADE starts with", engines_of_yade_itself, ["SoftIntegrator"]),
    ("no engines", no_engines, ["SoftIntegrator"]),
    ("SoftIntegrator first", integrator_first, ["SoftIntegrator", "InteractionLoop"]),
    ("two SoftIntegrators", two_integrators, ["2", "SoftIntegrators"]),
    ("no Ig2 of two grains", loop_without("Ig2_SoftGrain_SoftGrain_SoftGeom"), ["Ig2_SoftGrain_SoftGrain_SoftGeom"]),
    ("no Ig2 of walls", loop_without("Ig2_Wall_SoftGrain_SoftGeom"), ["Ig2_Wall_SoftGrain_SoftGeom"]),
    ("no Ig2 of boxes", loop_without("Ig2_Box_SoftGrain_SoftGeom", bodies=on_a_box), ["Ig2_Box_SoftGrain_SoftGeom"]),
    ("no Ip2 of two grains", loop_without("Ip2_SoftMat_SoftMat_SoftPhys"), ["Ip2_SoftMat_SoftMat_SoftPhys"]),
    ("no Ip2 of walls", loop_without("Ip2_FrictMat_SoftMat_SoftPhys"), ["Ip2_FrictMat_SoftMat_SoftPhys"]),
    ("a rigid Ip2 instead", loop_without("Ip2_FrictMat_SoftMat_SoftPhys", more=[Ip2_FrictMat_FrictMat_FrictPhys]),
     ["Ip2_FrictMat_SoftMat_SoftPhys"]),
    ("no Law2", loop_without("Law2_SoftGeom_SoftPhys_ContactDynamics"), ["Law2_SoftGeom_SoftPhys_ContactDynamics"]),
    ("no functors", loop_without(*(type(f).__name__ for group in functors() for f in group)), ["Ig2_SoftGrain"]),
    ("no Bo1 of grains", collider_of(Bo1_Wall_Aabb), ["#0", "Bo1_SoftGrain_Aabb"]),
    ("no Bo1 of walls", collider_of(Bo1_SoftGrain_Aabb), ["#2", "Bo1_Wall_Aabb"]),
    ("no Bo1 of boxes", collider_of(Bo1_SoftGrain_Aabb, bodies=on_a_box), ["#1", "Bo1_Box_Aabb"]),
    ("no sweeps", integrator_with(maxSweeps=0), ["maxSweeps", "0"]),
    ("tolerance NaN", integrator_with(tolerance=NAN), ["tolerance", "nan"]),
    ("tolerance below zero", integrator_with(tolerance=-1), ["tolerance", "-1"]),
    ("recovery over 1", integrator_with(recovery=5), ["recovery", "5"]),
    ("recovery NaN", integrator_with(recovery=NAN), ["recovery", "nan"]),
    ("check interval zero", integrator_with(checkInterval=0), ["checkInterval", "0"]),
    ("gravity out of the plane", integrator_with(gravity=(0, 0, -9.81)), ["gravity", "-9.81", "xy-plane"]),
    ("gravity NaN", integrator_with(gravity=(NAN, 0, 0)), ["gravity", "finite"]),
    ("safety over 1", stepper_with(1.2), ["safety", "1.2"]),
    ("safety NaN", stepper_with(NAN), ["safety", "nan"]),
]


def incomplete_engine_lists(checks):
    check_all(checks, ENGINES)


def a_second_attempt_is_refused_too(checks):
    fresh_scene()
    without("SoftIntegrator")()
    for attempt in range(3):
        checks.raises(f"attempt {attempt}", RuntimeError, ["SoftIntegrator"], O.step)
    O.engines = softEngines()
    for _ in range(10):
        O.step()
    checks.that("and the mended scene runs", O.iter == 10)


# --------------------------------------------------------------------------------------- other bodies, overlaps, steps

def beside(*others, grain=None, engines=softEngines):
    """A falling disc with other bodies, made when the scene is."""
    def build():
        O.bodies.append(grain() if grain else disc(velocity=(0, -3, 0)))
        for other in others:
            O.bodies.append(other())
        O.engines = engines()
    return build


def knowing(kind, bound):
    """Engines whose collider knows one more shape."""
    def make():
        engines = softEngines()
        engines[1] = InsertionSortCollider([Bo1_SoftGrain_Aabb(), bound()], verletDist=5e-5)
        return engines
    make.__name__ = kind
    return make


def unaware_of(shape):
    """Engines whose InteractionLoop knows one shape less."""
    def make():
        engines = softEngines()
        loop = next(engine for engine in engines if isinstance(engine, InteractionLoop))
        loop.geomDispatcher.functors = [functor for functor in loop.geomDispatcher.functors
                                        if type(functor).__name__ != f"Ig2_{shape}_SoftGrain_SoftGeom"]
        return engines
    return make


def a_facet():
    return facet(((-3e-3, -1.01e-3, -1e-3), (3e-3, -1.01e-3, -1e-3), (0, -1.01e-3, 5e-3)), material="stone")


def thrown(body):
    body.state.vel = (0, NAN, 0)
    return body


def wall_of(**material):
    def make():
        return wall(-1.01e-3, axis=1, sense=1, material=FrictMat(**material))
    return make


def wall_without_material():
    body = wall(-1.01e-3, axis=1, sense=1, material="stone")
    body.material = None
    return body


def box_with(orientation=Quaternion.Identity, low=-1.11e-3):
    return lambda: box((0, low, 0), (3e-3, 1e-4, 3e-3), orientation=orientation, fixed=True, material="stone")


def stone(z=0.0, y=-2.01e-3, **attributes):
    """A free sphere under the disc."""
    body = sphere((0, y, z), 1e-3, material="stone")
    for name, value in attributes.items():
        setattr(body.state, name, value)
    return body


def with_newton_last():
    return sorted(softEngines(), key=lambda engine: isinstance(engine, NewtonIntegrator))


def later(change):
    """A scene on a wall; after ten steps `change` is called with the wall."""
    def build():
        grains()
        O.engines = softEngines()
        for _ in range(10):
            O.step()
        change(O.bodies[2])
    return build


def sunk_in():
    """A wall put 0.2 radii into a grain: deeper than what is let pass, at a step in which that is looked at."""
    later(lambda body: setattr(body.state, "pos", (0, O.bodies[0].state.pos[1] - 0.8e-3, 0)))()
    measures.softIntegrator().checkInterval = 1


def clumped():
    O.bodies.appendClumped([disc(0), disc(3e-3)])
    O.engines = softEngines()


def periodic():
    O.periodic = True
    O.cell.setBox(0.01, 0.01, 0.01)
    grains()
    O.engines = softEngines()


BODIES = [
    ("a tetrahedron", beside(lambda: tetra(((-3e-3, -1.01e-3, -1e-3), (3e-3, -1.01e-3, -1e-3), (0, -1.01e-3, 5e-3),
                                            (0, -3e-3, 0)), material="stone"),
                             engines=knowing("tetra", Bo1_Tetra_Aabb)), ["#0", "#1", "Tetra"]),
    ("a sphere without its functor", beside(lambda: sphere((0, -2.01e-3, 0), 1e-3, material="stone", fixed=True),
                                            engines=unaware_of("Sphere")), ["Ig2_Sphere_SoftGrain_SoftGeom"]),
    ("a facet without its functor", beside(a_facet, engines=unaware_of("Facet")), ["Ig2_Facet_SoftGrain_SoftGeom"]),
    ("a sphere without bound", beside(lambda: sphere((0, -2.01e-3, 0), 1e-3, material="stone", fixed=True),
                                      engines=knowing("sphere", Bo1_Wall_Aabb)), ["#1", "Sphere", "Bo1_Sphere_Aabb"]),
    ("a free sphere and implicit steps", beside(stone, engines=lambda: softEngines(integrator="implicit", dt=1e-5)),
     ["#1", "Sphere", "blockedDOFs", "SoftIntegrator"]),
    ("a free sphere that NewtonIntegrator moves late", beside(stone, engines=with_newton_last),
     ["#1", "Sphere", "NewtonIntegrator"]),
    ("a free sphere without mass", beside(lambda: stone(mass=0)), ["#1", "Sphere", "mass", "0"]),
    ("a free sphere without inertia", beside(lambda: stone(inertia=(0, 0, 0))), ["#1", "Sphere", "inertia", "0"]),
    ("a free sphere off the plane", beside(lambda: stone(2e-4)), ["#1", "Sphere", "0.0002", "plane", "zXY"]),
    ("two free spheres that no functor knows", beside(stone, lambda: stone(y=-4.0e-3)), ["#1", "#2", "Sphere", "functors"]),
    ("a facet whose velocity turns NaN", beside(lambda: thrown(a_facet())), ["#1", "facet", "finite"]),
    ("a wall without friction angle", beside(wall_of(frictionAngle=NAN)), ["#0", "#1", "friction", "nan"]),
    ("a wall of negative friction angle", beside(wall_of(frictionAngle=-1)), ["#0", "#1", "friction", "-1"]),
    ("a wall of ElastMat", beside(lambda: wall(-1.01e-3, axis=1, sense=1, material=ElastMat())),
     ["#1", "ElastMat", "FrictMat"]),
    ("a wall without material", beside(wall_without_material), ["#1", "material", "FrictMat"]),
    ("a box turned out of the plane", beside(box_with(Quaternion((1, 0, 0), 0.3))), ["#1", "z axis"]),
    ("a wall whose velocity turns NaN", later(lambda body: setattr(body.state, "vel", (0, NAN, 0))), ["#2", "finite"]),
    ("a wall whose position turns NaN", later(lambda body: setattr(body.state, "pos", (0, NAN, 0))), ["#2", "finite"]),
    ("a clump of soft grains", clumped, ["#0", "clump"]),
    ("a periodic scene", periodic, ["periodic", "walls"]),
]


def overlapping(*bodies):
    def build():
        O.bodies.append([body() for body in bodies])
        O.engines = softEngines()
    return build


def added_later():
    grains()
    O.engines = softEngines()
    for _ in range(20):
        O.step()
    O.bodies.append(disc(0.5e-3, 0))


OVERLAPS = [
    ("two discs", overlapping(disc, lambda: disc(1.8e-3)), ["#0", "#1", "overlap", "0.0002", " m"]),
    ("two discs in one place", overlapping(disc, disc), ["#0", "#1", "overlap"]),
    ("a disc inside another", overlapping(lambda: disc(radius=3e-3), lambda: disc(0.5e-3, radius=0.5e-3)),
     ["#0", "#1", "overlap", "0.003"]),
    ("a polygon's corner in a disc", overlapping(disc, lambda: softPolygon([(9e-4, 0), (2e-3, -1e-3), (2e-3, 1e-3)])),
     ["#0", "#1", "overlap", "0.0001"]),
    ("a disc across a wall", beside(lambda: wall(-5e-4, axis=1, sense=1, material="stone")), ["#0", "#1", "overlap"]),
    ("a disc on the wrong side of a wall", beside(lambda: wall(-1.01e-3, axis=1, sense=-1, material="stone")),
     ["#0", "#1", "overlap"]),
    ("a disc across a thin box", beside(box_with(low=-7e-4)), ["#0", "#1", "overlap"]),
    ("a grain added in mid-run", added_later, ["#0", "#3", "overlap"]),
]


def with_step(dt, before=1e-6):
    def build():
        grains()
        O.engines = softEngines(dt=before)
        O.step()
        O.dt = dt
    return build


def flying(**disc_options):
    return beside(lambda: wall(-1.01e-3, axis=1, sense=1, material="stone"), grain=lambda: disc(**disc_options))


STEPPING = [
    ("a time step over the limit", with_step(1e-3), ["0.001", "largest stable", "SoftTimeStepper"]),
    ("a time step NaN", with_step(NAN), ["nan", "largest stable"]),
    ("a step over the limit from the start", with_step(1e-6, before=2.6e-6), ["2.6e-06", "largest stable"]),
    ("a grain as fast as a bullet", flying(velocity=(0, -50000, 0)), ["step 0", "#0", "m/s", "slow it down"]),
    ("a grain that spins too fast", flying(spin=1e8), ["step 0", "#0", "m/s"]),
    ("a wall that jumps into the grains", later(lambda body: setattr(body.state, "pos", (0, 0, 0))),
     ["step 10 ", "#0", "#2", "sunk into each other", "by hand"]),
    ("a grain that has sunk in", sunk_in, ["step 10 ", "#0", "#2", "sunk into each other by 0.", "radii", "by hand"]),
]


def other_bodies_overlaps_and_steps(checks):
    check_all(checks, BODIES)
    check_all(checks, OVERLAPS)
    check_all(checks, STEPPING)


def a_stepper_keeps_up_with_an_impact(checks):
    """An impact shortens the stable step between two looks of the stepper."""
    fresh_scene()
    O.bodies.append([disc(0), disc(2.01e-3, velocity=(-60, 0, 0))])
    O.engines = softEngines()
    for _ in range(200):
        O.step()
    checks.that("the run goes on", O.iter == 200)


run_tests(materials_and_states, incomplete_engine_lists, a_second_attempt_is_refused_too, other_bodies_overlaps_and_steps,
          a_stepper_keeps_up_with_an_impact)
