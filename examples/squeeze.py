# SPDX-License-Identifier: GPL-2.0-or-later
"""One soft disc squeezed between two rigid plates, or by four walls that close equally.

    yade -n -x examples/squeeze.py [options]          --help lists them

      ========== y = +R (1 - s)         squeeze  s = 1 - gap / (2 R), 0 at first touch
        .-----.                         force    F(s), mean over opposite plates, per metre of thickness
       (       )  R                     contact  half-width a(s), half-width b(s) of the disc
        '-----'
      ========== y = -R (1 - s)         --walls 4: the same on x, so that the disc fills a square

Plane strain; material laws as in compaction.py. With frictionless plates and the default materials F is compared with
finite-element results (mixed P2/P1, good to 3e-4). Lengths and forces scale with R.

Writes squeeze.csv (force: mean over a window; all other columns: the window's middle; cpu_s: its end; solid_fraction is
the grain's area over that between the walls, across as far as the grain reaches) and summary.json into --out.
"""
import math

import numpy
from softgrain import *
from softgrain import options as opt, runs, summary
from softgrain.checks import InputError
from softgrain.records import read_table
from softgrain.stepping import WallForces
from yade import O
from yade.utils import wall as yade_wall

COLUMNS = ("squeeze,force_per_thickness_N_m,contact_half_width_m,area_ratio,half_width_m,solid_fraction,min_J,"
           "cpu_s").split(",")
OUTPUT = 0.005                  # squeeze between two rows
TOUCHING = 5e-4                 # a boundary point nearer to a wall than this touches it [R]
QUICK = {"points": 124, "squeeze": 0.2, "speed": 0.5}
# Force per thickness over R [Pa] at these squeezes, frictionless plates, default materials.
REFERENCE_SQUEEZES = (0.1, 0.2, 0.3, 0.4)
REFERENCE = {"nh": (393.5e3, 1107.8e3, 2324.7e3, 4493.9e3), "mr": (359.7e3, 987.2e3, 1987.6e3, 3603.6e3)}  # F / R [Pa]
REFERENCE_WIDTHS = {"nh": (0.3162, 0.5197, 0.7312, 0.9692), "mr": (0.3117, 0.5040, 0.6928, 0.8930)}        # a / R


def read_options():
    parser = opt.Parser("squeeze", "One soft disc squeezed between rigid walls.")
    scene = parser.add_argument_group("the scene")
    scene.add_argument("--radius", type=opt.positive, default=1e-3, metavar="R", help="of the disc [m]")
    scene.add_argument("--walls", type=int, choices=(2, 4), default=2, help="two plates, or four walls closing equally")
    scene.add_argument("--squeeze", type=opt.positive, default=0.4, metavar="S",
                       help="at the end; four walls: 0.1 unless given, since the disc fills the square at 0.114")
    scene.add_argument("--speed", type=opt.positive, default=0.1, metavar="V",
                       help="at which opposite walls approach each other [m/s]; small enough to be quasi-static")
    scene.add_argument("--friction", type=opt.not_negative, default=0.0, metavar="MU", help="of disc and walls")
    scene.add_argument("--angle", type=opt.finite, default=0.0, metavar="RAD", help="rotation of the disc's grid")
    opt.add_quick(scene, "short:", QUICK)
    opt.add_material(parser)
    opt.add_method(parser)
    parser.add_management()
    options = parser.read()
    options.set_quick(QUICK)
    opt.choose_by_accuracy(options)
    if options.walls == 4 and "squeeze" not in options.given:
        options.squeeze = 0.1
    opt.make_quasistatic_implicit(options)
    if options.squeeze >= 0.9:
        raise InputError(f"--squeeze {options.squeeze:g} leaves no room for the disc: give less than 0.9.")
    return options


def make_scene(options):
    """The disc about the origin and its walls: dict of (body id, axis) by name; the longest implicit step [s]."""
    soft = O.materials.append(opt.make_material(options))
    rigid = O.materials.append(FrictMat(frictionAngle=math.atan(options.friction), label="walls"))
    O.bodies.append(softDisc((0, 0), options.radius, soft, angle=options.angle, **opt.grain_settings(options)))
    walls = {}
    for name, axis, side in [("bottom", 1, -1), ("top", 1, 1), ("left", 0, -1), ("right", 0, 1)][:options.walls]:
        body = yade_wall(side * options.radius, axis=axis, sense=-side, material=rigid)
        velocity = [0, 0, 0]
        velocity[axis] = -side * options.speed / 2
        body.state.vel = velocity
        walls[name] = (O.bodies.append(body), axis)
    method = {**opt.engine_settings(options), **opt.choose_method(options, options.radius * OUTPUT / options.speed)}
    O.engines = softEngines(wallFriction=options.friction, **method)
    return walls, method["dt"] if "integrator" in method else None


class Squeeze:
    """Closes the walls and records. `walls`: (body id, axis) by name."""

    def __init__(self, run, walls):
        self.run, self.walls, self.options = run, walls, run.options
        self.disc = measures.softBodies()[0]
        self.soft = measures.softIntegrator()
        self.memory = run.memory
        self.forces = WallForces(walls, run, run.memory["longest_step"])
        if not run.resumed:
            self.forces.first_step()
            self.forces.require_steps(2 * self.options.radius * OUTPUT / self.options.speed, self.options.speed)
            run.begin()
            self.memory.update(window=0, middle=None, steps=1, deepest=0.0)
            self.forces.reset()

    def go(self):
        memory, run = self.memory, self.run
        with run.computing():
            while self._end_of(memory["window"] - 1) < self.options.squeeze:
                self._one_window()
                done = self._end_of(memory["window"] - 1)
                run.progress.show(done / self.options.squeeze, f"squeeze {done:.3f}  step {memory['steps']}")
                run.checkpoint_if_due()

    def _one_window(self):
        window = self.memory["window"]
        self.forces.through_window(self._time_of(window - 1), self._time_of(window), self._instant)
        self._record()
        self.forces.remember()

    def _end_of(self, window):
        """Squeeze at the end of a window: rows lie at whole multiples of OUTPUT, the first at a quarter of it."""
        return max(window + 0.5, 0) * OUTPUT

    def _time_of(self, window):
        """When a window ends [s]."""
        return 2 * self.options.radius * self._end_of(window) / self.options.speed

    def _squeeze(self):
        """Now, by the places of the walls."""
        low, high = (O.bodies[self.walls[name][0]].state.pos[1] for name in ("bottom", "top"))
        return 1 - (high - low) / (2 * self.options.radius)

    def _instant(self):
        """Columns measured at one moment."""
        outline, radius = arrays.outline(self.disc), self.options.radius
        area, squeeze = self.disc.state.area(), self._squeeze()
        gap, width = 2 * radius * (1 - squeeze), measures.extent(outline, 0)
        if self.options.walls == 4:
            width = min(width, gap)
        contact = [measures.contactHalfWidth(outline, axis, O.bodies[wall].state.pos[axis], TOUCHING * radius)
                   for wall, axis in self.walls.values()]
        return {"squeeze": squeeze, "contact_half_width_m": float(numpy.mean(contact)),
                "area_ratio": area / self.disc.shape.area(), "half_width_m": width / 2,
                "solid_fraction": area / (gap * (gap if self.options.walls == 4 else width)),
                "min_J": self.disc.state.minJ()}

    def _record(self):
        memory, forces = self.memory, self.forces
        force = float(numpy.mean([abs(forces.mean(name)) for name in self.walls]))
        self.run.table.append({**memory["middle"], "force_per_thickness_N_m": force, "cpu_s": self.run.cpu_seconds()})
        memory.update(window=memory["window"] + 1, middle=None, steps=memory["steps"] + forces.steps,
                      deepest=max(memory["deepest"], self.soft.maxPenetration()))
        forces.reset()

    def balance(self):
        """Energy that is missing, over the work of the walls."""
        return (measures.heldOrLost(self.soft) - self.soft.externalWork) / self.soft.externalWork


def check(squeeze, table, options):
    """What must hold: list of (what, holds), and the comparison with the reference, a dict, where there is one."""
    force, done = table["force_per_thickness_N_m"], table["squeeze"]
    balance, least = squeeze.balance(), float(table["min_J"].min())
    checks = [(f"squeeze {options.squeeze:g} reached ({done[-1]:.4f})", done[-1] > options.squeeze - OUTPUT),
              (f"force grows from row to row of squeeze over 5 % ({len(force)} rows)",
               bool((numpy.diff(force[done > 0.05]) > 0).all())),
              (f"energy missing below 0.2 % of the work ({balance:.3%})", abs(balance) < 2e-3),
              (f"no point inverted (least J {least:.3f})", least > 0)]
    material = {"lambda_", "mu", "c1", "c2", "c", "viscosity"} & options.given
    compared = {}
    if options.walls == 2 and not options.friction and not material and options.material in REFERENCE:
        width = table["contact_half_width_m"]
        for at, *expected in zip(REFERENCE_SQUEEZES, REFERENCE[options.material], REFERENCE_WIDTHS[options.material]):
            if at > done[-1]:
                break
            for what, unit, column, value, allowed in (("force", "N_m", force, expected[0], (0.03, 0.08)),
                                                       ("contact_half_width", "m", width, expected[1], (0.05, 0.08))):
                found, known = float(numpy.interp(at, done, column)), value * options.radius
                compared.setdefault(f"{at:g}", {}).update({f"{what}_{unit}": found,
                                                           f"{what}_finite_elements_{unit}": known})
                error, most = found / known - 1, allowed[options.points < 250]
                checks.append((f"{what.replace('_', ' ')} at {at:.0%} within {most:.0%} of finite elements: {found:.5g} "
                               f"{unit.replace('_', '/')} against {known:.5g} ({error:+.2%})", abs(error) < most))
    return checks, compared


def main():
    options = read_options()
    opt.use_threads(options.threads)
    run = runs.Run("squeeze", options, COLUMNS)
    if not run.resumed:
        run.memory["walls"], run.memory["longest_step"] = make_scene(options)
    squeeze = Squeeze(run, run.memory["walls"])
    squeeze.go()
    table = read_table(run.path("squeeze.csv"))
    checks, compared = check(squeeze, table, options)
    result = summary.head(run)
    result.update(reference=compared, energy_missing_over_work=squeeze.balance(),
                  deepest_penetration=squeeze.memory["deepest"],
                  cost=summary.costs(run, measures.pointTotal(), squeeze.memory["steps"], summary.stages()))
    return runs.conclude(run, result, checks)


runs.main(main)
