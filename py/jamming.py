# SPDX-License-Identifier: GPL-2.0-or-later
"""Where a compaction jams, and how the coordination number grows beyond (Vu et al. 2017, eq. 10). Plain numpy: also
read by figures.py outside YADE."""
import numpy

STRESS = 20e3                        # on the bottom wall [Pa]: beyond it the packing is called jammed
WINDOW = 0.01                        # of strain, over which the stress is averaged: waves from the wall run through it
CRITERION = "stress on the bottom wall, mean over 0.01 of strain, first over 20 kPa, interpolated between output rows"
EXPONENT = 0.5                       # of eq. 10
FURTHER = (0.01, 0.02)               # eq. 10 is also shown for phi0 this much beyond jamming: it is a choice


def jamming_point(table):
    """Strain, solid fraction, stress at jamming, interpolated in the averaged stress between the two rows about it, and
    the coordination of the first row from there on in which grains carry force; a dict with also the row, or None when
    the run does not jam. `table` maps csv columns to arrays."""
    strain = table["strain"]
    stress = numpy.array([table["stress_bottom_Pa"][numpy.abs(strain - middle) <= WINDOW / 2].mean() for middle in strain])
    over = numpy.flatnonzero(stress > STRESS)
    if not len(over):
        return None
    row = int(over[0])
    share = 1.0 if row == 0 else (STRESS - stress[row - 1]) / (stress[row] - stress[row - 1])

    def between(column):
        before, after = table[column][max(row - 1, 0)], table[column][row]
        return float(before + share * (after - before))

    known = table["coordination"][row:]
    known = known[numpy.isfinite(known)]
    return {"row": row, "strain": between("strain"), "solid_fraction": between("solid_fraction"),
            "coordination": float(known[0]) if len(known) else None, "stress_Pa": STRESS, "criterion": CRITERION}


def normalised_growth(table, fraction0, fraction1=None):
    """Both sides of eq. 10 for a chosen phi0: (Z - Z0)/(Z1 - Z0) against (phi - phi0)/(phi1 - phi0), from phi0 to phi1
    (default: the last row). Z0, Z1 are means over the rows within 0.005 of phi0, phi1, since Z of one row scatters.
    Returns a dict with x, y and residual, the root mean square of y - x^0.5; None when there are too few rows."""
    known = numpy.isfinite(table["coordination"])
    fraction, count = table["solid_fraction"][known], table["coordination"][known]
    if len(fraction) < 5:
        return None
    fraction1 = float(fraction[-1]) if fraction1 is None else fraction1
    if fraction1 - fraction0 < 0.02:
        return None
    count0, count1 = (_near(fraction, count, end) for end in (fraction0, fraction1))
    if not count1 - count0 > 0.1:
        return None
    inside = (fraction >= fraction0) & (fraction <= fraction1)
    if inside.sum() < 3:
        return None
    x = (fraction[inside] - fraction0) / (fraction1 - fraction0)
    y = (count[inside] - count0) / (count1 - count0)
    residual = float(numpy.sqrt(numpy.mean((y - x**EXPONENT)**2)))
    return {"phi0": fraction0, "phi1": fraction1, "Z0": count0, "Z1": count1, "residual": residual,
            "best_exponent": _best_exponent(x, y), "x": x, "y": y}


def growth_fits(table):
    """normalised_growth for phi0 at jamming and FURTHER beyond it: list of dicts, jamming first."""
    point = jamming_point(table)
    if point is None:
        return []
    fits = [normalised_growth(table, point["solid_fraction"] + shift) for shift in (0.0, *FURTHER)]
    return [fit for fit in fits if fit]


def _near(fraction, count, place):
    """Mean of the counts whose fraction is within 0.005 of the place, or the count nearest to it."""
    near = count[abs(fraction - place) <= 0.005]
    return float(near.mean() if len(near) else count[numpy.argmin(abs(fraction - place))])


def _best_exponent(x, y):
    """The b of y = x^b with the smallest root mean square error, between 0.1 and 2."""
    exponents = numpy.arange(0.1, 2.0, 0.01)
    errors = [numpy.mean((y - x**exponent)**2) for exponent in exponents]
    return round(float(exponents[int(numpy.argmin(errors))]), 2)
