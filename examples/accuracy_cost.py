# SPDX-License-Identifier: GPL-2.0-or-later
"""What accuracy costs in time: a work-precision study of squeeze.py and compaction.py.

    yade -n -x examples/accuracy_cost.py [options]          --help lists them

Each method runs over the points per grain, each other knob at 276 points, and points, surface spacing and tolerance
together, in two cases:

  grain    one disc between plates, force and area against finite elements, for several orientations of its grid
  packing  about 60 discs, pressed to solid fraction 0.98; stress, coordination and volume change, means over 0.92 to
           0.98, against the finest run of the same seed; means over seeds, since single packings are chaotic

Writes accuracy_cost.csv, one row a run (columns: doc/conventions.md), figure1.png to figure5.png, summary.json and
accuracy.json into --out: the table behind `accuracy=` of softDisc, softCloud and softEngines, when it stands in py/.
--resume computes only what is missing. Times are CPU seconds of a run, start of YADE and figures left out; all numbers
are doubles, no other type is offered.
"""
import datetime
import itertools
import math
import os
import subprocess
import sys

from softgrain import options as opt, presets, runs, work_precision
from softgrain.checks import InputError
from softgrain.records import write_json
from softgrain.study import Job, Study, read_options as read_study

HERE = os.path.dirname(os.path.abspath(sys.argv[0]))
REFERENCE = os.path.join(os.path.dirname(HERE), "tests", "verification", "reference", "A_plates_{}.csv")
KNOBS = ("material", "points", "surface_spacing", "safety", "dt_s", "tolerance", "locking_cure", "formulation",
         "integrator")
COLUMNS = ["case", *KNOBS, "sample", *work_precision.OBSERVABLES, "steps", "cpu_s", "status"]
BASE = {"material": "nh", "points": 276, "surface_spacing": 1.0, "safety": 0.8, "dt_s": math.nan, "tolerance": 1e-3,
        "locking_cure": "on", "formulation": "total", "integrator": "explicit"}
# A line of the diagrams each: what differs from BASE, the points it runs with on one grain and in packings, and the most
# packings. Another method is another row.
METHODS = {
    "total form": ({}, (60, 124, 276, 556, 1100, 2200), (60, 124, 276, 556), 99),
    "total form, step 0.1 µs": ({"dt_s": 1e-7}, (60, 124, 276), (60, 124), 99),
    "without cure of locking": ({"locking_cure": "off"}, (60, 124, 276, 556), (60, 124, 276), 99),
    "implicit": ({"integrator": "implicit"}, (60, 124, 276, 556, 1100), (60, 124, 276), 99),
    "quasi-static": ({"integrator": "quasistatic"}, (60, 124, 276, 556, 1100, 2200), (60, 124), 99),
    "updated form": ({"formulation": "updated"}, (60, 124, 276), (60, 124), 3),
    "updated form, step 0.1 µs": ({"formulation": "updated", "dt_s": 1e-7}, (60, 124, 276), (60,), 2),
    "updated form, implicit": ({"formulation": "updated", "integrator": "implicit"}, (60, 124, 276), (60, 124), 99),
}
# One knob at a time: its values besides that of BASE, and what else differs from BASE.
SWEEPS = {
    "surface spacing / cell width": ("surface_spacing", (0.5, 0.7, 1.4), {}),
    "time step / stable step": ("safety", (0.2, 0.5, 0.9), {}),
    "tolerance of the contact solver": ("tolerance", (1e-1, 1e-2, 1e-5), {}),
    "implicit step [s]": ("dt_s", (5e-6, 2e-5, 1e-4), {"integrator": "implicit"}),
}
# All together: what the presets are chosen from, besides the total form with MANY points, of which one packing tells the
# cost. On one grain with both materials.
TOGETHER = {"points": (60, 124, 276, 556), "surface_spacing": (0.7, 1.0), "safety": (0.8,), "tolerance": (1e-2, 1e-3)}
MANY = (1100, 2200)
FINEST = {"points": 1100, "tolerance": 1e-4}
MARGIN = 1.5    # largest error of orientations that were not tried, over that of those that were
PRESETS = {"draft": 0.1, "standard": 0.03, "fine": 0.01}
QUICK = {"grains": 12, "seeds": 2, "orientations": 1}


def read_options():
    parser = opt.Parser("accuracy_cost", "What accuracy costs in time: errors against CPU seconds.")
    scene = parser.add_argument_group("the study")
    scene.add_argument("--grains", type=opt.count, default=60, metavar="N", help="discs of a packing")
    scene.add_argument("--seeds", type=opt.count, default=4, metavar="N", help="packings of each setting")
    scene.add_argument("--orientations", type=opt.count, default=3, metavar="N",
                       help="orientations of the grid of one grain of each setting")
    return read_study(parser, scene, QUICK, "a small study: few points,")


def setting(**changes):
    """BASE with other values of some knobs."""
    return {**BASE, **changes}


def together(quick):
    """Neo-Hookean settings that the presets may be chosen from."""
    axes = {**TOGETHER, **({"points": (60, 124)} if quick else {})}
    return ([setting(**dict(zip(axes, values))) for values in itertools.product(*axes.values())]
            + [setting(points=n) for n in ((276,) if quick else MANY)])


def lines(quick):
    """The lines of the diagrams: name -> (settings on one grain, settings in packings, most packings)."""
    def few(points):
        return [n for n in points if n <= 124 or not quick]

    result = {}
    for name, (changes, grain, packing, most) in METHODS.items():
        result[name] = ([setting(**changes, points=n) for n in few(grain)],
                        [setting(**changes, points=n) for n in few(packing)], most)
    for name, (knob, values, changes) in SWEEPS.items():
        chosen = {*values[::2 if quick else 1], BASE[knob]} - {math.nan}
        swept = [setting(**changes, **{knob: value}) for value in sorted(chosen)]
        result[name] = (swept, swept, 99)
    return result


def finest(quick):
    """The setting that packings are compared with."""
    return setting(**{**FINEST, **({"points": 556} if quick else {})})


def all_jobs(options):
    """Every run once."""
    quick, jobs = options.quick, {}

    def add(case, knobs, count):
        for sample in range(1, count + 1):
            job = make_job(case, knobs, sample, options)
            jobs.setdefault(tuple(map(str, job.key.values())), job)

    for on_grain, in_packing, most in lines(quick).values():
        for knobs in on_grain:
            add("grain", knobs, options.orientations)
        for knobs in in_packing:
            add("packing", knobs, min(most, options.seeds))
    for knobs in together(quick):
        for material in ("nh", "mr"):
            add("grain", {**knobs, "material": material}, options.orientations)
        add("packing", knobs, 1 if knobs["points"] in MANY else options.seeds)
    add("packing", finest(quick), options.seeds)
    return list(jobs.values())


def make_job(case, knobs, sample, options):
    """The run of one setting. sample: the seed of a packing, or the number of the orientation of a grain's grid."""
    arguments = ["--material", knobs["material"], "--points", knobs["points"], "--surface-spacing",
                 knobs["surface_spacing"], "--safety", knobs["safety"], "--tolerance", knobs["tolerance"],
                 "--locking-cure", knobs["locking_cure"], "--formulation", knobs["formulation"],
                 *(["--quasistatic"] if knobs["integrator"] == "quasistatic" else ["--integrator", knobs["integrator"]])]
    if not math.isnan(knobs["dt_s"]):
        arguments += ["--dt", knobs["dt_s"]]
    if case == "grain":
        script, read = "squeeze.py", lambda folder: work_precision.of_grain(folder, reference(knobs["material"]))
        arguments += ["--angle", (sample - 1) * 0.7, "--speed", 0.5 if options.quick else 0.2]
    else:
        script, read = "compaction.py", work_precision.of_packing
        arguments += ["--grains", options.grains, "--seed", sample, "--solid-fraction", 0.7, "--until",
                      work_precision.FRACTIONS[1] + 0.005, "--no-figures"]
    return Job({"case": case, **knobs, "sample": sample}, os.path.join(HERE, script), arguments, read,
               expected_seconds(case, knobs))


def expected_seconds(case, knobs):
    """CPU time of a run, roughly: it orders the runs and tells the time to go."""
    share = knobs["points"] / 276
    stable = 5e-7 / math.sqrt(share)
    slower = 0.8 / knobs["safety"] if math.isnan(knobs["dt_s"]) else max(stable / knobs["dt_s"], 1)
    grain, packing = {"explicit": (0.5, 2.7), "implicit": (0.5, 8), "quasistatic": (0.5, 20)}[knobs["integrator"]]
    if knobs["formulation"] == "updated":
        grain, packing = (5 * grain, 30 * packing) if knobs["integrator"] == "explicit" else (2 * grain, 2 * packing)
    return 2 + share**1.4 * slower * (grain if case == "grain" else packing / knobs["surface_spacing"])


def reference(material):
    """Path of the finite-element forces of nh or mr."""
    return REFERENCE.format(material.upper())


def main():
    options = read_options()
    for material in ("nh", "mr"):
        if not os.path.exists(reference(material)):
            raise InputError(f"the finite-element forces {reference(material)} are not there: run the example from the "
                             "source tree.")
    opt.use_threads(options.threads)
    study = Study("accuracy_cost", options, COLUMNS)
    study.memory.setdefault("commit", commit())
    study.compute(all_jobs(options), options.at_once)
    return conclude(study, options)


def table_of_presets(study, options, measured):
    """What py/accuracy.json says: of all settings that were tried together, those that none beats in error and cost."""
    candidates = []
    for knobs in together(options.quick):
        grains = [measured.grain({**knobs, "material": material}) for material in ("nh", "mr")]
        packing = measured.packing(knobs)
        if all(grains) and packing:
            bias, spread = packing["stress"]
            error = MARGIN * max(grain["force_worst"] for grain in grains)
            if not math.isnan(spread):      # packings count where they show more than their scatter
                error = max(error, abs(bias) - 2 * spread)
            error = rounded_up(error)
            candidates.append((packing["cpu_s"], error, {
                **{name: knobs[name] for name in presets.CHOSEN}, "error": error, "packing_cpu_s": packing["cpu_s"],
                "packing_stress_bias": bias, "packing_stress_spread": spread}))
    kept = [chosen for _, _, chosen in work_precision.front(candidates)]
    return {"date": datetime.date.today().isoformat(), "commit": study.memory["commit"],
            "command": f"yade -n -x examples/accuracy_cost.py --grains {options.grains} --seeds {options.seeds} "
                       f"--orientations {options.orientations}" + (" --quick" if options.quick else ""),
            "error": f"{MARGIN:g} times the largest relative error of the force between plates at 5 to 40 % squeeze "
                     "against finite elements, Neo-Hookean and Mooney-Rivlin, over the orientations of the grid; or what "
                     "the stress of packings lacks against their finest runs, less twice its standard error, where that is "
                     "more",
            "names": PRESETS, "settings": kept}, candidates


def rounded_up(error):
    """To two digits: smaller differences are no reason to choose."""
    unit = 10.0 ** (math.floor(math.log10(error)) - 1)
    return float(f"{math.ceil(error / unit) * unit:.2g}")


def commit():
    """Of the source tree, with + when files were changed since."""
    def git(*words):
        return subprocess.run(["git", "-C", HERE, *words], capture_output=True, text=True, check=False).stdout.strip()

    return (git("rev-parse", "--short", "HEAD") or "unknown") + ("+" if git("status", "--porcelain", "-uno") else "")


def conclude(study, options):
    """Table, figures, summary and checks of all rows; the exit code."""
    from softgrain import work_precision_figures as figures

    measured = work_precision.Measured(study.done(), KNOBS, finest(options.quick))
    drawn = {name: (grain, packing) for name, (grain, packing, _) in lines(options.quick).items()}
    table, candidates = table_of_presets(study, options, measured)
    write_json(study.path("accuracy.json"), table)
    figures.draw(measured, {name: drawn[name] for name in METHODS},
                 {name: (knob, *drawn[name]) for name, (knob, _, _) in SWEEPS.items()},
                 BASE, candidates, table, study.path)
    errors = {name: {"grain": [measured.grain(knobs) for knobs in grain],
                     "packing": [measured.packing(knobs) for knobs in packing]} for name, (grain, packing) in drawn.items()}
    best = min(chosen["error"] for chosen in table["settings"])
    most = 0.05 if options.quick else 0.03      # the quick study has no more than 276 points
    return runs.conclude(study, {**study.head(), "errors": errors}, [
        study.enough_done("19 of 20", 0.05),
        (f"the finest of all settings is within {most:.0%} of finite elements ({best:.2%})", best < most)])


runs.main(main)
