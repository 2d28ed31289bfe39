# SPDX-License-Identifier: GPL-2.0-or-later
"""One cloud of discs, compacted soft and rigid: where does rigid DEM stop being true?

    yade -n -x examples/soft_vs_rigid.py [options]          --help lists them

    soft                   compaction.py: grains that deform, Contact Dynamics
    Cundall-Strack         rigid_compaction.py: YADE's rigid discs with a stiff contact, and with one as soft as the grains are
                           between plates at a tenth of squeeze
    Contact Dynamics       rigid_compaction.py --law cd: rigid discs, no overlap

The solid fraction of rigid discs counts where they overlap twice, and that of soft ones does not. Writes the curves of every
run (columns of rigid_compaction.csv), soft_vs_rigid.csv with a row a run, figure1.png and summary.json into --out. --resume
computes only what is missing.
"""
import os
import shutil
import sys

from softgrain import comparison, options as opt, runs
from softgrain.records import read_json, read_table
from softgrain.study import Job, Study, read_options as read_study

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
SOFT, RIGID = "compaction.py", "rigid_compaction.py"
BEYOND = ["--until", 0.98, "--stress-limit", 1e9]     # rigid discs that overlap as far as soft grains are pressed
# A case: the example, its options, and the seconds a run of 300 grains takes.
CASES = {
    "soft": (SOFT, ["--points", 124], 15),
    "Cundall-Strack 500 MPa": (RIGID, ["--stiffness", 5e8, "--until", 0.9, "--stress-limit", 1e7], 10),
    "Cundall-Strack 4 MPa": (RIGID, ["--stiffness", 4e6, *BEYOND], 5),
    "rigid Contact Dynamics": (RIGID, ["--law", "cd", "--until", 0.9, "--stress-limit", 1e7], 10),
}
QUICK = {"grains": 40}
COLUMNS = ["case", *comparison.OBSERVABLES, "cpu_s", "status"]


def read_options():
    parser = opt.Parser("soft_vs_rigid", "One cloud of discs, compacted soft and rigid.")
    scene = parser.add_argument_group("the study")
    scene.add_argument("--grains", type=opt.count, default=300, metavar="N", help="number of discs")
    scene.add_argument("--friction", type=opt.not_negative, default=0.0, metavar="MU", help="between grains")
    scene.add_argument("--speed", type=opt.positive, default=0.5, metavar="V", help="of the top wall [m/s]")
    scene.add_argument("--seed", type=opt.seed, default=1, metavar="N", help="of sizes and places")
    return read_study(parser, scene, QUICK, "small:")


def make_job(study, case, options):
    """The run of one case."""
    script, words, cost = CASES[case]
    arguments = [*words, "--grains", options.grains, "--friction", options.friction, "--speed", options.speed,
                 "--seed", options.seed, "--no-figures"]

    def read(folder):
        name = script[:-len(".py")]
        shutil.copyfile(os.path.join(folder, f"{name}.csv"), study.path(comparison.file_of(case)))
        table = read_table(study.path(comparison.file_of(case)))
        return {**comparison.observables(table), "cpu_s": read_json(os.path.join(folder, "summary.json"))["cost"]["cpu_s"]}

    return Job({"case": case}, os.path.join(HERE, script), arguments, read, cost * options.grains / 300)


def main():
    options = read_options()
    opt.use_threads(options.threads)
    study = Study("soft_vs_rigid", options, COLUMNS)
    study.compute([make_job(study, case, options) for case in CASES], options.at_once)
    return conclude(study)


def conclude(study):
    """Departures from the soft packing, figure, summary and checks of all rows; the exit code."""
    from softgrain import comparison_figure

    rows = {row["case"]: row for row in study.done()}
    tables = {case: read_table(study.path(comparison.file_of(case))) for case in CASES if case in rows}
    departures = comparison.departures(tables) if "soft" in tables else {}
    comparison_figure.draw(tables, departures, rows, study.path("figure1.png"))
    for case, row in rows.items():
        text = comparison.said(departures[case]) if case in departures else ""
        print(f"{case:26s} jams at {row['jamming_fraction']:.3f}   {row['cpu_s']:7.1f} CPU s   {text}")
    return runs.conclude(study, {**study.head(), "departures": departures}, [study.enough_done("all")])


runs.main(main)
