# SPDX-License-Identifier: GPL-2.0-or-later
"""Implicit and quasi-static runs of the examples inside the real yade: their checks, against explicit ones, resumed, with
friction, and what the engine refuses."""
import json
import os
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402
from softgrain import *  # noqa: E402
from softgrain.records import read_table  # noqa: E402
from yade import O  # noqa: E402
from yade.utils import box, facet, wall  # noqa: E402
from yade.wrapper import FrictMat  # noqa: E402

SMALL = ["--grains", "20", "--points", "60", "--until", "0.9", "--seed", "3"]


def squeeze(checks):
    """One force, whatever moves the grain. With friction, or it would roll, and points touch at other squeezes. Steps of an
    eighth of a per cent, so that rows are means over four of them, and ten times shorter."""
    implicit = ["--integrator", "implicit", "--speed", "0.02"]
    runs = {"quasistatic": ["--quasistatic", "--dt", "2.5e-5"], "in short steps": ["--quasistatic", "--dt", "2.5e-6"],
            "theta 1": implicit, "theta 0.5": [*implicit, "--theta", "0.5"]}
    with Folder() as folder:
        for material in ("nh", "mr"):
            tables = {}
            for name, words in {"explicit": ["--speed", "0.02"], **runs}.items():
                run = run_example(folder, "squeeze.py", "--out", material + name, "--material", material,
                                  "--friction", "0.3", *words)
                checks.that(f"squeeze of {material}, {name}", run.returncode == 0, said(run))
                tables[name] = read_table(os.path.join(folder, material + name, "squeeze.csv"))
            for name in runs:
                error = abs(force_of(tables[name]) / force_of(tables["explicit"]) - 1).max()
                checks.that(f"{material}, {name}: force within 0.2 % of the explicit one from 1 to 40 %", error < 2e-3, error)


def force_of(table):
    """At every row from 1 % on."""
    squeezes = numpy.arange(0.01, 0.4001, 0.005)
    return numpy.interp(squeezes, table["squeeze"], table["force_per_thickness_N_m"])


def compaction(checks):
    with Folder() as folder:
        for name, words in {"implicit": ["--integrator", "implicit"], "quasistatic": ["--quasistatic"],
                            "friction": ["--quasistatic", "--friction", "0.3", "--wall-friction", "0.2"],
                            "mr": ["--integrator", "implicit", "--material", "mr", "--theta", "0.8"],
                            "long": ["--integrator", "implicit", "--dt", "1e-3"]}.items():
            run = run_example(folder, "compaction.py", "--out", name, *SMALL, *words)
            checks.that(f"compaction, {name}", run.returncode == 0, said(run))
            table = read_table(os.path.join(folder, name, "compaction.csv"))
            checks.that(f"{name}: contact residual", table["solver_residual"].max() <= 1e-3,
                        table["solver_residual"].max())
            checks.that(f"{name}: penetration below 0.01 %", table["max_penetration_over_R"].max() < 1e-4)
            checks.that(f"{name}: bodies kept apart by less than 1e-4 R where they press on each other",
                        table["contact_distance_over_R"][-1] < 1e-4)
            if "quasistatic" in words or "--quasistatic" in words:
                top, bottom = table["stress_top_Pa"][-5:], table["stress_bottom_Pa"][-5:]
                if name == "quasistatic":
                    checks.that("in balance", numpy.allclose(top, bottom, rtol=0.01), (top, bottom))


def resumed(checks):
    """A run up to 0.8, then on to 0.9, is the run to 0.9."""
    words = ["--quasistatic", "--grains", "20", "--points", "60", "--seed", "4"]
    with Folder() as folder:
        run_example(folder, "compaction.py", "--out", "whole", "--until", "0.86", *words)
        run_example(folder, "compaction.py", "--out", "parts", "--until", "0.82", *words)
        run = run_example(folder, "compaction.py", "--out", "parts", "--resume", "--until", "0.86")
        checks.that("resumed", run.returncode == 0, said(run))
        whole, parts = (read_table(os.path.join(folder, name, "compaction.csv")) for name in ("whole", "parts"))
        error = abs(whole["stress_top_Pa"] - parts["stress_top_Pa"]).max() / whole["stress_top_Pa"].max()
        checks.that("the same", error < 1e-9, error)


def auto(checks):
    with Folder() as folder:
        for speed, expected in (("0.001", "implicit"), ("0.5", "explicit")):
            run = run_example(folder, "squeeze.py", "--integrator", "auto", "--speed", speed, "--squeeze", "0.02", "--points",
                              "60", "--out", expected)
            checks.that(f"auto at {speed} m/s", f"auto: {expected}" in run.stdout, said(run))
            with open(os.path.join(folder, expected, "summary.json"), encoding="utf-8") as file:
                chosen = json.load(file)["parameters"]["integrator"]
            checks.that("what it picked stands in the summary", chosen == expected, chosen)


def into_a_slit(speed, **engines):
    """Mean force on a wall that presses a disc of 40 points into a slit between facets, 0.28 to 0.3 R deep [N/m]."""
    R = 1e-3
    O.reset()
    soft = O.materials.append(NeoHookeanMat(lambda_=61e6, mu=1.26e6, density=1000))
    stone = O.materials.append(FrictMat(frictionAngle=0))
    O.bodies.append(softDisc((0, 0), R, soft, 40))
    for (x0, y0), (x1, y1) in (((-2, -0.97), (-0.3, -0.97)), ((0.35, -0.97), (2, -0.5))):
        a, b, c, d = [(x * R, y * R, z * R) for x, y, z in ((x0, y0, -2), (x1, y1, -2), (x1, y1, 3), (x0, y0, 3))]
        O.bodies.append([facet(corners, material=stone) for corners in ((a, b, c), (a, c, d))])
    for axis, at, sense in ((0, -1, 1), (0, 1.05, -1), (1, 1, -1)):
        O.bodies.append(wall(at * R, axis=axis, sense=sense, material=stone))
    top = O.bodies[-1]
    top.state.vel = (0, -speed, 0)
    O.engines = softEngines(**engines)
    forces = []
    while top.state.pos[1] > 0.7 * R:
        O.step()
        if top.state.pos[1] < 0.72 * R:
            forces.append(O.forces.f(top.id)[1])
    return numpy.mean(forces)


def slit(checks):
    """Ends of facets go into the grain where the explicit scheme has them."""
    expected = into_a_slit(0.02)
    for name, found in (("quasi-static", into_a_slit(0.1, dt=4e-6, integrator="implicit", quasistatic=True)),
                        ("implicit", into_a_slit(0.02, dt=2e-5, integrator="implicit"))):
        checks.that(f"facets, {name}", abs(found / expected - 1) < 5e-3, (found, expected))


def carried(checks):
    """Two boxes press on a disc, then go sideways together: where friction holds, the disc goes with them."""
    way = 0.1e-3
    for quasistatic in (True, False):
        O.reset()
        soft = O.materials.append(NeoHookeanMat(lambda_=61e6, mu=1.26e6, density=1000))
        stone = O.materials.append(FrictMat(frictionAngle=0))
        O.bodies.append(softDisc((0, 0), 1e-3, soft, 60))
        boxes = [box((0, side * 1.5e-3, 0), (3e-3, 0.5e-3, 1e-3), fixed=True, material=stone) for side in (-1, 1)]
        O.bodies.append(boxes)
        O.engines = softEngines(dt=1e-4, integrator="implicit", quasistatic=quasistatic, friction=1, wallFriction=1)
        for velocities in ((0, 0.05), (0, -0.05)), ((way / 2e-3, 0), (way / 2e-3, 0)):
            before = O.bodies[0].state.pos[0]
            for body, velocity in zip(boxes, velocities):
                body.state.vel = (*velocity, 0)
            O.run(20, True)
        went = (O.bodies[0].state.pos[0] - before) / way
        # on that way the points in touch slide by 1e-3 of it, and with inertia the disc swings on them
        checks.that(f"carried along, {'quasi-static' if quasistatic else 'implicit'}", abs(went - 1) < 5e-3, went)


def replaced(checks):
    """Engines that replace others go on with the contacts that are there: a squeezed disc keeps its force."""
    O.reset()
    soft = O.materials.append(NeoHookeanMat(lambda_=61e6, mu=1.26e6, density=1000))
    stone = O.materials.append(FrictMat(frictionAngle=0))
    O.bodies.append(softDisc((0, 0), 1e-3, soft, 60))
    O.bodies.append([wall(side * 1e-3, axis=1, sense=-side, material=stone) for side in (-1, 1)])
    quasistatic = {"dt": 1e-5, "integrator": "implicit", "quasistatic": True}
    O.engines = softEngines(**quasistatic)
    O.bodies[2].state.vel = (0, -1, 0)
    O.run(20, True)
    O.bodies[2].state.vel = (0, 0, 0)
    O.step()
    expected = O.forces.f(2)[1]
    for name, words in ("explicit", {}), ("implicit", {"dt": 1e-6, "integrator": "implicit"}), ("quasi-static", quasistatic):
        O.engines = softEngines(**words)
        O.run(3, True)
        found = O.forces.f(2)[1]
        checks.that(f"taken over by {name} steps", abs(found / expected - 1) < 0.01, (found, expected))


def refusals(checks):
    O.reset()
    soft = O.materials.append(NeoHookeanMat(lambda_=61e6, mu=1.26e6, density=1000))
    O.bodies.append(softDisc((0, 0), 1e-3, soft, 60))
    O.engines = softEngines(dt=1e-5, integrator="implicit")
    O.step()
    O.bodies[0].state.blockedDOFs = "x"
    for what, words in (("blocked degrees of freedom", ("#0", "blockedDOFs")), ("theta", ("theta", "0.3"))):
        try:
            O.step()
            checks.that(what, False, "no error")
        except RuntimeError as error:
            checks.that(what, all(word in str(error) for word in words), str(error))
        O.bodies[0].state.blockedDOFs = ""
        O.engines[-1].theta = 0.3


run_tests(squeeze, compaction, resumed, auto, slit, carried, replaced, refusals)
