# SPDX-License-Identifier: GPL-2.0-or-later
"""What packings of several seeds have in common: observables of each, means, standard errors, mean curves."""
import math

import numpy

from . import jamming
from .records import read_table, write_table

REACH = 0.1             # of solid fraction beyond jamming, over which k is fitted
COLUMNS = ("strain", "coordination", "stress_bottom_Pa", "log_volume_change")   # of the mean curves
STEP = 0.005            # of solid fraction between their rows
# Of one run. jamming_*: at the stress criterion; Z0: there; k: of Z - Z0 = k (phi - phi0)^0.5 by least squares; exponent:
# the best b of eq. 10 for phi0 at jamming, and 0.01 and 0.02 beyond it; *_end: at the last row
OBSERVABLES = ("jamming_fraction", "jamming_strain", "Z0", "k", "exponent", "exponent_1", "exponent_2", "Z_end",
               "log_volume_change_end")


def observables(table):
    """The OBSERVABLES of one run from its csv columns, a dict; nan for what it does not reach."""
    point = jamming.jamming_point(table)
    result = dict.fromkeys(OBSERVABLES, math.nan)
    result.update(Z_end=float(table["coordination"][-1]), log_volume_change_end=float(table["log_volume_change"][-1]))
    if point is None:
        return result
    result.update(jamming_fraction=point["solid_fraction"], jamming_strain=point["strain"])
    growth = jamming.growth_fits(table)
    for name, fit in zip(("exponent", "exponent_1", "exponent_2"), growth):
        result[name] = fit["best_exponent"]
    if growth:
        result["Z0"] = growth[0]["Z0"]
        result["k"] = _prefactor(table, point["solid_fraction"], growth[0]["Z0"])
    return result


def _prefactor(table, fraction0, count0):
    """k of Z - count0 = k (phi - fraction0)^0.5 over REACH, by least squares."""
    beyond = table["solid_fraction"] - fraction0
    used = (beyond > 0) & (beyond <= REACH) & numpy.isfinite(table["coordination"])
    root = numpy.sqrt(beyond[used])
    return float(root @ (table["coordination"][used] - count0) / (root @ root))


def over_seeds(rows):
    """Observable -> (mean, standard error of the mean), of the rows in which it is a number."""
    result = {}
    for name in OBSERVABLES:
        values = numpy.array([row[name] for row in rows if math.isfinite(row[name])])
        if len(values):
            result[name] = mean_and_error(values)
    return result


def mean_and_error(values):
    """Mean of an array and the standard error of it, nan for a single value."""
    return float(values.mean()), float(_deviation(values)) / math.sqrt(len(values))


def _deviation(values):
    """Standard deviation over the first axis, nan for a single value."""
    return values.std(axis=0, ddof=1) if len(values) > 1 else numpy.full(values.shape[1:], math.nan)


def curve_file(case, seed):
    """Name of the file with the curves of one run."""
    return "curve-" + "".join(letter if letter.isalnum() else "-" for letter in case.lower()) + f"-{seed}.csv"


def keep(table, path):
    """Writes solid_fraction and COLUMNS of a run."""
    names = ("solid_fraction", *COLUMNS)
    write_table(path, names, numpy.stack([table[name] for name in names], axis=1).tolist())


def mean_curves(paths):
    """Column -> arrays (solid fraction, mean, standard deviation over the runs), where all runs are."""
    tables = [read_table(path) for path in paths]
    first = max(table["solid_fraction"][0] for table in tables)
    last = min(table["solid_fraction"][-1] for table in tables)
    fraction = STEP * numpy.arange(math.ceil(first / STEP), math.floor(last / STEP) + 1)
    result = {}
    for name in COLUMNS:
        values = numpy.array([numpy.interp(fraction, table["solid_fraction"], table[name]) for table in tables])
        result[name] = (fraction, values.mean(axis=0), _deviation(values))
    return result


def write_curves(path, curves):
    """Writes the mean curves of all cases to one csv file: solid_fraction, and each of COLUMNS with its deviation."""
    rows = []
    for case, columns in curves.items():
        fraction = columns[COLUMNS[0]][0]
        values = numpy.stack([fraction, *(values for name in COLUMNS for values in columns[name][1:])], axis=1)
        rows += [[case, *row] for row in values.tolist()]
    write_table(path, ["case", "solid_fraction", *(f"{name}{end}" for name in COLUMNS for end in ("", "_deviation"))], rows)
