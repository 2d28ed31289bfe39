# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft and rigid discs mixed, from all soft to all rigid, and compacted from all sides, with and without friction, as Cardenas-Barrantes,
Cantor, Bares, Renouf and Azema (Physical Review E 102, 032904, 2020) did.

    yade -n -x examples/mixed_packing.py [options]          --help lists them

Writes mixed_packing.csv (the rows of all mixtures, a row every 0.004 of strain), figure1.png (stress along the solid fraction, and
the solid fraction at some stresses by the share of rigid discs) and summary.json into --out. --resume goes on with the mixtures
that are missing.
"""
from softgrain import options as opt, runs, summary
from softgrain.cases import Cases
from softgrain.checks import InputError
from softgrain.records import read_table

QUICK = {"grains": 20, "rigid_fractions": [0.0, 0.5, 1.0], "points": 60, "rate": 40.0}
STRESSES = (1e4, 1e5, 1e6)      # of the right panel [Pa]
BALANCE, SOUND = 0.02, 0.05     # most energy missing [work]; deepest penetration [radius of the smaller disc]


def read_options():
    parser = opt.Parser("mixed_packing", "Soft and rigid discs mixed, compacted from all sides.")
    group = parser.add_argument_group("the packings")
    group.add_argument("--grains", type=opt.count, default=100, metavar="N", help="number of discs")
    group.add_argument("--rigid-fractions", type=opt.share, nargs="+", default=[0.0, 0.2, 0.4, 0.6, 0.8, 1.0], metavar="KAPPA",
                       help="shares of rigid discs, a packing each")
    group.add_argument("--friction", type=opt.not_negative, nargs="+", default=[0.0, 0.4], metavar="MU",
                       help="between discs, a row of packings each")
    group.add_argument("--stress-limit", type=opt.positive, default=1e6, metavar="PA", help="where each ends [Pa]")
    group.add_argument("--rate", type=opt.positive, default=20.0, metavar="1/S", help="of strain of each side [1/s]")
    group.add_argument("--diameters", type=opt.positive, nargs=2, default=[1.4e-3, 2.4e-3], metavar=("MIN", "MAX"),
                       help="of the discs, uniform between these [m]")
    group.add_argument("--solid-fraction", type=opt.positive, default=0.65, metavar="PHI", help="at the start")
    group.add_argument("--points", type=opt.count, default=60, metavar="N", help="material points of a soft disc")
    group.add_argument("--dt-rigid", type=opt.positive, default=5e-6, metavar="S", help="time step where all discs are rigid [s]")
    group.add_argument("--seed", type=opt.seed, default=1, metavar="N", help="of sizes, places and which are rigid")
    opt.add_quick(group, "small:", {"grains": 20, "rigid-fractions": "0 0.5 1", "rate": 40})
    opt.add_material(parser)
    parser.add_management()
    options = parser.read()
    options.set_quick(QUICK)
    if len(set(options.friction)) > 4:
        raise InputError(f"--friction has {len(options.friction)} values: give up to four.")
    return options


def main():
    from softgrain.mixtures import COLUMNS, Mixture

    options = read_options()
    opt.use_threads(options.threads)
    run = Cases("mixed_packing", options, COLUMNS)
    print(f"mixed_packing: {options.grains} discs, seed {options.seed}")
    cases = [(rigid, friction) for friction in options.friction for rigid in options.rigid_fractions]
    run.compute(cases, lambda case, show: Mixture(options, opt.make_material(options), *case).compact(
        options.stress_limit, show, run.cpu_seconds))
    return conclude(run, cases)


def conclude(run, cases):
    """Figure, summary and checks; the exit code."""
    from softgrain import mixture_figure, mixtures

    table, limit = read_table(run.path("mixed_packing.csv")), run.options.stress_limit
    levels = [stress for stress in STRESSES if stress <= limit] or [limit]
    mixture_figure.draw(table, cases, levels, run.path("figure1.png"))
    ends = [{"rigid_fraction": case[0], "friction": case[1], "jamming_fraction": mixtures.jamming_fraction(table, case),
             **{f"fraction_at_{stress:g}_Pa": mixtures.fraction_at(table, case, stress) for stress in levels}} for case in cases]
    for end in ends:
        print("  ".join(f"{name} {value:.4g}" for name, value in end.items()))
    missing, depth = max(abs(table["energy_residual_over_work"][table["stress_Pa"] > limit / 10])), max(table["max_penetration_over_R"])
    checks = [(f"energy balance closes within {BALANCE:.0%} of the work ({missing:.2g})", missing < BALANCE),
              (f"discs stay out of each other ({depth:.2g} radii)", depth < SOUND)]
    run.options.figures = False
    return runs.conclude(run, {**summary.head(run), "packings": ends, "cpu_s": run.cpu_seconds()}, checks)


runs.main(main)
