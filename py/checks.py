# SPDX-License-Identifier: GPL-2.0-or-later
"""Checks of input. Each failure is one sentence that names the object, the value and the fix."""
import math


class InputError(ValueError):
    """A value that a person gave and can mend; its text is one sentence."""


def number(what, value, unit=""):
    """The value as a finite float, or InputError."""
    try:
        result = float(value)
    except (TypeError, ValueError):
        raise InputError(f"{what} is {value!r}, which is not a number: give a number{_in(unit)}.") from None
    if not math.isfinite(result):
        raise InputError(f"{what} is {value!r}: give a finite number{_in(unit)}.")
    return result


def positive(what, value, unit=""):
    """The value as a float above zero, or InputError."""
    result = number(what, value, unit)
    if result <= 0:
        raise InputError(f"{what} is {value!r}: give a number above zero{_in(unit)}.")
    return result


def not_negative(what, value, unit=""):
    """The value as a float of at least zero, or InputError."""
    result = number(what, value, unit)
    if result < 0:
        raise InputError(f"{what} is {value!r}: give zero or a positive number{_in(unit)}.")
    return result


def whole(what, value, least, most=None):
    """The value as an int of at least `least` and at most `most`, or InputError."""
    result = number(what, value)
    if result != int(result) or result < least or (most is not None and result > most):
        raise InputError(f"{what} is {value!r}: give a whole number of at least {least}"
                         f"{'' if most is None else f' and at most {most}'}.")
    return int(result)


def position(what, value, unit="m"):
    """Three finite coordinates as a tuple of floats (the third may be left out and is 0), or InputError."""
    try:
        parts = [value[i] for i in range(len(value))]
    except TypeError:
        raise InputError(f"{what} is {value!r}: give two or three coordinates{_in(unit)}.") from None
    if len(parts) not in (2, 3):
        raise InputError(f"{what} has {len(parts)} coordinates: give two or three{_in(unit)}.")
    x, y = (number(f"{what} ({axis})", part, unit) for axis, part in zip("xy", parts))
    z = number(f"{what} (z)", parts[2], unit) if len(parts) == 3 else 0.0
    return x, y, z


def in_plane(what, value, unit=""):
    """A vector (x, y) or (x, y, 0) as a tuple of three floats, or InputError."""
    x, y, z = position(what, value, unit)
    if z != 0:
        raise InputError(f"{what} has the z component {z:g}: give zero, soft grains move in the xy-plane.")
    return x, y, z


def _in(unit):
    return f" in {unit}" if unit else ""
