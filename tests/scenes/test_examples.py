# SPDX-License-Identifier: GPL-2.0-or-later
"""Every example, short, inside the real yade: exit code 0, the files, the csv columns, and figures from two runs."""
import os
import subprocess
import sys

import numpy

sys.path.insert(0, os.path.dirname(os.path.abspath(sys.argv[0])))
from scene_testing import EXAMPLES, Folder, run_example, run_tests, said  # noqa: E402
from softgrain.records import read_json, read_rows, read_table  # noqa: E402

COMPACTION = ("time_s,strain,solid_fraction,log_volume_change,stress_bottom_Pa,stress_top_Pa,coordination,rattlers,"
              "contacts,kinetic_J,elastic_J,external_work_J,friction_J,contact_dissipation_J,energy_residual_J,min_J,"
              "max_penetration_over_R,solver_iterations,solver_residual,dt_s,cpu_s")
SQUEEZE = ("squeeze,force_per_thickness_N_m,contact_half_width_m,area_ratio,half_width_m,solid_fraction,min_J,cpu_s")


def header(path):
    with open(path, encoding="ascii") as file:
        return file.readline().strip()


def compaction(checks):
    with Folder() as folder:
        for material in ("nh", "mr"):
            run = run_example(folder, "compaction.py", "--quick", "--material", material, "--out", material)
            checks.that(f"compaction --quick --material {material}", run.returncode == 0, said(run))
            out = os.path.join(folder, material)
            checks.that("columns", header(os.path.join(out, "compaction.csv")) == COMPACTION)
            for number in range(1, 6):
                path = os.path.join(out, f"figure{number}.png")
                checks.that(f"figure {number}", os.path.exists(path) and os.path.getsize(path) > 10000)
            table, summary = read_table(os.path.join(out, "compaction.csv")), read_json(os.path.join(out, "summary.json"))
            left = table["log_volume_change"]
            right = numpy.log(table["solid_fraction"] / 0.65) - table["strain"]
            checks.that("eq. 9 holds in every row", abs(left - right).max() < 1e-6, abs(left - right).max())
            checks.that("strain grows", (numpy.diff(table["strain"]) > 0).all())
            checks.that("time grows", (numpy.diff(table["time_s"]) > 0).all())
            checks.that("summary",
                        {"parameters", "seed", "versions", "jamming", "equation_10", "cost"} <= set(summary))
            checks.that("costs", {"cpu_s", "wall_s", "steps", "ns_per_point_step", "stage_share"}
                        <= set(summary["cost"]))
            work = table["external_work_J"][-1]
            impulses = table["stress_top_Pa"] * numpy.diff(table["time_s"], prepend=0)
            summed = numpy.sum(impulses) * summary["box"]["width_m"] * summary["parameters"]["speed"]
            checks.that("the work is that of the moving wall's force", abs(summed / work - 1) < 0.01, summed / work)
        figures_of_two_runs(checks, folder)


def figures_of_two_runs(checks, folder):
    """figures.py outside yade."""
    script = os.path.join(EXAMPLES, "figures.py")
    both = subprocess.run(["/usr/bin/python3", script, "nh", "mr", "--out", "both"], cwd=folder, capture_output=True,
                          text=True, check=False)
    checks.that("figures of two runs", both.returncode == 0 and len(os.listdir(os.path.join(folder, "both"))) == 5,
                both.stderr)
    none = subprocess.run(["/usr/bin/python3", script, "."], cwd=folder, capture_output=True, text=True, check=False)
    checks.that("figures of nothing", none.returncode == 2 and "Traceback" not in none.stderr, none.stderr)
    empty = subprocess.run(["/usr/bin/python3", script, "both"], cwd=folder, capture_output=True, text=True, check=False)
    checks.that("figures of a folder without a csv", empty.returncode == 2 and "both holds no csv file" in empty.stderr, empty.stderr)


def compaction_with_friction(checks):
    with Folder() as folder:
        run = run_example(folder, "compaction.py", "--quick", "--friction", "0.3", "--wall-friction", "0.3")
        checks.that("compaction --friction 0.3", run.returncode == 0, said(run))
        table = read_table(os.path.join(folder, "compaction", "compaction.csv"))
        checks.that("friction dissipates", table["friction_J"][-1] > 0.01 * table["external_work_J"][-1],
                    table["friction_J"][-1])
        checks.that("and never gives back", (numpy.diff(table["friction_J"]) >= -1e-9).all())


def squeeze(checks):
    with Folder() as folder:
        for material in ("nh", "mr"):
            run = run_example(folder, "squeeze.py", "--quick", "--material", material, "--out", material)
            checks.that(f"squeeze --quick --material {material}", run.returncode == 0, said(run))
            checks.that("columns", header(os.path.join(folder, material, "squeeze.csv")) == SQUEEZE)
        run = run_example(folder, "squeeze.py", "--quick", "--walls", "4", "--out", "four")
        checks.that("squeeze --walls 4", run.returncode == 0, said(run))
        table = read_table(os.path.join(folder, "four", "squeeze.csv"))
        wide = table["half_width_m"] / (1e-3 * (1 - table["squeeze"])) - 1
        checks.that("half-width is that of the square", abs(wide).max() < 5e-3, abs(wide).max())


def rigid_compaction(checks):
    with Folder() as folder:
        for law in ("yade", "cd"):
            run = run_example(folder, "rigid_compaction.py", "--quick", "--law", law, "--out", law)
            checks.that(f"rigid_compaction --quick --law {law}", run.returncode == 0, said(run))
            out = os.path.join(folder, law)
            checks.that("columns", header(os.path.join(out, "rigid_compaction.csv")) == COMPACTION)
            table = read_table(os.path.join(out, "rigid_compaction.csv"))
            checks.that("volume does not change", abs(table["log_volume_change"]).max() < 1e-12)


def soft_vs_rigid(checks):
    with Folder() as folder:
        run = run_example(folder, "soft_vs_rigid.py", "--quick", "--out", "both")
        checks.that("soft_vs_rigid --quick", run.returncode == 0, said(run))
        out = os.path.join(folder, "both")
        rows = {row["case"]: row for row in read_rows(os.path.join(out, "soft_vs_rigid.csv"))}
        checks.that("a row a run", len(rows) == 4, rows)
        checks.that("stiff and rigid discs jam alike",
                    abs(rows["rigid Contact Dynamics"]["jamming_fraction"]
                        - rows["Cundall-Strack 500 MPa"]["jamming_fraction"]) < 0.02,
                    rows)
        departures = read_json(os.path.join(out, "summary.json"))["departures"]
        checks.that("rigid discs depart from soft ones", all(departure["stress"] < 0.9 for departure in departures.values()),
                    departures)
        checks.that("figure", os.path.getsize(os.path.join(out, "figure1.png")) > 10000)


def packing_scatter(checks):
    with Folder() as folder:
        run = run_example(folder, "packing_scatter.py", "--quick", "--seeds", "2", "--grains", "12", "--out", "scatter")
        checks.that("packing_scatter --quick", run.returncode == 0, said(run))
        out = os.path.join(folder, "scatter")
        rows = read_rows(os.path.join(out, "packing_scatter.csv"))
        checks.that("a row a run", sorted((row["case"], row["seed"]) for row in rows)
                    == sorted((case, seed) for case in {row["case"] for row in rows} for seed in (1, 2)) and len(rows) == 6)
        for row in rows:
            checks.that("Z grows from jamming on", 2 < row["Z_end"] < 6, row)
        for number in (1, 2, 3):
            checks.that(f"figure {number}", os.path.getsize(os.path.join(out, f"figure{number}.png")) > 10000)
        curves = read_rows(os.path.join(out, "curves.csv"))
        checks.that("mean curves", len(curves) > 50 and all(row["coordination_deviation"] >= 0 for row in curves
                                                            if row["coordination_deviation"] == row["coordination_deviation"]))


def computed(checks, folder, example, rows, *options):
    """The table and the summary of an example, computed by --quick: its files are there, and its own checks hold."""
    run = run_example(folder, f"{example}.py", "--quick", *options, "--out", example)
    checks.that(f"{example} --quick", run.returncode == 0, said(run))
    checks.that(f"{example} says what is random", "seed" in run.stdout or "nothing random" in run.stdout, run.stdout[:200])
    out = os.path.join(folder, example)
    checks.that(f"figure of {example}", os.path.getsize(os.path.join(out, "figure1.png")) > 10000)
    table, summary = read_table(os.path.join(out, f"{example}.csv")), read_json(os.path.join(out, "summary.json"))
    checks.that(f"rows of {example}", rows is None or len(table["cpu_s"]) == rows, len(table["cpu_s"]))
    checks.that(f"checks of {example}", all(check["holds"] for check in summary["checks"]), summary["checks"])
    return table, summary


def mixed_packing(checks):
    with Folder() as folder:
        table, summary = computed(checks, folder, "mixed_packing", None)
        ends = {(packing["rigid_fraction"], packing["friction"]): packing for packing in summary["packings"]}
        checks.that("a packing a case", len(ends) == 6)
        for friction in (0.0, 0.4):
            fractions = [ends[rigid, friction]["fraction_at_100000_Pa"] for rigid in (0.0, 0.5, 1.0)]
            checks.that("rigid discs fill less at a stress", fractions[0] > fractions[1] > fractions[2], fractions)
        checks.that("friction keeps packings looser", all(ends[rigid, 0.4]["fraction_at_1e+06_Pa"] < ends[rigid, 0.0]["fraction_at_1e+06_Pa"]
                                                          for rigid in (0.0, 0.5)), ends)
        for case in ends:
            rows = (table["rigid_fraction"] == case[0]) & (table["friction"] == case[1])
            checks.that("strain grows", (numpy.diff(table["strain"][rows]) > 0).all())
            jammed = rows & (table["stress_Pa"] > 1e5)
            ratio = table["contact_stress_Pa"][jammed].sum() / table["stress_Pa"][jammed].sum()
            checks.that(f"{case}: contacts bear what the walls measure", case[0] == 1 or abs(ratio - 1) < 0.02, ratio)


def heavy_ball(checks):
    with Folder() as folder:
        table, summary = computed(checks, folder, "heavy_ball", 160)
        checks.that("it falls in", 0.5e-3 < summary["deepest_m"] < 20e-3, summary["deepest_m"])
        checks.that("its speed is that of the fall", abs(summary["impact"]["speed_m_s"] - (2 * 9.81 * 0.05)**0.5) < 1e-6)
        weight = 8000 * numpy.pi * (4e-3)**2 * 9.81
        checks.that("grains push harder than its weight", summary["largest_force_N_m"] > 3 * weight, summary)
        checks.that("what is dissipated grows", all((numpy.diff(table[name]) >= -1e-9).all() for name in
                                                    ("friction_J", "viscous_dissipation_J")))


def funnel(checks):
    with Folder() as folder:
        table, summary = computed(checks, folder, "funnel", 150)
        summed = numpy.sum(table["force_N_m"] * numpy.diff(table["way_m"], prepend=0))
        checks.that("the work is that of the box's force", abs(summed / summary["work_J_m"] - 1) < 0.01, summed)
        checks.that("force rises until the grain slips", table["force_N_m"].argmax() > 20)
        again = run_example(folder, "funnel.py", "--quick", "--opening", "1.2")
        checks.that("an opening that is none", again.returncode == 2 and "--opening 1.2" in again.stderr, said(again))


def drum(checks):
    with Folder() as folder:
        table, summary = computed(checks, folder, "drum", 200)
        checks.that("grains climb with the drum first", table["slope_deg"][60] > table["slope_deg"][0] + 10, table["slope_deg"][:60:10])
        checks.that("the drum drives them", summary["torque_N"] > 0)


run_tests(compaction, compaction_with_friction, squeeze, rigid_compaction, soft_vs_rigid, packing_scatter, mixed_packing, heavy_ball,
          funnel, drum)
