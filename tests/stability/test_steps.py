# SPDX-License-Identifier: GPL-2.0-or-later
"""Time steps: shares of the explicit limit and over it, implicit ones of 1 to 1000 times that limit; steps that change in
mid-run, a scene that is saved and loaded in mid-run, a process that is killed; overlaps at the start."""
import os
import random
import re
import signal
import sys
import tempfile

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from stability import RADIUS, disc, drive, gel, plate, polygon, run_cases, square_box  # noqa: E402
from softgrain import arrays, measures, softCloud  # noqa: E402
from yade import O  # noqa: E402

SPEED = 1.0
SLOW = 0.035        # a thousandth of the speed of shear waves [m/s]


def squeezed():
    """A disc that plates squeeze."""
    disc(0, 0)
    plate(1, -RADIUS, 1, SPEED / 2)
    plate(1, RADIUS, -1, -SPEED / 2)


def share(safety):
    def work(run):
        squeezed()
        run.begin(1e-5, safety=safety)
        run.go(0.4 * RADIUS / SPEED)
    return work


def follows(run):
    """A disc squeezed to half its height and let go: at every step, the time step follows its vibrations."""
    disc(0, 0, velocity=(0, 0.1, 0))
    plates = [plate(1, -RADIUS, 1, 10.0), plate(1, RADIUS, -1, -10.0)]
    run.begin(1e-6)
    run.soft.checkInterval = 1
    run.go(0.5 * RADIUS / 10)
    for wall in plates:
        drive(wall, -10.0 * wall.shape.sense)
    run.go(40 * RADIUS / 35)


def over(run):
    """A fixed step over the limit is refused by a sentence, at the start or when the limit has fallen below it."""
    squeezed()
    refused = ""
    try:
        run.begin(1e-5, dt=3e-6)
        run.go(0.9 * RADIUS / SPEED)
    except RuntimeError as error:
        refused = str(error)
    run.require("refused by a sentence", "largest stable time step" in refused and refused.endswith("."), refused)


def flat_on_flat(run):
    """A square between plates that touch it from the first moment on."""
    polygon([(-RADIUS, -RADIUS), (RADIUS, -RADIUS), (RADIUS, RADIUS), (-RADIUS, RADIUS)])
    plate(1, -RADIUS, 1, SPEED / 2)
    plate(1, RADIUS, -1, -SPEED / 2)
    run.begin(1e-5)
    run.go(0.2 * RADIUS / SPEED)


def times_the_limit(factor):
    def work(run):
        squeezed()
        run.begin(factor * 2e-6)
        run.go(0.4 * RADIUS / SPEED)
    return work


def changed(run):
    """Six grains compacted; the largest step, or the share of the stable one, changes by ten and back on the way."""
    duration = six(run)
    for part, scale in enumerate((1, 0.1, 1, 0.3)):
        if run.implicit:
            run.step = scale * 1e-5
        else:
            next(engine for engine in O.engines if hasattr(engine, "safety")).safety = 0.8 * scale
        run.go(duration / 4)


def saved(run):
    """The same compaction, whole and with a break at its middle in which the scene is saved and loaded: the same end."""
    ends = []
    for broken in (False, True):
        O.reset()
        duration = six(run)
        run.go(duration / 2)
        if broken:
            with tempfile.TemporaryDirectory() as folder:
                path = os.path.join(folder, "scene.yade")
                O.save(path, quiet=True)
                O.reset()
                O.load(path, quiet=True)
            run.soft = measures.softIntegrator()
        run.go(duration / 2)
        ends.append(places())
    difference = abs(ends[1] - ends[0]).max()
    run.note = f"difference {difference:.1e} R"
    run.require("goes on the same", difference < 1e-9, difference)


def places():
    """Of all material points [R]."""
    return numpy.concatenate([arrays.points(body).ravel() for body in measures.softBodies()]) / RADIUS


def killed(run):
    """The same compaction, whole and by a process that is killed while it computes: another goes on from the scene that it saved
    last, and comes to the same end."""
    end = six(run) + O.time
    with tempfile.TemporaryDirectory() as folder:
        path, part = (os.path.join(folder, name) for name in ("scene.yade", "part.yade"))
        process = os.fork()
        if process == 0:
            for _ in range(4):
                for _ in range(50):
                    O.step()
                O.save(part, quiet=True)
                os.replace(part, path)
            signal.setitimer(signal.ITIMER_REAL, 1e-3)      # SIGALRM, which nothing handles, ends the process
            while True:
                O.step()
        os.waitpid(process, 0)
        run.go(end - O.time)
        whole = places()
        O.reset()
        O.load(path, quiet=True)
    run.require("saved before its end", O.iter > 200 and O.time < end, (O.iter, O.time))
    run.soft = measures.softIntegrator()
    run.go(end - O.time)
    difference = abs(places() - whole).max()
    run.note = f"difference {difference:.1e} R"
    run.require("goes on the same", difference < 1e-9, difference)


def six(run):
    """Six grains under a wall; the time to a solid fraction of 0.92 [s]."""
    width = 4e-3
    grains, height = softCloud(width, 6, (1.4e-3, 2.0e-3), 0.65, gel(), points=60, seed=2)
    O.bodies.append(grains)
    drive(square_box(0, width, 0, height)[-1], -SPEED)
    run.begin(1e-5)
    return height * (1 - 0.65 / 0.92) / SPEED


def overlapping(depth):
    """Two discs that overlap: slightly, they separate without a kick; more is refused."""
    def work(run):
        left, right = disc(-RADIUS, 0), disc((1 - depth) * RADIUS, 0)
        run.turnover = left.state.mass * SLOW**2 / 2
        refused = ""
        try:
            run.begin(2e-6)
            run.go(2e-4)
        except RuntimeError as error:
            refused = str(error)
        if depth > 1e-3:
            run.require("refused by a sentence", "overlap" in refused and refused.endswith("."), refused)
            return
        speed = max(abs(arrays.pointVelocities(body)).max() for body in (left, right))
        run.require("not refused", not refused, refused)
        run.require("no kick: slower than 1e-3 of shear waves", speed < SLOW, speed)
    return work


def displaced(amount, safety=0.8):
    """A grain whose nodes were moved at random in a saved scene [R]: it recovers. Where that turned points inside out, the run
    stops with a sentence, and goes on once the grain has been mended. All modes vibrate alike then, so that explicit steps have
    to resolve the stiffest."""
    def work(run):
        disc(0, 0)
        run.begin(1e-6, **({} if run.implicit else {"safety": safety}))
        generator = random.Random(1)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "scene.xml")
            O.save(path, quiet=True)
            with open(path, encoding="utf-8") as file:
                before, inside, after = re.split("(<nodeDisplacement.*</nodeDisplacement>)", file.read(), flags=re.DOTALL)
            with open(path, "w", encoding="utf-8") as file:
                file.write(before + re.sub(r"<item>.*?</item>", lambda _: f"<item>{generator.uniform(-amount, amount)}</item>", inside)
                           + after)
            O.load(path, quiet=True)
            J = O.bodies[0].state.minJ()
            run.note = f"least J at the start {J:.2f}"
            if J <= 0:
                refused = ""
                try:
                    O.step()
                except RuntimeError as error:
                    refused = str(error)
                run.require("refused by a sentence", "untangle()" in refused and refused.endswith("."), refused)
                O.load(path, quiet=True)
                O.bodies[0].state.untangle(0.7)
        run.soft = measures.softIntegrator()
        state = O.bodies[0].state
        run.require("deformed", state.minJ() < 0.8, state.minJ())
        run.start, run.missing, run.turnover = run.stored(), 0.0, run.stored()
        place = state.pos
        run.go(3e-4)
        run.require("recovers", run.soft.minJ() > 0.5, run.soft.minJ())
        run.require("stays where it is", (state.pos - place).norm() < 1e-6 * RADIUS, state.pos)
    return work


EXPLICIT, IMPLICIT = ("explicit", "updated"), ("implicit", "quasistatic")
run_cases(*[(f"{safety} of the stable step", EXPLICIT, share(safety)) for safety in (0.5, 0.7, 0.95)],
          ("step follows vibrations", EXPLICIT, follows),
          ("1.5 times the stable step", EXPLICIT, over),
          *[(f"{factor} times the explicit step", IMPLICIT, times_the_limit(factor)) for factor in (1, 10, 100, 1000)],
          ("square that touches plates at the start", EXPLICIT + IMPLICIT, flat_on_flat),
          ("step changed in mid-run", EXPLICIT + IMPLICIT, changed),
          ("saved and loaded in mid-run", EXPLICIT + IMPLICIT, saved),
          ("killed in mid-run", EXPLICIT, killed),
          ("nodes displaced by 0.2 R", ("explicit", *IMPLICIT), displaced(0.2)),
          ("shorter steps, nodes displaced by 0.2 R", ("explicit",), displaced(0.2, 0.1)),
          *[(f"nodes displaced by {amount} R, mended", ("explicit", *IMPLICIT), displaced(amount, 0.1)) for amount in (1, 10)],
          *[(f"overlap of {depth:g} R at the start", EXPLICIT + IMPLICIT, overlapping(depth)) for depth in (5e-4, 0.05, 0.5)],
          known=[("nodes displaced by 0.2 R", "explicit", "all modes vibrate alike, the stiffest too; shorter steps resolve them")])
