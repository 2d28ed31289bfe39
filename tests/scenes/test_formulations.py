# SPDX-License-Identifier: GPL-2.0-or-later
"""The updated-Lagrangian form beside the total-Lagrangian one: the same scene, read-outs, saving, examples."""
import os
import sys

import numpy
from yade import O
from yade.wrapper import FrictMat

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import Folder, run_example, run_tests, said  # noqa: E402
from softgrain import NeoHookeanMat, arrays, measures, softBox, softDisc, softEngines  # noqa: E402
from softgrain.checks import InputError  # noqa: E402
from softgrain.records import read_table  # noqa: E402

RADIUS, SPEED = 1e-3, 1.0


def column(*formulations, **engines):
    """Discs on top of each other between walls that fit, the upper one coming down; the wall's id."""
    O.reset()
    soft = O.materials.append(NeoHookeanMat(frictionAngle=0.2))
    rigid = O.materials.append(FrictMat(frictionAngle=0.2))
    for k, formulation in enumerate(formulations):
        O.bodies.append(softDisc((RADIUS, (2 * k + 1) * RADIUS), RADIUS, soft, 60, 0.3 * k, formulation=formulation))
    top = O.bodies.append(softBox(2 * RADIUS, 2 * RADIUS * len(formulations), rigid))[-1]
    O.bodies[top].state.vel = (0, -SPEED, 0)
    O.engines = softEngines(**{"dt": 1e-7, **engines})
    return top


def run(steps):
    for _ in range(steps):
        O.step()


def state(top):
    """What the read-outs say, as one array."""
    parts = [O.forces.f(top)[1] / 1e6]
    for body in measures.softBodies():
        parts += [arrays.points(body).ravel() / RADIUS, arrays.pointVelocities(body).ravel() / SPEED,
                  arrays.outline(body).ravel() / RADIUS, body.state.area() / RADIUS**2, body.state.minJ(),
                  body.state.elasticEnergy(), body.state.kineticEnergy(), body.state.pos[1] / RADIUS]
    return numpy.concatenate([numpy.atleast_1d(part) for part in parts])


def both_forms_agree(checks):
    found = {}
    for name, forms in (("total", ("total", "total")), ("updated", ("updated", "updated")), ("mixed", ("total", "updated"))):
        top = column(*forms)
        force, steps = 0.0, 1500
        for step in range(steps):
            O.step()
            if step >= steps - 500:
                force += O.forces.f(top)[1] / 500
        soft = measures.softIntegrator()
        missing = measures.heldOrLost(soft) / soft.externalWork - 1
        checks.that(f"{name}: energy balance", abs(missing) < 5e-3, missing)
        found[name] = [force, soft.elasticEnergy(), soft.solidArea(), O.bodies[0].state.pos[1]]
    for name in ("updated", "mixed"):
        for what, one, other, allowed in zip(("force", "elastic energy", "area", "place"), found[name], found["total"],
                                             (0.05, 0.05, 1e-3, 1e-2)):
            checks.that(f"{name}: {what} as in the total form", abs(one / other - 1) < allowed, (one, other))


def read_outs_have_their_shapes(checks):
    column("updated")
    run(400)
    body = measures.softBodies()[0]
    count = body.shape.pointCount()
    for what, values, shape in (("points", arrays.points(body), (count, 2)),
                                ("velocities", arrays.pointVelocities(body), (count, 2)),
                                ("F", arrays.deformationGradients(body), (count, 2, 2)),
                                ("stress", arrays.cauchyStresses(body), (count, 3, 3))):
        checks.that(f"{what}: shape", values.shape == shape, values.shape)
        checks.that(f"{what}: finite", bool(numpy.isfinite(values).all()))
    F = arrays.deformationGradients(body)
    checks.close_to("area from F", float((numpy.linalg.det(F) * arrays.pointVolumes(body)).sum()), body.state.area(), 1e-15)
    checks.that("squeezed", numpy.linalg.det(F).min() < 1 and body.state.elasticEnergy() > 0)


def saved_and_loaded_goes_on_the_same(checks):
    with Folder() as folder:
        top = column("updated", "total")
        run(600)
        path = os.path.join(folder, "scene.yade")
        O.save(path, quiet=True)
        run(200)
        expected = state(top)
        O.reset()
        O.load(path, quiet=True)
        run(200)
        found = state(top)
        checks.that("size", found.size == expected.size)
        checks.close_to("state", float(abs(found - expected).max()), 0.0, 1e-8)


def moved_and_held_by_hand(checks):
    column("updated")
    O.bodies[1].state.vel = O.bodies[4].state.vel = (0, 0, 0)
    run(5)
    body = measures.softBodies()[0]
    body.state.blockedDOFs = "y"
    body.state.vel = (0, 0.5, 0)
    before = body.state.pos[1]
    run(20)
    checks.close_to("held velocity", body.state.pos[1] - before, 20 * O.dt * 0.5, 1e-3 * 20 * O.dt * 0.5)


def bad_names_are_refused(checks):
    checks.raises("formulation", InputError, ["formulation", "eulerian", "updated"],
                  lambda: softDisc((0, 0), RADIUS, NeoHookeanMat(), formulation="eulerian"))


def examples_take_the_option(checks):
    with Folder() as folder:
        runs = {form: run_example(folder, "squeeze.py", "--quick", "--out", form, "--formulation", form)
                for form in ("total", "updated")}
        for form, process in runs.items():
            checks.that(f"squeeze, {form}", process.returncode == 0, said(process))
        one, other = (read_table(os.path.join(folder, form, "squeeze.csv")) for form in runs)
        force = "force_per_thickness_N_m"
        checks.that("the same force", abs(one[force][-5:].mean() / other[force][-5:].mean() - 1) < 0.03,
                    (one[force][-5:], other[force][-5:]))
        packing = run_example(folder, "compaction.py", "--grains", "12", "--points", "60", "--until", "0.8", "--seed", "3",
                              "--out", "packing", "--formulation", "updated")
        checks.that("compaction, updated", packing.returncode == 0, said(packing))


def implicit_steps(checks):
    """As explicit ones, quasi-static too, and resumed as if never stopped."""
    with Folder() as folder:
        for form in ("total", "updated"):
            process = run_example(folder, "squeeze.py", "--quick", "--quasistatic", "--out", form, "--formulation", form)
            checks.that(f"squeeze, quasi-static, {form}", process.returncode == 0, said(process))
        one, other = (read_table(os.path.join(folder, form, "squeeze.csv")) for form in ("total", "updated"))
        force = "force_per_thickness_N_m"
        error = abs(one[force][-10:] / other[force][-10:] - 1).max()
        checks.that("the same force within 3 %", error < 0.03, error)
        words = ["--grains", "12", "--points", "60", "--seed", "3", "--friction", "0.2", "--integrator", "implicit",
                 "--formulation", "updated"]
        for name, further in {"whole": ["--until", "0.86"], "parts": ["--until", "0.8"],
                              "theta": ["--until", "0.86", "--theta", "0.5", "--material", "mr"]}.items():
            process = run_example(folder, "compaction.py", "--out", name, *words, *further)
            checks.that(f"compaction, implicit, {name}", process.returncode == 0, said(process))
        process = run_example(folder, "compaction.py", "--out", "parts", "--resume", "--until", "0.86")
        checks.that("resumed", process.returncode == 0, said(process))
        whole, parts = (read_table(os.path.join(folder, name, "compaction.csv")) for name in ("whole", "parts"))
        checks.close_to("the same stress", float(abs(whole["stress_top_Pa"] - parts["stress_top_Pa"]).max()), 0.0,
                        1e-9 * whole["stress_top_Pa"].max())
    top = column("updated", "total", integrator="implicit", dt=2e-7)
    run(600)
    soft = measures.softIntegrator()
    missing = measures.heldOrLost(soft) / soft.externalWork - 1
    checks.that("mixed forms: energy balance", abs(missing) < 5e-3, missing)
    checks.that("mixed forms: pressed", O.forces.f(top)[1] > 0, O.forces.f(top))


run_tests(both_forms_agree, read_outs_have_their_shapes, saved_and_loaded_goes_on_the_same, moved_and_held_by_hand,
          bad_names_are_refused, examples_take_the_option, implicit_steps)
