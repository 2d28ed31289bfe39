# SPDX-License-Identifier: GPL-2.0-or-later
"""Points, surface spacing, time step and tolerance for an accuracy, from a table of measured errors: accuracy.json beside
this file, which examples/accuracy_cost.py writes.

An accuracy is the largest relative error of the wall stress of one disc, squeezed by 5 to 40 % between plates, against
finite elements, over the materials and grid orientations of the study; or a name of such a number."""
import os

from .checks import InputError, positive
from .records import read_json

TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "accuracy.json")
CHOSEN = ("points", "surface_spacing", "safety", "tolerance")


def table():
    """The whole table: date, commit, names, and settings from the cheapest to the most accurate."""
    return read_json(TABLE)


def settings(name, accuracy):
    """The cheapest measured settings whose error is no larger: dict with CHOSEN, error and cost. `name` says in messages
    who asks. Raises InputError."""
    known = table()
    names = known["names"]
    if isinstance(accuracy, str):
        if accuracy not in names:
            raise InputError(f"{name}: accuracy '{accuracy}' is none: give {', '.join(repr(word) for word in names)} or "
                             "a number such as 0.01.")
        accuracy = names[accuracy]
    allowed = positive(f"{name}: accuracy", accuracy)
    for chosen in known["settings"]:
        if chosen["error"] <= allowed:
            return chosen
    raise InputError(f"{name}: accuracy is {allowed:g}, but the finest settings that were measured reach "
                     f"{known['settings'][-1]['error']:.2g}: give that or more, or choose points and the rest yourself.")


def refuse_both(name, accuracy, given):
    """InputError when some of what the accuracy chooses is given too."""
    if accuracy is not None and given:
        raise InputError(f"{name}: {' and '.join(given)} stands beside accuracy, which chooses the same: give one of them.")
