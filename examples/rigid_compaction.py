# SPDX-License-Identifier: GPL-2.0-or-later
"""The packing of compaction.py with rigid discs: where does it jam, and what is it up to there?

    yade -n -x examples/rigid_compaction.py [options]          --help lists them

          v = 1 m/s         The same box, sizes, places (by --seed) and moving wall as in compaction.py. The discs are
      +-----+-----+         YADE's spheres kept in the plane, with the mass and moment of inertia of discs of unit
      | o  O o  O |         thickness, so that forces and energies are per metre as in compaction.py.
      |O o  O o  o|
      | o O  o O  |         --law yade, Cundall-Strack:  F_n = k_n overlap,  |F_t| <= mu F_n,  and numerical
      +-----------+             damping, since these discs have no other way to lose their energy
                            --law cd, Contact Dynamics as of soft grains: no overlap, no stiffness, no damping

Rigid discs cannot pass random close packing: the run ends at --until or when the stress on the bottom wall exceeds
--stress-limit. Writes the csv columns of compaction.py as far as they mean something (others: nan; the damping's work
stands in contact_dissipation_J, the overlap in max_penetration_over_R), the figures and summary.json into --out, and
checks its own result.
"""
import math

from softgrain import *
from softgrain import builders, options as opt, runs, summary
from softgrain.checks import InputError
from softgrain.packings import RigidPacking
from softgrain.press import COLUMNS, Press
from yade import O
from yade.utils import sphere

QUICK = {"grains": 40}
STEP = 0.1                  # time step [sqrt(mass of the smallest disc / stiffness)]
CLOSED = 2e-3               # the same of Contact Dynamics, as the way of the wall [radius of the smallest disc]


def read_options():
    parser = opt.Parser("rigid_compaction", "Uniaxial compaction of YADE's rigid discs.")
    scene = opt.add_packing(parser, until=0.86)
    scene.add_argument("--stress-limit", type=opt.positive, default=200e3, metavar="PA",
                       help="end when the mean stress on the bottom wall exceeds this")
    scene.add_argument("--law", choices=("yade", "cd"), default="yade",
                       help="of contacts: YADE's Cundall-Strack, or Contact Dynamics, which knows no stiffness and no damping")
    scene.add_argument("--tolerance", type=opt.positive, default=1e-3, metavar="TAU", help="cd: of the contact solver")
    scene.add_argument("--stiffness", type=opt.positive, default=5e8, metavar="PA",
                       help="normal stiffness of a contact per metre of thickness")
    scene.add_argument("--shear-ratio", type=opt.positive, default=0.5, metavar="K", help="shear over normal stiffness")
    scene.add_argument("--damping", type=opt.not_negative, default=0.2, metavar="D", help="of YADE's NewtonIntegrator")
    scene.add_argument("--density", type=opt.positive, default=1000.0, metavar="KG/M3", help="of the discs")
    scene.add_argument("--dt", type=opt.positive, default=None, metavar="S",
                       help="time step; None: chosen automatically")
    parser.add_management()
    parser.add_movie()
    options = parser.read()
    options.set_quick(QUICK)
    opt.refuse_nothing_to_press(options)
    if options.damping >= 1:
        raise InputError(f"--damping {options.damping:g} is not below 1: 0.2 is sound.")
    return options


def make_scene(options):
    """Discs, walls and engines; the box as Press wants it."""
    width = builders.widthOfSquareCloud(options.grains, options.diameters, options.solid_fraction)
    radii, places, _, height = discCloud(width, options.grains, options.diameters, options.solid_fraction,
                                         options.seed)
    discs, walls = (O.materials.append(FrictMat(density=options.density, label=label)) for label in ("discs", "walls"))
    for radius, (x, y) in zip(radii, places):
        body = sphere((x, y, 0), radius, material=discs)
        body.state.blockedDOFs = "zXY"
        body.state.mass = mass = options.density * math.pi * radius**2
        body.state.inertia = (mass * radius**2 / 2,) * 3
        O.bodies.append(body)
    sides = softBox(width, height, walls)
    for side in sides:
        side.state.isDamped = False     # else YADE counts damping of the driven wall as dissipated
    _, _, bottom, top = O.bodies.append(sides)
    # a pair of two grains rubs with --friction, of a grain and a wall with --wall-friction
    angle = MatchMaker(matches=((discs, discs, math.atan(options.friction)),
                                (discs, walls, math.atan(options.wall_friction))))
    if options.law == "cd":
        functors = rigidContacts()
        functors[-2].frictAngle = angle
        O.engines = softEngines(dt=options.dt or CLOSED * min(radii) / options.speed, tolerance=options.tolerance,
                                functors=functors)
    else:
        O.engines = cundall_strack(options, min(radii), angle)
    return {"width": width, "height": height, "bottom": bottom, "top": top}


def cundall_strack(options, smallest, angle):
    """Engines of YADE's law; smallest radius [m], friction angles of the pairs."""
    limit = math.sqrt(options.density * math.pi * smallest**2 / options.stiffness)
    O.dt = options.dt or STEP * limit
    if O.dt > limit:
        raise InputError(f"--dt {options.dt:g} is over the stable limit, {limit:.3g} s for --stiffness "
                         f"{options.stiffness:g}: give less, or leave it away.")
    O.trackEnergy = True
    return [
        ForceResetter(),
        InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.05 * smallest),
        InteractionLoop(
            [Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
            [Ip2_FrictMat_FrictMat_FrictPhys(kn=MatchMaker(algo="val", val=options.stiffness),
                                             ks=MatchMaker(algo="val", val=options.stiffness * options.shear_ratio),
                                             frictAngle=angle)],
            [Law2_ScGeom_FrictPhys_CundallStrack()]),
        NewtonIntegrator(damping=options.damping),
    ]


def check(result, options):
    """What must hold of any such run: list of (what, holds)."""
    end, point = result["end"], result["jamming"]
    balance, depth = result["energy_residual_over_work"], result["deepest_penetration"]
    checks = [(f"energy residual below 2 % of the external work ({balance:.2%})", balance < 0.02),
              (f"overlap below 2 % of R ({depth:.3%})", depth < 0.02),
              (f"ended at solid fraction {end['solid_fraction']:.4f} and {end['stress_bottom_Pa'] / 1e3:.0f} kPa",
               end["solid_fraction"] >= options.until or end["stress_bottom_Pa"] > options.stress_limit)]
    if options.until >= 0.86:
        checks.append((f"the packing jams ({'at %.3f' % point['solid_fraction'] if point else 'never'})", bool(point)))
    if options.grains >= 200 and options.speed <= 1 and point:
        least = 0.72 if options.friction else 0.76      # at 1 m/s the wall's pressure jams the discs early
        checks.append((f"jamming between {least} and 0.85 ({point['solid_fraction']:.3f})",
                       least <= point["solid_fraction"] <= 0.85))
    return checks


def main():
    options = read_options()
    opt.use_threads(options.threads)
    run = runs.Run("rigid_compaction", options, COLUMNS)
    if not run.resumed:
        run.memory["box"] = make_scene(options)
    packing = RigidPacking(frictional=options.friction > 0 or options.wall_friction > 0)
    press = Press(run, packing, run.memory["box"], options.speed)
    press.go(options.until, options.stress_limit)
    result = summary.of_compaction(run, packing, press)
    return runs.conclude(run, result, check(result, options))


runs.main(main)
