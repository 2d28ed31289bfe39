# SPDX-License-Identifier: GPL-2.0-or-later
"""Bad input to the builders and to a scene: one sentence that names object, value and fix, never a crash."""
import math
import os
import sys

from yade import O
from yade.wrapper import (Bo1_Wall_Aabb, ForceResetter, FrictMat, InsertionSortCollider, InteractionLoop,
                          NewtonIntegrator)

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import is_sentence, run_tests  # noqa: E402
from softgrain import (InputError, MooneyRivlinMat, NeoHookeanMat, softCloud, softDisc, softEngines,  # noqa: E402
                       softPolygon)

NAN = math.nan
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def fresh_scene():
    O.reset()
    O.materials.append(NeoHookeanMat())
    O.materials.append(FrictMat(label="stone"))


# what, call, words that the sentence has to hold
BUILDERS = [
    ("radius below zero", lambda: softDisc((0, 0), -1e-3), ["softDisc", "radius", "-0.001"]),
    ("radius zero", lambda: softDisc((0, 0), 0), ["radius", "above zero"]),
    ("radius NaN", lambda: softDisc((0, 0), NAN), ["radius", "nan"]),
    ("radius infinite", lambda: softDisc((0, 0), math.inf), ["radius", "inf"]),
    ("radius no number", lambda: softDisc((0, 0), "wide"), ["radius", "wide", "number"]),
    ("centre NaN", lambda: softDisc((0, NAN), 1e-3), ["center", "nan"]),
    ("centre without coordinates", lambda: softDisc(3, 1e-3), ["center", "3", "coordinates"]),
    ("centre in 4D", lambda: softDisc((0, 0, 0, 0), 1e-3), ["center", "4"]),
    ("too few points", lambda: softDisc((0, 0), 1e-3, points=15), ["points", "15", "16"]),
    ("half a point", lambda: softDisc((0, 0), 1e-3, points=99.5), ["points", "99.5", "whole"]),
    ("angle NaN", lambda: softDisc((0, 0), 1e-3, angle=NAN), ["angle", "nan"]),
    ("velocity NaN", lambda: softDisc((0, 0), 1e-3, velocity=(0, NAN)), ["velocity", "nan"]),
    ("a material that is not soft", lambda: softDisc((0, 0), 1e-3, "stone"), ["FrictMat", "NeoHookeanMat"]),
    ("a label that is not there", lambda: softDisc((0, 0), 1e-3, "jelly"), ["jelly", "O.materials"]),
    ("a number that is not there", lambda: softDisc((0, 0), 1e-3, 7), ["7", "O.materials"]),
    ("two corners", lambda: softPolygon(SQUARE[:2]), ["softPolygon", "2", "three"]),
    ("no corners", lambda: softPolygon(None), ["softPolygon", "corners"]),
    ("corners on a line", lambda: softPolygon([(0, 0), (1, 1), (2, 2)]), ["softPolygon", "no area"]),
    ("crossing edges", lambda: softPolygon([(0, 0), (2, 0), (0, 1), (1.5, 2)]), ["softPolygon", "cross"]),
    ("a corner NaN", lambda: softPolygon([*SQUARE, (NAN, 2)]), ["vertex 4", "nan"]),
    ("width below zero", lambda: softCloud(-1, 10), ["width", "-1"]),
    ("no grains", lambda: softCloud(1, 0), ["count", "0"]),
    ("diameters reversed", lambda: softCloud(0.02, 10, (2e-3, 1e-3)), ["diameters", "0.002", "smaller one first"]),
    ("one diameter", lambda: softCloud(0.02, 10, 1e-3), ["diameters", "smallest"]),
    ("diameter NaN", lambda: softCloud(0.02, 10, (NAN, 1e-3)), ["diameter", "nan"]),
    ("box too small", lambda: softCloud(2e-3, 10, (1.4e-3, 2.4e-3), 0.6), ["too small", "0.002", "wider"]),
    ("solid fraction zero", lambda: softCloud(0.02, 10, solidFraction=0), ["solidFraction", "above zero"]),
    ("solid fraction out of reach", lambda: softCloud(0.02, 100, solidFraction=0.84), ["0.840", "out of reach", "0.8"]),
    ("solid fraction that a small box cannot hold", lambda: softCloud(4.5e-3, 5, solidFraction=0.78),
     ["5 discs", "0.780", "solid fraction"]),
    ("seed below zero", lambda: softCloud(0.02, 10, seed=-1), ["seed", "-1"]),
    ("time step zero", lambda: softEngines(dt=0), ["dt", "above zero"]),
    ("safety over 1", lambda: softEngines(safety=1.5), ["safety", "1.5"]),
    ("friction below zero", lambda: softEngines(friction=-0.1), ["friction", "-0.1"]),
    ("tolerance NaN", lambda: softEngines(tolerance=NAN), ["tolerance", "nan"]),
    ("gravity of one number", lambda: softEngines(gravity=9.81), ["gravity", "9.81"]),
]


def builders_say_what_is_wrong(checks):
    fresh_scene()
    for what, call, words in BUILDERS:
        checks.raises(what, InputError, words, call)


# what, function that fills a scene, words
def disc_of(material):
    def build():
        O.materials.append(material)
        O.bodies.append(softDisc((0, 0), 1e-3, points=60))
        O.engines = softEngines()
    return build


def without_integrator():
    O.bodies.append(softDisc((0, 0), 1e-3, 0, points=60))
    O.engines = [engine for engine in softEngines() if type(engine).__name__ != "SoftIntegrator"]


def without_functors():
    O.bodies.append(softDisc((0, 0), 1e-3, 0, points=60))
    engines = softEngines()
    O.engines = [ForceResetter(), engines[1], InteractionLoop([], [], []), *engines[3:]]


def without_bounds():
    O.bodies.append(softDisc((0, 0), 1e-3, 0, points=60))
    engines = softEngines()
    O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Wall_Aabb()]), *engines[2:]]


def overlapping():
    O.bodies.append([softDisc((0, 0), 1e-3, 0, points=60), softDisc((1.8e-3, 0), 1e-3, 0, points=60)])
    O.engines = softEngines()


def step_too_large():
    O.bodies.append(softDisc((0, 0), 1e-3, 0, points=60))
    O.engines = softEngines(dt=1e-3)


def gravity_out_of_plane():
    O.bodies.append(softDisc((0, 0), 1e-3, 0, points=60))
    O.engines = softEngines(gravity=(0, 0, -9.81))


SCENES = [
    ("shear modulus below zero", disc_of(NeoHookeanMat(mu=-1e6)), ["mu", "-1"]),
    ("shear modulus NaN", disc_of(NeoHookeanMat(mu=NAN)), ["mu", "nan"]),
    ("lambda that makes the energy unstable", disc_of(NeoHookeanMat(lambda_=-5e6, mu=1e6)), ["lambda", "-5"]),
    ("c NaN", disc_of(MooneyRivlinMat(c=NAN)), ["c", "nan"]),
    ("c1 + c2 below zero", disc_of(MooneyRivlinMat(c1=-1e6)), ["c1"]),
    ("density zero", disc_of(NeoHookeanMat(density=0)), ["density", "0"]),
    ("grains that overlap", overlapping, ["#0", "#1", "overlap", "m"]),
    ("no functors", without_functors, ["Ig2_SoftGrain_SoftGrain_SoftGeom"]),
    ("no bounds", without_bounds, ["Bo1_SoftGrain_Aabb"]),
    ("a time step over the stable limit", step_too_large, ["0.001", "stable"]),
    ("gravity out of the plane", gravity_out_of_plane, ["gravity", "xy-plane"]),
]


def scenes_say_what_is_wrong(checks):
    for what, build, words in SCENES:
        fresh_scene()
        try:
            build()
            for _ in range(3):
                O.step()
        except (RuntimeError, ValueError) as error:
            text = str(error)
            missing = [word for word in words if word not in text]
            checks.that(what, not missing and is_sentence(text), f"said: {text!r}, lacks {missing}")
        else:
            checks.that(what, False, "raised nothing")
    O.reset()


def a_scene_without_integrator_is_found(checks):
    from softgrain import measures

    fresh_scene()
    without_integrator()
    checks.raises("no SoftIntegrator", InputError, ["SoftIntegrator", "softEngines"], measures.softIntegrator)


run_tests(builders_say_what_is_wrong, scenes_say_what_is_wrong, a_scene_without_integrator_is_found)
