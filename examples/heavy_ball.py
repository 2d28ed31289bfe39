# SPDX-License-Identifier: GPL-2.0-or-later
"""A heavy rigid ball falls on a bed of gel grains.

    yade -n -x examples/heavy_ball.py [options]          --help lists them

The grains settle in a box under gravity; then the ball comes with the speed of a fall from --height. Writes heavy_ball.csv (depth,
speed and force of the ball, and energies, along time), figure1.png, snapshot_1.npz to snapshot_3.npz and summary.json into --out.
"""
import math

from yade import O

from softgrain import (arrays, measures, options as opt, rigidDisc, runs, softBox, softCloud, softEngines,
                       summary)
from softgrain.records import read_table
from softgrain.runs import Run
from softgrain.timed import Timed
from yade.wrapper import FrictMat

COLUMNS = ["time_s", "depth_m", "velocity_m_s", "force_N_m", "ball_kinetic_J", "elastic_J", "grains_kinetic_J", "external_work_J",
           "friction_J", "contact_dissipation_J", "viscous_dissipation_J", "energy_residual_J", "max_penetration_over_R", "cpu_s"]
QUICK = {"grains": 16, "width": 20e-3, "settle": 0.05, "duration": 0.04}
GRAVITY = 9.81          # [m/s²]
ROWS, SHOTS = 160, (0, 20, 160)
DIAMETERS, FILL = (3e-3, 5e-3), 0.72
BALANCE = 0.02          # most energy that may be missing [kinetic energy of the ball at impact]


def read_options():
    parser = opt.Parser("heavy_ball", "A heavy rigid ball falls on a bed of gel grains.")
    group = parser.add_argument_group("the scene")
    group.add_argument("--grains", type=opt.count, default=70, metavar="N", help="number of gel grains")
    group.add_argument("--width", type=opt.positive, default=40e-3, metavar="M", help="of the box [m]")
    opt.add_gel(group, viscosity=0.5, friction=0.2, points=60)
    group.add_argument("--radius", type=opt.positive, default=4e-3, metavar="M", help="of the ball [m]")
    group.add_argument("--density", type=opt.positive, default=8000.0, metavar="KG/M3", help="of the ball [kg/m³]")
    group.add_argument("--height", type=opt.positive, default=0.05, metavar="M", help="of the fall [m]")
    group.add_argument("--settle", type=opt.positive, default=0.1, metavar="S", help="time the grains settle for [s]")
    group.add_argument("--duration", type=opt.positive, default=0.08, metavar="S", help="time from then on [s]")
    group.add_argument("--seed", type=opt.seed, default=1, metavar="N", help="of the grains")
    opt.add_quick(group, "small and short:", QUICK)
    parser.add_management()
    parser.add_movie()
    options = parser.read()
    options.set_quick(QUICK)
    return options


def build(options):
    """Bodies and engines; the ball comes last and waits."""
    angle = math.atan(options.friction)
    O.materials.append(opt.make_gel(options))
    O.materials.append(FrictMat(frictionAngle=angle, label="walls"))
    O.materials.append(FrictMat(frictionAngle=angle, density=options.density, label="steel"))
    grains, height = softCloud(options.width, options.grains, DIAMETERS, FILL, "gel", points=options.points, seed=options.seed)
    O.bodies.append(grains)
    O.bodies.append(softBox(options.width, height, "walls")[:3])
    ball = rigidDisc((options.width / 2, height + 3 * options.radius), options.radius, "steel")
    ball.state.blockedDOFs = "xyzXYZ"
    O.bodies.append(ball)
    O.engines = softEngines(gravity=(0, -GRAVITY, 0))


def kinetic(state):
    """Energy of a rigid body [J/m]."""
    return (state.mass * state.vel.squaredNorm() + state.inertia[2] * state.angVel[2]**2) / 2


class Ball:
    """The ball, and what is told of it."""

    def __init__(self, run):
        self.run, self.memory = run, run.memory
        self.body, self.soft = O.bodies[len(O.bodies) - 1], measures.softIntegrator()

    def release(self):
        """Puts it just above the grains, with the speed of its fall."""
        state, radius = self.body.state, self.body.shape.radius
        top = max(arrays.outline(grain)[:, 1].max() for grain in measures.softBodies())
        speed = math.sqrt(2 * GRAVITY * self.run.options.height)
        state.pos, state.blockedDOFs = (state.pos[0], top + 1.01 * radius, state.pos[2]), "zXY"
        state.vel = (0, -speed, 0)
        self.memory.update(top=top, speed=speed, before=-speed, energy=self.energy())

    def energy(self):
        """Of ball and grains, that of gravity and all that has been dissipated included [J/m]: it stays what it is."""
        height = sum(body.state.mass * body.state.pos[1] for body in [self.body, *measures.softBodies()])
        return measures.heldOrLost(self.soft) + kinetic(self.body.state) + GRAVITY * height

    def row(self, length):
        state, soft = self.body.state, self.soft
        force = state.mass * ((state.vel[1] - self.memory["before"]) / length + GRAVITY)
        self.memory["before"] = state.vel[1]
        return {"time_s": O.time - self.run.options.settle, "depth_m": self.memory["top"] - (state.pos[1] - self.body.shape.radius),
                "velocity_m_s": state.vel[1], "force_N_m": force,
                "ball_kinetic_J": kinetic(state), "elastic_J": soft.elasticEnergy(), "grains_kinetic_J": soft.kineticEnergy(),
                "external_work_J": soft.externalWork,
                "friction_J": soft.frictionDissipation, "contact_dissipation_J": soft.contactDissipation,
                "viscous_dissipation_J": soft.viscousDissipation, "energy_residual_J": self.energy() - self.memory["energy"],
                "max_penetration_over_R": soft.maxPenetration(), "cpu_s": self.run.cpu_seconds()}

    def text(self):
        return f"ball at y = {self.body.state.pos[1] * 1e3:.1f} mm, {self.body.state.vel[1]:.2f} m/s"


def main():
    options = read_options()
    opt.use_threads(options.threads)
    run = Run("heavy_ball", options, COLUMNS)
    print(f"heavy_ball: {options.grains} grains, seed {options.seed}")
    if not run.resumed:
        build(options)
    ball = Ball(run)
    Timed(run, options.settle, options.duration, ROWS, ball.row, ball.text, SHOTS).go(ball.release)
    return conclude(run, ball)


def conclude(run, ball):
    """Figure, summary and checks; the exit code."""
    from softgrain import scene_figure

    table = read_table(run.path("heavy_ball.csv"))
    mass = ball.body.state.mass
    impact = mass * run.memory["speed"]**2 / 2
    scene_figure.draw(run, len(SHOTS), ((table["time_s"] * 1e3, table["depth_m"] * 1e3, "depth of the ball  [mm]"),
                                        (table["time_s"] * 1e3, table["force_N_m"], "force on the ball  [N/m]")), "time  [ms]")
    missing = max(abs(table["energy_residual_J"])) / impact
    deepest = float(max(table["depth_m"]))
    result = {**summary.head(run), "impact": {"speed_m_s": run.memory["speed"], "energy_J_m": impact}, "deepest_m": deepest,
              "largest_force_N_m": float(max(table["force_N_m"])), "energy_residual_over_impact": missing,
              "cost": summary.costs(run, measures.pointTotal(), O.iter, summary.stages())}
    stopped = max(table["velocity_m_s"]) >= 0
    run.options.figures = False
    return runs.conclude(run, result, [
        (f"energy of ball and grains stays within {BALANCE:.0%} of the impact ({missing:.2g})", missing < BALANCE),
        (f"the ball sinks in ({deepest * 1e3:.1f} mm) and is stopped", 0 < deepest and stopped)])


runs.main(main)
