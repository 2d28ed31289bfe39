# SPDX-License-Identifier: GPL-2.0-or-later
"""Uniaxial compaction of a packing of soft discs (Vu et al. 2017, section 3, figures 1 to 5).

    yade -n -x examples/compaction.py [options]          --help lists them

          v = 1 m/s                  300 discs of diameter 1.4 to 2.4 mm that do not touch at first, solid fraction
      +-----+-----+  h(t)            0.65; no gravity, no friction. The top wall comes down, the others stand still.
      | o  O o  O |
      |O o  O o  o|                  strain          e = ln(h0 / h)
      | o O  o O  |                  solid fraction  phi = Vs / (L h)
      +-----------+                  eq. 9           ln(Vs / Vs0) = ln(phi / phi0) - e
            L                        eq. 10          (Z - Z0)/(Z1 - Z0) = ((phi - phi0)/(phi1 - phi0))^0.5

(The paper counts e negative; e is positive here, hence the minus in eq. 9.)
Grains, eq. 7:  Neo-Hookean    S = (lambda ln J - mu) C^-1 + mu I
        eq. 8:  Mooney-Rivlin  S = 2 (c1 + c2 tr C) I - 2 c2 C + [2 c J (J - 1) - d] C^-1,  d = 2 (c1 + 2 c2)
Contacts:  0 <= r_n  perp  u_n + g/dt >= 0,  |r_t| <= mu_f r_n  (Signorini, Coulomb).

Writes compaction.csv (its columns: softgrain/press.py), figure1.png to figure5.png and summary.json into --out, and
checks its own result.
"""
import math

from softgrain import *
from softgrain import builders, options as opt, runs, summary
from softgrain.packings import SoftPacking
from softgrain.press import Press, columns_of, implicit_step
from yade import O

QUICK = {"grains": 40, "points": 60, "until": 0.9}


def read_options():
    parser = opt.Parser("compaction", "Uniaxial compaction of a packing of soft discs.")
    opt.add_packing(parser, until=0.98)
    opt.add_material(parser)
    opt.add_method(parser)
    parser.add_management()
    parser.add_movie()
    options = parser.read()
    options.set_quick(QUICK)
    opt.choose_by_accuracy(options)
    opt.make_quasistatic_implicit(options)
    opt.refuse_nothing_to_press(options)
    return options


def make_scene(options):
    """Grains, walls and engines; the box as Press wants it."""
    grain_material = O.materials.append(opt.make_material(options))
    wall_material = O.materials.append(FrictMat(frictionAngle=math.atan(options.wall_friction), label="walls"))
    width = builders.widthOfSquareCloud(options.grains, options.diameters, options.solid_fraction)
    grains, height = softCloud(width, options.grains, options.diameters, options.solid_fraction, grain_material,
                               seed=options.seed, **opt.grain_settings(options))
    O.bodies.append(grains)
    _, _, bottom, top = O.bodies.append(softBox(width, height, wall_material))
    box = {"width": width, "height": height, "bottom": bottom, "top": top}
    method = {**opt.engine_settings(options), **opt.choose_method(options, implicit_step(box, options.speed))}
    O.engines = softEngines(friction=options.friction, wallFriction=options.wall_friction, **method)
    return {**box, "longest_step": method["dt"] if "integrator" in method else None}


def check(result, options):
    """What must hold of any such run: list of (what, holds)."""
    end, point = result["end"], result["jamming"]
    balance, depth = result["energy_residual_over_work"], result["deepest_penetration"]
    implicit = options.integrator == "implicit"
    most_residual = 2e-2 if implicit else 2e-3
    most_depth = 1e-4 if implicit else 5e-3
    checks = [(f"energy residual below {most_residual:.1%} of the external work ({balance:.3%})", balance < most_residual),
              (f"penetration below {most_depth:.2%} of R ({depth:.4%})", depth < most_depth),
              (f"no point inverted (least J {end['min_J']:.3f})", end["min_J"] > 0),
              (f"solid fraction {options.until:g} reached ({end['solid_fraction']:.4f})",
               end["solid_fraction"] >= options.until)]
    if options.until >= 0.9:
        checks.append((f"the packing jams ({'at %.3f' % point['solid_fraction'] if point else 'never'})", bool(point)))
    if options.grains >= 200 and not options.friction and point:
        checks.append((f"jamming between 0.81 and 0.85 ({point['solid_fraction']:.3f})",
                       0.81 <= point["solid_fraction"] <= 0.85))
    if options.material == "nh" and options.until <= 0.98 and "lambda_" not in options.given:
        change = end["log_volume_change"]
        checks.append((f"|ln Vs/Vs0| below 0.04 ({change:.4f})", abs(change) < 0.04))
    return checks


def main():
    options = read_options()
    opt.use_threads(options.threads)
    run = runs.Run("compaction", options, columns_of)
    if not run.resumed:
        run.memory["box"] = make_scene(options)
    packing = SoftPacking(frictional=options.friction > 0 or options.wall_friction > 0)
    press = Press(run, packing, run.memory["box"], options.speed, run.memory["box"]["longest_step"])
    press.go(options.until)
    result = summary.of_compaction(run, packing, press)
    return runs.conclude(run, result, check(result, options))


runs.main(main)
