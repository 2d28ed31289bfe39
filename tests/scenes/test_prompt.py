# SPDX-License-Identifier: GPL-2.0-or-later
"""What a person sees at YADE's prompt: help of every class, attribute and function, completion of names, a repr that tells
what an object is, and a sentence where a name or a value cannot be."""
import inspect
import os
import re
import rlcompleter
import sys

import yade.wrapper as wrapper
from yade import O

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
import softgrain  # noqa: E402
from scene_testing import run_tests  # noqa: E402
from softgrain import (NeoHookeanMat, SoftBoxController, SoftGrain, SoftIntegrator, SoftState, SoftTimeStepper,  # noqa: E402
                       _softgrain, prompt, softDisc, softEngines)

CLASSES = [getattr(wrapper, name) for name in _softgrain.classes]
NUMBERS = ("Real", "int", "long", "vector<Real>", "Vector2r", "Vector3r", "vector<Vector3r>")
IDS = {"held", "parted", "walls", "wall"}       # attributes that number bodies or points
MODULES = [softgrain, softgrain.arrays, softgrain.fclib, softgrain.measures, softgrain.stresses]


def own_members(kind):
    return {name: member for name, member in vars(kind).items() if not name.startswith("_")}


def everything_has_a_docstring_with_its_unit(checks):
    for kind in CLASSES:
        checks.that(f"{kind.__name__} says what it is", len(kind.__doc__ or "") > 40, kind.__doc__)
        for name, member in own_members(kind).items():
            static = re.search(rf"ystaticattr:: {kind.__name__}\.{name}\(.*?\)\n\n\t(.*?)\n\n", kind.__doc__ or "", re.DOTALL)
            doc = static[1] if static else member.__doc__ or ""
            text = re.sub(r":y\w+:`[^`]*`", "", doc).partition(" :\n")[2 if callable(member) else 0].strip()
            checks.that(f"{kind.__name__}.{name} says what it is", len(text) > 5 and text.endswith("."), text)
            number = "".join(prompt.KIND.findall(member.__doc__ or "")) in NUMBERS or "-> float" in (member.__doc__ or "")
            unit = re.search(r"\[[^]]+\]", text)
            checks.that(f"{kind.__name__}.{name} says its unit", unit or not number or name in IDS, text)


def functions_have_docstrings(checks):
    for module in MODULES:
        checks.that(f"{module.__name__} says what it is", module.__doc__)
        for name, found in vars(module).items():
            if inspect.isfunction(found) and not name.startswith("_"):
                checks.that(f"{module.__name__}.{name} has a docstring", len(found.__doc__ or "") > 20, found.__doc__)


def names_complete(checks):
    completer = rlcompleter.Completer({"gel": NeoHookeanMat(), "softgrain": softgrain})
    for begun, whole in [("gel.lam", "gel.lambda_"), ("gel.fricti", "gel.frictionAngle"), ("softgrain.softD", "softgrain.softDisc"),
                         ("softgrain.Mooney", "softgrain.MooneyRivlinMat")]:
        checks.that(f"{begun} becomes {whole}", (completer.complete(begun, 0) or "").startswith(whole), completer.complete(begun, 0))


def reprs_tell_what_an_object_is(checks):
    for kind in CLASSES:
        made = kind()
        text = repr(made)
        checks.that(f"repr of {kind.__name__}", re.fullmatch(rf"<{kind.__name__} .*at 0x[0-9a-f]+>", text), text)
        checks.that(f"str of {kind.__name__}", str(made) == text, str(made))
    text = repr(NeoHookeanMat(label="gel", lambda_=61e6, mu=1.26e6))
    checks.that("label, constants and units", text.startswith('<NeoHookeanMat "gel" lambda_=6.1e+07 Pa mu=1.26e+06 Pa '), text)
    text = repr(SoftBoxController(goal=(1e3, 0.1)))
    checks.that("what is not given is left out", "goal=(1000, 0.1)" in text and "maxStrainRate" not in text, text)
    body = softDisc((1e-3, 2e-3), 1e-3, NeoHookeanMat(), points=60)
    checks.that("a grain", "radius=0.001 m points=60" in repr(body.shape), repr(body.shape))
    checks.that("its state", "pos=(0.001, 0.002, 0) m" in repr(body.state), repr(body.state))


class Rubber(NeoHookeanMat):
    """A scene's own class."""


def refuse_what_cannot_be(checks):
    gel, state = NeoHookeanMat(label="gel"), SoftState()
    for what, kind, words, work in [
            ("a misspelt attribute", AttributeError, ['NeoHookeanMat "gel"', "yongModulus", "3", "young"],
             lambda: setattr(gel, "yongModulus", 3)),
            ("a name like no other", AttributeError, ["zzz", "help(NeoHookeanMat)"], lambda: setattr(gel, "zzz", 3)),
            ("a misspelt keyword", AttributeError, ["SoftGrain", "nodeTreshold", "0.1", "nodeThreshold"],
             lambda: SoftGrain(nodeTreshold=0.1)),
            ("an attribute to be read only", AttributeError, ["SoftIntegrator", "iterations", "3", "read only"],
             lambda: setattr(SoftIntegrator(), "iterations", 3)),
            ("a value of the wrong type", TypeError, ["gel", "mu", "'soft'", "a number"], lambda: setattr(gel, "mu", "soft")),
            ("one of several keywords of the wrong type", TypeError, ["SoftTimeStepper", "safety", "'high'", "a number"],
             lambda: SoftTimeStepper(dead=False, safety="high")),
            ("a vector of the wrong type", TypeError, ["SoftState", "vel", "3", "help(SoftState.vel)"],
             lambda: setattr(state, "vel", 3)),
            ("a method", AttributeError, ["elasticEnergy", "5"], lambda: setattr(state, "elasticEnergy", 5))]:
        checks.raises(what, kind, words, work)
    for kind in CLASSES:
        checks.raises(f"a misspelt attribute of {kind.__name__}", AttributeError, [kind.__name__, "nosuch"],
                      lambda kind=kind: setattr(kind(), "nosuch", 1))
    rubber = Rubber(mu=2e6)
    rubber.batch = 7
    checks.that("a class of the scene may have attributes of its own", rubber.batch == 7 and rubber.mu == 2e6)
    gel.mu, gel.frictionAngle = 1, 0.5
    checks.that("what is there can be set", (gel.mu, gel.frictionAngle) == (1, 0.5))


def objects_in_a_scene_too(checks):
    O.reset()
    O.bodies.append(softDisc((0, 0), 1e-3, NeoHookeanMat(), points=60))
    O.engines = softEngines()
    for what, object_ in [("material", O.bodies[0].mat), ("state", O.bodies[0].state), ("shape", O.bodies[0].shape),
                          ("engine", O.engines[-1])]:
        checks.raises(what, AttributeError, [type(object_).__name__, "nosuch"], lambda o=object_: setattr(o, "nosuch", 1))


run_tests(everything_has_a_docstring_with_its_unit, functions_have_docstrings, names_complete, reprs_tell_what_an_object_is,
          refuse_what_cannot_be, objects_in_a_scene_too)
