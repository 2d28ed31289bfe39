# SPDX-License-Identifier: GPL-2.0-or-later
"""How packings scatter: jamming and coordination of compaction.py and rigid_compaction.py over several seeds.

    yade -n -x examples/packing_scatter.py [options]          --help lists them

    Z - Z0 = k (phi - phi0)^b        phi0, Z0 at jamming: where the stress on the bottom wall passes 20 kPa

Soft grains of both materials with and without friction, a slower wall, fewer and more grains, and YADE's rigid discs in
the same boxes. Writes packing_scatter.csv, one row a run; curves.csv, means and standard deviations over seeds along the
solid fraction; figure1.png to figure3.png and summary.json into --out. --resume computes only what is missing.
"""
import os
import sys

from softgrain import jamming, options as opt, runs, scatter
from softgrain.records import read_json, read_table, shown
from softgrain.study import Job, Study, read_options as read_study

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
SOFT, RIGID = "compaction.py", "rigid_compaction.py"
# A case: the example, its options, and the seconds a run takes.
CASES = {
    "Neo-Hookean": (SOFT, ["--material", "nh", "--points", 124], 17),
    "Mooney-Rivlin": (SOFT, ["--material", "mr", "--points", 124], 10),
    "Neo-Hookean, friction 0.3": (SOFT, ["--material", "nh", "--points", 124, "--friction", 0.3], 19),
    "Neo-Hookean, 0.25 m/s": (SOFT, ["--points", 60, "--speed", 0.25, "--until", 0.9], 10),
    "Neo-Hookean, 75 grains": (SOFT, ["--points", 60, "--grains", 75, "--until", 0.9], 2),
    "Neo-Hookean, 60 points": (SOFT, ["--points", 60, "--until", 0.9], 4),
    "Neo-Hookean, 1200 grains": (SOFT, ["--points", 60, "--grains", 1200, "--until", 0.9], 50),
    "rigid discs": (RIGID, [], 2),
    "rigid discs, friction 0.3": (RIGID, ["--friction", 0.3], 2),
}
QUICK = {"seeds": 2, "grains": 30}
COLUMNS = ["case", "seed", *scatter.OBSERVABLES, "cpu_s", "status"]


def read_options():
    parser = opt.Parser("packing_scatter", "Jamming and coordination of packings over several seeds.")
    scene = parser.add_argument_group("the study")
    scene.add_argument("--seeds", type=opt.count, default=5, metavar="N", help="packings of each case")
    scene.add_argument("--grains", type=opt.count, default=300, metavar="N", help="where a case does not say")
    return read_study(parser, scene, QUICK, "the first three cases only,")


def cases(options):
    """Names of the cases to run."""
    return list(CASES)[:3] if options.quick else list(CASES)


def make_job(study, case, seed, options):
    """The run of one packing."""
    script, words, cost = CASES[case]
    arguments = [*words, "--seed", seed]
    if "--grains" not in words:
        arguments += ["--grains", options.grains]
    if script == SOFT:
        arguments += ["--no-figures"]

    def read(folder):
        name = script[:-len(".py")]
        table = read_table(os.path.join(folder, f"{name}.csv"))
        scatter.keep(table, study.path(scatter.curve_file(case, seed)))
        return {**scatter.observables(table), "cpu_s": read_json(os.path.join(folder, "summary.json"))["cost"]["cpu_s"]}

    return Job({"case": case, "seed": seed}, os.path.join(HERE, script), arguments, read, cost)


def main():
    options = read_options()
    opt.use_threads(options.threads)
    study = Study("packing_scatter", options, COLUMNS)
    study.compute([make_job(study, case, seed, options) for case in cases(options)
                   for seed in range(1, options.seeds + 1)], options.at_once)
    return conclude(study, options)


def conclude(study, options):
    """Means, curves, figures, summary and checks of all rows; the exit code."""
    from softgrain import scatter_figures as figures

    means = {case: scatter.over_seeds([row for row in study.done() if row["case"] == shown(case)])
             for case in cases(options)}
    curves = {case: scatter.mean_curves([study.path(scatter.curve_file(case, seed))
                                         for seed in range(1, options.seeds + 1)]) for case in cases(options)}
    scatter.write_curves(study.path("curves.csv"), curves)
    figures.draw(means, curves, study.path)
    for case, values in means.items():
        print(f"{case:28s}" + "   ".join(f"{name} {mean:.3f} +- {error:.3f}" for name, (mean, error) in values.items()))
    return runs.conclude(study, {**study.head(), "means": means, "criterion": jamming.CRITERION},
                         [study.enough_done("all")])


runs.main(main)
