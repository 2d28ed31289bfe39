# SPDX-License-Identifier: GPL-2.0-or-later
"""A soft grain is pushed through a funnel that is narrower than the grain.

    yade -n -x examples/funnel.py [options]          --help lists them

The funnel is made of facets: two slopes and a channel below them. A box pushes the grain through at constant speed. Writes funnel.csv
(force on the box, width of the grain and energies, along its way), figure1.png, snapshot_1.npz to snapshot_4.npz and summary.json
into --out.
"""
import math

import numpy
from yade import O
from yade.utils import box, facet
from yade.wrapper import FrictMat

from softgrain import arrays, measures, options as opt, runs, softDisc, softEngines, summary
from softgrain.checks import InputError
from softgrain.records import read_table
from softgrain.runs import Run
from softgrain.timed import Timed

COLUMNS = ["time_s", "way_m", "force_N_m", "width_m", "area_ratio", "min_J", "kinetic_J", "elastic_J", "external_work_J", "friction_J",
           "contact_dissipation_J", "viscous_dissipation_J", "energy_residual_J", "max_penetration_over_R", "cpu_s"]
QUICK = {"points": 124, "speed": 0.4}
ROWS, SHOTS = 150, (0, 50, 62, 150)
PISTON = 0.45           # half-width of the box [width of the channel]
BALANCE = 0.02          # most energy that may be missing [work]
REGAINED = 0.03         # how far the grain's width may be off its diameter at the end


def read_options():
    parser = opt.Parser("funnel", "A soft grain is pushed through a funnel.")
    group = parser.add_argument_group("the scene")
    group.add_argument("--radius", type=opt.positive, default=5e-3, metavar="M", help="of the grain [m]")
    group.add_argument("--opening", type=opt.positive, default=0.7, metavar="SHARE", help="width of the channel [diameter of the grain]")
    group.add_argument("--slope", type=opt.positive, default=60.0, metavar="DEG", help="of the funnel against the horizontal")
    group.add_argument("--speed", type=opt.positive, default=0.2, metavar="V", help="of the box that pushes [m/s]")
    opt.add_gel(group, viscosity=1.0, friction=0.2, points=276)
    opt.add_quick(group, "coarse and fast:", QUICK)
    parser.add_management()
    parser.add_movie()
    options = parser.read()
    options.set_quick(QUICK)
    if not options.opening < 1:
        raise InputError(f"--opening {options.opening:g} has to lie below 1: the channel is to be narrower than the grain.")
    if not options.slope < 85:
        raise InputError(f"--slope {options.slope:g} has to lie below 85 degrees.")
    return options


def build(options):
    """The grain on the slopes above the channel, the funnel, and the box above the grain, which comes last."""
    radius, half, slope = options.radius, options.opening * options.radius, math.radians(options.slope)
    angle = math.atan(options.friction)
    O.materials.append(opt.make_gel(options))
    O.materials.append(FrictMat(frictionAngle=angle, label="steel"))
    # the centre from which both slopes, whose lower ends are the corners (half, 0), are a radius away
    centre = 1.001 * radius / math.cos(slope) - half * math.tan(slope)
    centre = max(centre, math.sqrt(max((1.001 * radius)**2 - half**2, 0)))
    O.bodies.append(softDisc((0, centre), radius, "gel", points=options.points))
    rise, deep = 1.6 * radius, 1.5 * radius
    for side in (-1, 1):
        corners = [(side * (half + rise / math.tan(slope)), rise, 0), (side * half, 0, 0), (side * half, -deep, 0)]
        for one, other in zip(corners, corners[1:]):
            third = ((one[0] + other[0]) / 2, (one[1] + other[1]) / 2, -radius)   # the plane cuts the line from one to other
            O.bodies.append(facet([one, other, third], material="steel"))
    thick = 0.2 * radius
    O.bodies.append(box((0, centre + 1.002 * radius + thick, 0), (2 * PISTON * half, thick, radius), material="steel", fixed=True))
    O.bodies[len(O.bodies) - 1].state.vel = (0, -options.speed, 0)
    O.engines = softEngines()


class Passage:
    """The grain on its way, and what is told of it."""

    def __init__(self, run):
        self.run, self.soft = run, measures.softIntegrator()
        self.grain, self.piston = O.bodies[0], O.bodies[len(O.bodies) - 1]

    def length(self):
        """Way of the box until the grain is out of the channel [m]."""
        radius, top = self.run.options.radius, self.run.memory["top"]
        return top + 1.5 * radius

    def missing(self):
        """Energy that came from nowhere since the start [J/m]."""
        return measures.heldOrLost(self.soft) - self.soft.externalWork

    def row(self, length):
        soft, memory, outline = self.soft, self.run.memory, arrays.outline(self.grain)
        work, memory["work"] = soft.externalWork - memory["work"], soft.externalWork
        return {"time_s": O.time, "way_m": O.time * self.run.options.speed, "force_N_m": work / (self.run.options.speed * length),
                "width_m": measures.extent(outline, 0), "area_ratio": self.grain.state.area() / self.grain.shape.area(),
                "min_J": soft.minJ(), "kinetic_J": soft.kineticEnergy(), "elastic_J": soft.elasticEnergy(),
                "external_work_J": soft.externalWork, "friction_J": soft.frictionDissipation,
                "contact_dissipation_J": soft.contactDissipation, "viscous_dissipation_J": soft.viscousDissipation,
                "energy_residual_J": self.missing(), "max_penetration_over_R": soft.maxPenetration(),
                "cpu_s": self.run.cpu_seconds()}

    def text(self):
        return f"grain at y = {self.grain.state.pos[1] * 1e3:.2f} mm, elastic energy {self.soft.elasticEnergy() * 1e3:.3g} mJ/m"


def main():
    options = read_options()
    opt.use_threads(options.threads)
    run = Run("funnel", options, COLUMNS)
    print(f"funnel: {options.points} points, nothing random")
    if not run.resumed:
        build(options)
    passage = Passage(run)
    if not run.resumed:
        run.memory.update(work=0.0, top=passage.piston.state.pos[1] - 0.2 * options.radius)
    Timed(run, 0.0, passage.length() / options.speed, ROWS, passage.row, passage.text, SHOTS).go()
    return conclude(run, passage)


def conclude(run, passage):
    """Figure, summary and checks; the exit code."""
    from softgrain import scene_figure

    table, radius = read_table(run.path("funnel.csv")), run.options.radius
    way = table["way_m"] * 1e3
    scene_figure.draw(run, len(SHOTS), ((way, table["force_N_m"], "force of the box  [N/m]"),
                                        (way, table["width_m"] * 1e3, "width of the grain  [mm]")), "way of the box  [mm]",
                      along_of=lambda time: time * run.options.speed * 1e3)
    work = table["external_work_J"][-1]
    missing = float(numpy.max(numpy.abs(table["energy_residual_J"])) / work)
    width = table["width_m"][-1] / (2 * radius)
    result = {**summary.head(run), "work_J_m": work, "largest_force_N_m": float(max(table["force_N_m"])),
              "narrowest_over_diameter": float(min(table["width_m"]) / (2 * radius)), "width_at_end_over_diameter": width,
              "energy_residual_over_work": missing, "cost": summary.costs(run, measures.pointTotal(), O.iter, summary.stages())}
    run.options.figures = False
    return runs.conclude(run, result, [
        (f"energy balance closes within {BALANCE:.0%} of the work ({missing:.2g})", missing < BALANCE),
        (f"the grain is as narrow as the channel on its way ({result['narrowest_over_diameter']:.3f} of its diameter)",
         abs(result["narrowest_over_diameter"] - run.options.opening) < 0.02),
        (f"and round again below it ({width:.3f})", abs(width - 1) < REGAINED and passage.grain.state.pos[1] < -1.5 * radius)])


runs.main(main)
