# SPDX-License-Identifier: GPL-2.0-or-later
"""What a work-precision study measures in a run, and the errors that follow from its rows."""
import math
import os

import numpy

from .records import read_json, read_table, shown
from .scatter import mean_and_error

OBSERVABLES = ["force_rms_error", "force_worst_error", "area_error", "stress_Pa", "coordination", "log_volume_change",
               "energy_residual_over_work", "deepest_penetration_over_R", "min_J"]
SQUEEZES = (0.05, 0.40)     # of one grain, where forces are compared
FRACTIONS = (0.92, 0.98)    # solid fractions of a packing over which its observables are averaged


def of_grain(folder, reference):
    """Observables of a squeeze between plates. Errors are relative to the finite elements in the file `reference`:
    root mean square and largest error of the force; root mean square error of the area over the area lost."""
    table, summary, true = read_table(os.path.join(folder, "squeeze.csv")), _summary(folder), read_table(reference)
    inside = (table["squeeze"] >= SQUEEZES[0] - 1e-9) & (table["squeeze"] <= SQUEEZES[1] + 1e-9)
    at = table["squeeze"][inside]
    force = table["force_per_thickness_N_m"][inside] / _cubic(true["squeeze"], true["F_N_per_m"], at) - 1
    area = _cubic(true["squeeze"], true["A_over_A0"], at)
    area_error = (table["area_ratio"][inside] - area) / (1 - area)
    return {"force_rms_error": _rms(force), "force_worst_error": float(abs(force).max()),
            "area_error": _rms(area_error), "energy_residual_over_work": abs(summary["energy_missing_over_work"]),
            "deepest_penetration_over_R": summary["deepest_penetration"], "min_J": float(table["min_J"].min()),
            **_cost(summary)}


def of_packing(folder):
    """Observables of the compaction in a folder: means over FRACTIONS, which it has to reach; the stress is the mean of
    bottom and top."""
    table, summary = read_table(os.path.join(folder, "compaction.csv")), _summary(folder)
    at = numpy.linspace(*FRACTIONS, 61)
    table["stress_Pa"] = (table["stress_bottom_Pa"] + table["stress_top_Pa"]) / 2
    means = {name: float(numpy.interp(at, table["solid_fraction"], table[name]).mean())
             for name in ("stress_Pa", "coordination", "log_volume_change")}
    return {**means, "energy_residual_over_work": summary["energy_residual_over_work"],
            "deepest_penetration_over_R": summary["deepest_penetration"], "min_J": float(table["min_J"].min()),
            **_cost(summary)}


class Measured:
    """The rows of those runs of a study that have a result, by setting: a dict of knobs. A setting without such a run has
    None for errors."""

    def __init__(self, rows, knobs, finest):
        self._knobs, self._rows = knobs, {}
        for row in rows:
            self._rows.setdefault((row["case"], self._name(row)), []).append(row)
        self._finest = {row["sample"]: row for row in self._of("packing", finest)}

    def grain(self, setting):
        """Errors on one grain and the mean CPU time, over the orientations of the grid."""
        rows = self._of("grain", setting)
        return rows and {"force": _rms([row["force_rms_error"] for row in rows]),
                         "force_worst": max(row["force_worst_error"] for row in rows),
                         "area": _rms([row["area_error"] for row in rows]), **_common(rows)} or None

    def packing(self, setting):
        """Errors of packings against the finest runs of the same seeds: of each observable (mean difference, standard
        error of this mean), relative to the finest mean; of the coordination absolute."""
        pairs = [(row, self._finest[row["sample"]]) for row in self._of("packing", setting)
                 if row["sample"] in self._finest]
        if not pairs:
            return None
        errors = {}
        for name, column in (("stress", "stress_Pa"), ("coordination", "coordination"), ("volume", "log_volume_change")):
            scale = 1 if name == "coordination" else abs(numpy.mean([true[column] for _, true in pairs]))
            errors[name] = mean_and_error(numpy.array([row[column] - true[column] for row, true in pairs]) / scale)
        return {**errors, **_common([row for row, _ in pairs])}

    def _of(self, case, setting):
        return self._rows.get((case, self._name(setting)), [])

    def _name(self, setting):
        return tuple(shown(setting[knob]) for knob in self._knobs)


def front(points):
    """Those (cost, error, ...) that no other one beats in both, from the cheapest on."""
    best, kept = math.inf, []
    for point in sorted(points, key=lambda point: point[:2]):
        if point[1] < best:
            best = point[1]
            kept.append(point)
    return kept


def _common(rows):
    return {"cpu_s": float(numpy.mean([row["cpu_s"] for row in rows])), "samples": len(rows),
            "energy": max(row["energy_residual_over_work"] for row in rows),
            "penetration": max(row["deepest_penetration_over_R"] for row in rows)}


def _cost(summary):
    return {"steps": summary["cost"]["steps"], "cpu_s": summary["cost"]["cpu_s"]}


def _summary(folder):
    return read_json(os.path.join(folder, "summary.json"))


def _cubic(x, y, at):
    """Cubics through the two rows on either side: straight lines between forces 1 % of squeeze apart are off by 0.2 %."""
    result = numpy.zeros(len(at))
    for k, place in enumerate(at):
        first = min(max(int(numpy.searchsorted(x, place)) - 2, 0), len(x) - 4)
        near = x[first:first + 4]
        for i in range(4):
            others = numpy.delete(near, i)
            result[k] += y[first + i] * numpy.prod((place - others) / (near[i] - others))
    return result


def _rms(values):
    return float(numpy.sqrt(numpy.mean(numpy.square(values))))
