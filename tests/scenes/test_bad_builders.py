# SPDX-License-Identifier: GPL-2.0-or-later
"""Bad input to the builders: one sentence that names object, value and fix, never a crash. (Scenes: test_bad_scenes.py.)"""
import math
import os
import sys

from yade import O
from yade.wrapper import ElastMat, FrictMat, Ig2_Sphere_Sphere_ScGeom, PyRunner

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import run_tests  # noqa: E402
from softgrain import (InputError, NeoHookeanMat, arrays, measures, rigidDisc, softBox, softCloud, softDisc,  # noqa: E402
                       softEngines, softPolygon)

NAN = math.nan
SQUARE = [(0, 0), (1, 0), (1, 1), (0, 1)]


def fresh_scene():
    O.reset()
    O.materials.append(ElastMat(label="spring"))
    O.materials.append(FrictMat(label="stone"))
    O.materials.append(NeoHookeanMat())


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
    ("too many points", lambda: softDisc((0, 0), 1e-3, points=10**6), ["points", "1000000", "100000"]),
    ("velocity out of the plane", lambda: softDisc((0, 0), 1e-3, velocity=(0, 0, 1)), ["velocity", "z", "1"]),
    ("colour without numbers", lambda: softDisc((0, 0), 1e-3, color="red"), ["color", "red", "three"]),
    ("colour of two numbers", lambda: softDisc((0, 0), 1e-3, color=(1, 0)), ["color", "three"]),
    ("unknown attribute", lambda: softDisc((0, 0), 1e-3, nodeTreshold=0.1), ["nodeTreshold", "SoftGrain"]),
    ("attribute of another type", lambda: softDisc((0, 0), 1e-3, nodeThreshold="x"), ["softDisc", "nodeThreshold", "'x'", "number"]),
    ("surface spacing NaN", lambda: softDisc((0, 0), 1e-3, surfaceSpacing=NAN), ["softDisc", "surfaceSpacing", "nan"]),
    ("grid offset NaN", lambda: softDisc((0, 0), 1e-3, gridOffset=(NAN, 0)), ["softDisc", "gridOffset", "finite"]),
    ("node threshold out of range", lambda: softDisc((0, 0), 1e-3, nodeThreshold=2), ["nodeThreshold", "2"]),
    ("radius beyond any scene", lambda: softDisc((0, 0), 1e200), ["radius", "1e+200"]),
    ("velocity NaN", lambda: softDisc((0, 0), 1e-3, velocity=(0, NAN)), ["velocity", "nan"]),
    ("a material that is not soft", lambda: softDisc((0, 0), 1e-3, "stone"), ["FrictMat", "NeoHookeanMat"]),
    ("a label that is not there", lambda: softDisc((0, 0), 1e-3, "jelly"), ["jelly", "O.materials"]),
    ("a number that is not there", lambda: softDisc((0, 0), 1e-3, 7), ["7", "O.materials"]),
    ("two corners", lambda: softPolygon(SQUARE[:2]), ["softPolygon", "2", "three"]),
    ("no corners", lambda: softPolygon(None), ["softPolygon", "corners"]),
    ("corners on a line", lambda: softPolygon([(0, 0), (1, 1), (2, 2)]), ["softPolygon", "no area"]),
    ("crossing edges", lambda: softPolygon([(0, 0), (2, 0), (0, 1), (1.5, 2)]), ["softPolygon", "cross"]),
    ("a corner given twice", lambda: softPolygon([*SQUARE, (0, 1)]), ["softPolygon", "once"]),
    ("the first corner given again", lambda: softPolygon([*SQUARE, (0, 0)]), ["softPolygon", "once"]),
    ("a spike", lambda: softPolygon([(0, 0), (2, 0), (1, 0), (1, 1), (0, 1)]), ["softPolygon", "touch"]),
    ("a corner on another edge", lambda: softPolygon([(0, 0), (2, 0), (2, 2), (1, 0), (0, 2)]), ["softPolygon", "touch"]),
    ("corners out of one plane", lambda: softPolygon([(0, 0, 0), (1, 0, 1), (1, 1, 0)]), ["softPolygon", "z", "plane"]),
    ("a corner NaN", lambda: softPolygon([*SQUARE, (NAN, 2)]), ["vertex 4", "nan"]),
    ("a rigid disc without radius", lambda: rigidDisc((0, 0), 0), ["rigidDisc", "radius", "above zero"]),
    ("a rigid disc out of the plane", lambda: rigidDisc((0, 0), 1e-3, "stone", velocity=(0, 0, 1)), ["velocity", "z", "1"]),
    ("a rigid disc of a spring", lambda: rigidDisc((0, 0), 1e-3, "spring"), ["rigidDisc", "ElastMat", "FrictMat"]),
    ("a functor that is none", lambda: softEngines(functors=[FrictMat()]), ["functors", "FrictMat", "Ig2"]),
    ("functors without a list", lambda: softEngines(functors=Ig2_Sphere_Sphere_ScGeom()), ["functors", "list"]),
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
    ("more discs than memory", lambda: softCloud(1, 10**9), ["count", "1000000000", "at most"]),
    ("box NaN", lambda: softBox(NAN, 1), ["softBox", "width", "nan"]),
    ("box of a material without friction", lambda: softBox(1, 1, "spring"), ["softBox", "ElastMat", "FrictMat"]),
    ("box of a label that is not there", lambda: softBox(1, 1, "iron"), ["softBox", "iron", "O.materials"]),
    ("collider's margin NaN", lambda: softEngines(verletDist=NAN), ["verletDist", "nan"]),
    ("collider's margin below zero", lambda: softEngines(verletDist=-1), ["verletDist", "-1"]),
    ("one engine and no list", lambda: softEngines(more=PyRunner()), ["more", "PyRunner", "list"]),
    ("gravity out of the plane", lambda: softEngines(gravity=(0, 0, -9.81)), ["gravity", "z", "-9.81"]),
    ("arrays of a wall", lambda: arrays.points(softBox(1, 1, "stone")[0]), ["Wall", "softDisc"]),
    ("arrays of nothing", lambda: arrays.outline(None), ["None", "softDisc"]),
    ("time step zero", lambda: softEngines(dt=0), ["dt", "above zero"]),
    ("safety over 1", lambda: softEngines(safety=1.5), ["safety", "1.5"]),
    ("friction below zero", lambda: softEngines(friction=-0.1), ["friction", "-0.1"]),
    ("tolerance NaN", lambda: softEngines(tolerance=NAN), ["tolerance", "nan"]),
    ("gravity of one number", lambda: softEngines(gravity=9.81), ["gravity", "9.81"]),
    ("an integrator that is none", lambda: softEngines(integrator="leapfrog"), ["integrator", "leapfrog", "'implicit'"]),
    ("implicit steps without a length", lambda: softEngines(integrator="implicit"), ["implicit", "give dt"]),
    ("explicit steps without inertia", lambda: softEngines(quasistatic=True), ["quasistatic", "integrator='implicit'"]),
    ("theta out of range", lambda: softEngines(integrator="implicit", dt=1e-5, theta=0.3), ["theta", "0.3", "0.5 to 1"]),
]


def builders_say_what_is_wrong(checks):
    fresh_scene()
    for what, call, words in BUILDERS:
        checks.raises(what, InputError, words, call)


def a_scene_without_integrator_is_found(checks):
    fresh_scene()
    O.bodies.append(softDisc((0, 0), 1e-3, points=60))
    O.engines = softEngines()[:-1]
    checks.raises("no SoftIntegrator", InputError, ["SoftIntegrator", "softEngines"], measures.softIntegrator)


def sound_polygons_pass(checks):
    fresh_scene()
    checks.that("a dented one", softPolygon([(0, 0), (2, 0), (2, 2), (1, 0.5), (0, 2)], points=60))
    checks.that("a corner in the middle of a side", softPolygon([(0, 0), (1, 0), (2, 0), (2, 2), (0, 2)], points=60))
    turn = [i * math.pi / 500 for i in range(1000)]
    checks.that("a thousand corners", softPolygon([(math.cos(a), math.sin(a)) for a in turn], points=60))


run_tests(builders_say_what_is_wrong, a_scene_without_integrator_is_found, sound_polygons_pass)
