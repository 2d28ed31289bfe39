# SPDX-License-Identifier: GPL-2.0-or-later
"""Gel grains in a turning drum.

    yade -n -x examples/drum.py [options]          --help lists them

The drum is a polygon of facets that a RotationEngine turns once the grains have settled. Writes drum.csv (place of the grains'
centre of mass, torque of the drum and energies, along time), figure1.png, snapshot_1.npz to snapshot_3.npz and summary.json into
--out.
"""
import math

import numpy
from yade import O
from yade.utils import facet
from yade.wrapper import FrictMat, RotationEngine

from softgrain import measures, options as opt, runs, softCloud, softEngines, summary
from softgrain.records import read_table
from softgrain.runs import Run
from softgrain.timed import Timed

COLUMNS = ["time_s", "turn_rad", "centre_x_m", "centre_y_m", "slope_deg", "torque_N", "weight_moment_N",
           "angular_momentum_kg_m_s", "kinetic_J", "elastic_J", "external_work_J", "friction_J",
           "contact_dissipation_J", "viscous_dissipation_J", "energy_residual_J", "max_penetration_over_R", "cpu_s"]
QUICK = {"grains": 20, "radius": 16e-3, "settle": 0.1, "duration": 0.4}
GRAVITY, DIAMETERS, FILL, SIDES = 9.81, (3e-3, 5e-3), 0.7, 36     # [m/s²], [m], of the cloud, of the polygon
ROWS, SHOTS = 200, (0, 60, 200)
BALANCE, MOMENTS = 0.02, 0.02   # most energy missing [dissipated]; angular momentum missing [impulse of the torque]


def read_options():
    parser = opt.Parser("drum", "Gel grains in a turning drum.")
    group = parser.add_argument_group("the scene")
    group.add_argument("--grains", type=opt.count, default=50, metavar="N", help="number of gel grains")
    group.add_argument("--radius", type=opt.positive, default=25e-3, metavar="M", help="of the drum [m]")
    group.add_argument("--spin", type=opt.positive, default=6.0, metavar="RAD/S", help="of the drum [rad/s]")
    opt.add_gel(group, viscosity=0.5, friction=0.5, points=60)
    group.add_argument("--settle", type=opt.positive, default=0.15, metavar="S", help="time the grains settle for [s]")
    group.add_argument("--duration", type=opt.positive, default=1.0, metavar="S", help="time the drum turns for [s]")
    group.add_argument("--seed", type=opt.seed, default=1, metavar="N", help="of the grains")
    opt.add_quick(group, "small and short:", QUICK)
    parser.add_management()
    parser.add_movie()
    options = parser.read()
    options.set_quick(QUICK)
    return options


def build(options):
    """Grains in the lower part of the drum, its facets, and the engine that turns them, still at rest."""
    radius, angle = options.radius, math.atan(options.friction)
    O.materials.append(opt.make_gel(options))
    O.materials.append(FrictMat(frictionAngle=angle, label="drum"))
    width = 1.3 * radius
    grains, _ = softCloud(width, options.grains, DIAMETERS, FILL, "gel", points=options.points, seed=options.seed)
    for body in grains:
        body.state.pos = (body.state.pos[0] - width / 2, body.state.pos[1] - 0.7 * radius, 0)
    O.bodies.append(grains)
    corners = [(radius * math.cos(turn), radius * math.sin(turn), 0) for turn in numpy.linspace(0, 2 * math.pi, SIDES + 1)]
    drum = O.bodies.append([facet([one, other, ((one[0] + other[0]) / 2, (one[1] + other[1]) / 2, -radius)], material="drum")
                            for one, other in zip(corners, corners[1:])])   # the plane cuts the line from one to other
    engines = softEngines(gravity=(0, -GRAVITY, 0))
    turning = RotationEngine(ids=drum, angularVelocity=0, rotationAxis=(0, 0, 1), rotateAroundZero=True, zeroPoint=(0, 0, 0),
                             label="turning")
    O.engines = [*engines[:-2], turning, *engines[-2:]]     # before NewtonIntegrator


class Drum:
    """The grains in the drum, and what is told of them."""

    def __init__(self, run):
        self.run, self.memory, self.soft = run, run.memory, measures.softIntegrator()
        self.grains = measures.softBodies()
        self.mass = math.fsum(body.state.mass for body in self.grains)

    def start(self):
        """Sets the drum in motion."""
        next(engine for engine in O.engines if isinstance(engine, RotationEngine)).angularVelocity = self.run.options.spin
        self.mass = math.fsum(body.state.mass for body in self.grains)      # known once the grains run
        self.memory.update(height=self.centre()[1], work=self.soft.externalWork, missing=self.missing())

    def centre(self):
        """Centre of mass [m]."""
        return [math.fsum(body.state.mass * body.state.pos[axis] for body in self.grains) / self.mass for axis in (0, 1)]

    def angular_momentum(self):
        """Of all grains about the axis of the drum [kg m/s]."""
        states = [body.state for body in self.grains]
        return math.fsum(s.mass * (s.pos[0] * s.vel[1] - s.pos[1] * s.vel[0]) + s.inertia[2] * s.angVel[2] for s in states)

    def missing(self):
        """Energy that came from nowhere since the start [J/m]."""
        return measures.heldOrLost(self.soft) - self.soft.externalWork

    def row(self, length):
        soft, memory, (x, y) = self.soft, self.memory, self.centre()
        weight, spin = self.mass * GRAVITY, self.run.options.spin
        # the work of the drum is all work but that of the weights
        torque = (soft.externalWork - memory["work"] + weight * (y - memory["height"])) / (spin * length)
        memory.update(work=soft.externalWork, height=y)
        time = O.time - self.run.options.settle
        return {"time_s": time, "turn_rad": spin * time, "centre_x_m": x, "centre_y_m": y,
                "slope_deg": math.degrees(math.atan2(x, -y)), "torque_N": torque, "weight_moment_N": weight * x,
                "angular_momentum_kg_m_s": self.angular_momentum(), "kinetic_J": soft.kineticEnergy(),
                "elastic_J": soft.elasticEnergy(), "external_work_J": soft.externalWork,
                "friction_J": soft.frictionDissipation, "contact_dissipation_J": soft.contactDissipation,
                "viscous_dissipation_J": soft.viscousDissipation, "energy_residual_J": self.missing() - memory["missing"],
                "max_penetration_over_R": soft.maxPenetration(), "cpu_s": self.run.cpu_seconds()}

    def text(self):
        x, y = self.centre()
        return f"centre of mass {math.degrees(math.atan2(x, -y)):.1f} degrees up the drum"


def main():
    options = read_options()
    opt.use_threads(options.threads)
    run = Run("drum", options, COLUMNS)
    print(f"drum: {options.grains} grains, seed {options.seed}")
    if not run.resumed:
        build(options)
    drum = Drum(run)
    Timed(run, options.settle, options.duration, ROWS, drum.row, drum.text, SHOTS).go(drum.start)
    return conclude(run)


def conclude(run):
    """Figure, summary and checks; the exit code."""
    from softgrain import scene_figure

    table = read_table(run.path("drum.csv"))
    time = table["time_s"] * 1e3
    scene_figure.draw(run, len(SHOTS), ((time, table["slope_deg"], "slope  [degrees]"),
                                        (time, table["torque_N"] * 1e3, "torque  [mN]")), "time  [ms]")
    # angular momentum: what the drum gives and the weights do not take
    steps, moments = numpy.diff(table["time_s"]), table["weight_moment_N"]
    given, taken = (table["torque_N"][1:] * steps).sum(), ((moments[1:] + moments[:-1]) / 2 * steps).sum()
    kept = table["angular_momentum_kg_m_s"][-1] - table["angular_momentum_kg_m_s"][0]
    lost = abs(given - taken - kept) / given
    slope = float(table["slope_deg"][ROWS // 2:].mean())
    work = table["friction_J"][-1] + table["contact_dissipation_J"][-1] + table["viscous_dissipation_J"][-1]
    missing = float(numpy.max(numpy.abs(table["energy_residual_J"])) / work)
    result = {**summary.head(run), "slope_deg": slope, "torque_N": float(table["torque_N"][ROWS // 2:].mean()),
              "angular_momentum_residual": lost, "energy_residual_over_dissipation": missing,
              "cost": summary.costs(run, measures.pointTotal(), O.iter, summary.stages())}
    run.options.figures = False
    return runs.conclude(run, result, [
        (f"energy balance closes within {BALANCE:.0%} of what is dissipated ({missing:.2g})", missing < BALANCE),
        (f"torques of drum and weights are the change of angular momentum within {MOMENTS:.0%} ({lost:.2g})", lost < MOMENTS),
        (f"the grains lean up the drum ({slope:.1f} degrees)", slope > 5)])


runs.main(main)
