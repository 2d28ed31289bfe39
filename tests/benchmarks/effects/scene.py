# SPDX-License-Identifier: GPL-2.0-or-later
"""Compactions of effects.py: yade -n -x tests/benchmarks/effects/scene.py CASE... Prints for each case the CPU time of its
steps, their number and that of the sweeps of the contact solver as JSON. Ends each with O.reset(), where counts are dumped."""
import json
import math
import sys
import time

from softgrain import *
from softgrain.builders import widthOfSquareCloud

GRAINS, POINTS, DIAMETERS, LOOSE, DENSE, SPEED, STEP = 24, 60, (1.4e-3, 2.4e-3), 0.65, 0.9, 4.0, 6e-7
MODULI = {"lambda_": 61e6, "mu": 1.26e6}


def zero():
    """Of a number of a contact, given for each pair of materials."""
    return MatchMaker(algo="val", val=0.0)


# What each case changes: the material, arguments of softEngines and of the grains, a guest among them.
CASES = {
    "bare": {},
    "friction, zero": {"engines": {"friction": 0.0, "wallFriction": 0.0}},
    "friction": {"engines": {"friction": 0.3, "wallFriction": 0.3}},
    "restitution, zero": {"engines": {"restitution": 0.0}},
    "restitution": {"engines": {"restitution": 0.5}},
    "adhesion, zero": {"engines": {"adhesion": (zero(), zero())}},
    "adhesion": {"engines": {"adhesion": (1e4, 2e-5)}},
    "gravity, zero": {"engines": {"gravity": (0, 0, 0)}},
    "gravity": {"engines": {"gravity": (0, -9.81, 0)}},
    "viscosity, zero": {"material": {"viscosity": 0.0}},
    "viscosity": {"material": {"viscosity": 0.05}},
    "plasticity, zero": {"law": PlasticMat, "material": {"yieldStress": 1e12}},
    "plasticity": {"law": PlasticMat, "material": {"yieldStress": 1e5}},
    "damping, zero": {"engines": {"damping": 0.0}},
    "damping": {"engines": {"damping": 0.2}},
    "rigid until touched, zero": {"engines": {"rigidBelow": 0.0}},
    "rigid until touched": {"engines": {"rigidBelow": 1e-2}},
    "law of Ogden, zero": {"law": OgdenMat, "material": {"mu": [MODULI["mu"]], "alpha": [2.0]}},
    "law of Ogden": {"law": OgdenMat, "material": {"mu": [MODULI["mu"] / 3], "alpha": [6.0]}},
    "updated form": {"shape": {"formulation": "updated"}},
    "adaptive step": {"engines": {"dt": None}},
    "self-contact, zero": {"guest": "square"},
    "self-contact": {"guest": "cross"},
    "free rigid body, zero": {"guest": "fixed"},
    "free rigid body": {"guest": "free"},
}


def guest(kind, place, size):
    """A body among the grains: a grain of convex or of concave outline, or a rigid disc, held or free."""
    if kind in ("fixed", "free"):
        body = rigidDisc(place, size, material="steel")
        if kind == "fixed":
            body.state.blockedDOFs = "xyzXYZ"
        return body
    arm = 1.0 if kind == "square" else 0.4
    corner = ((1, -1), (1, -arm), (1, arm)) if arm == 1.0 else ((arm, -1), (arm, -arm), (1, -arm), (1, arm))
    turned = dict.fromkeys(turn(point) for turn in (lambda p: p, lambda p: (-p[1], p[0]), lambda p: (-p[0], -p[1]),
                                                    lambda p: (p[1], -p[0])) for point in corner)
    return softPolygon([(place[0] + x * size, place[1] + y * size) for x, y in turned], "gel", points=POINTS)


def run(case):
    """CPU time [s], steps and sweeps."""
    law = case.get("law", NeoHookeanMat)
    moduli = {"lambda_": MODULI["lambda_"]} if law is OgdenMat else MODULI
    O.materials.append(law(**{**moduli, **case.get("material", {}), "label": "gel"}))
    O.materials.append(FrictMat(frictionAngle=0, density=1000, label="steel"))
    width = widthOfSquareCloud(GRAINS, DIAMETERS, LOOSE)
    grains, height = softCloud(width, GRAINS, DIAMETERS, LOOSE, "gel", POINTS, 1, **case.get("shape", {}))
    if "guest" in case:  # in place of the grain in the middle
        middle = min(grains, key=lambda body: math.hypot(body.state.pos[0] - width / 2, body.state.pos[1] - height / 2))
        grains.remove(middle)
        place = middle.state.pos[0], middle.state.pos[1]
        grains.append(guest(case["guest"], place, 0.6 * math.sqrt(middle.shape.area() / math.pi)))
    O.bodies.append(grains)
    top = O.bodies[O.bodies.append(softBox(width, height, "steel"))[3]]
    top.state.vel = (0, -SPEED, 0)
    O.engines = softEngines(**{"dt": STEP, **case.get("engines", {})})
    start = time.process_time()
    while top.state.pos[1] > height * LOOSE / DENSE:
        O.step()
    return {"cpu": time.process_time() - start, "steps": O.iter, "sweeps": measures.softIntegrator().totalIterations}


O.reset()
for name in sys.argv[1:]:
    print("RESULT " + json.dumps(run(CASES[name])), flush=True)
    O.reset()
