# SPDX-License-Identifier: GPL-2.0-or-later
"""Compactions of the same discs, soft and rigid: where the rigid ones depart from the soft. Plain numpy."""
import math

import numpy

from . import jamming

OBSERVABLES = ("jamming_fraction", "jamming_strain", "deepest_overlap", "solid_fraction_end", "stress_end_Pa")
FACTOR = 1.5            # between stresses at the same solid fraction: more is a departure
OVERLAP = 0.05          # of rigid discs [radius of the smaller]: more is none of a rigid disc
WINDOW = 5              # rows, over which stresses are averaged: waves from the wall run through them


def file_of(case):
    """Name of the file with the curves of a case."""
    return "curves_" + "".join(letter if letter.isalnum() else "_" for letter in case) + ".csv"


def observables(table):
    """The OBSERVABLES of one run from its csv columns, a dict; nan where it does not jam."""
    point = jamming.jamming_point(table) or {"solid_fraction": math.nan, "strain": math.nan}
    return {"jamming_fraction": point["solid_fraction"], "jamming_strain": point["strain"],
            "deepest_overlap": float(table["max_penetration_over_R"].max()),
            "solid_fraction_end": float(table["solid_fraction"][-1]),
            "stress_end_Pa": float(smoothed_stress(table)[-1])}


def smoothed_stress(table):
    """Mean of both walls over WINDOW rows [Pa]."""
    stress = (table["stress_bottom_Pa"] + table["stress_top_Pa"]) / 2
    weight = numpy.convolve(numpy.ones_like(stress), numpy.ones(WINDOW), "same")
    return numpy.convolve(stress, numpy.ones(WINDOW), "same") / weight


def departures(tables):
    """Of each case but `soft`: the first solid fraction, from where both bear more than the stress of jamming, at which its
    stress is off that of the soft packing by FACTOR, and the first at which discs overlap by OVERLAP; None: never."""
    soft = tables["soft"]
    result = {}
    for case, table in tables.items():
        if case == "soft":
            continue
        stress = smoothed_stress(table)
        reference = numpy.interp(table["solid_fraction"], soft["solid_fraction"], smoothed_stress(soft))
        jammed = (stress > jamming.STRESS) | (reference > jamming.STRESS)
        ratio = numpy.maximum(stress, 1) / numpy.maximum(reference, 1)
        off = jammed & ((ratio > FACTOR) | (ratio < 1 / FACTOR))
        result[case] = {"stress": _first(table, off), "overlap": _first(table, table["max_penetration_over_R"] > OVERLAP)}
    return result


def said(departure):
    """One departure in words."""
    return "; ".join(f"{what} {f'from {value:.3f} on' if value is not None else 'never'}" for what, value in
                     ((f"stress off by a factor of {FACTOR}", departure["stress"]),
                      (f"overlaps over {OVERLAP:g} R", departure["overlap"])))


def _first(table, holds):
    rows = numpy.flatnonzero(holds)
    return float(table["solid_fraction"][rows[0]]) if len(rows) else None
