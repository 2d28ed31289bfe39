# SPDX-License-Identifier: GPL-2.0-or-later
"""The plugin's classes at a Python prompt: they say what they are, and refuse attributes that they do not have."""
import difflib
import inspect
import math
import re

from yade.wrapper import Serializable

UNIT = re.compile(r"\[((?:Pa|rad|kg|m|s|N|J)[²³]?(?:[/·](?:m|s|kg)[²³]?)?)\]")     # in a docstring, such as [kg/m³]
KIND = re.compile(r":yattrtype:`([^`]*)`")                                           # the same, of C++
KINDS = {"Real": "a number", "int": "a whole number", "long": "a whole number", "bool": "True or False", "string": "text",
         "std::string": "text", "vector<Real>": "a list of numbers", "vector<int>": "a list of whole numbers",
         "Vector2r": "two numbers", "Vector3r": "three numbers", "vector<Vector3r>": "a list of Vector3",
         "shared_ptr<MatchMaker>": "a MatchMaker"}
# What YADE's own bases add to the repr of a class, beside all that can be set of the plugin's classes.
TOLD_TOO = {"SoftMat": ("density", "frictionAngle"), "SoftState": ("pos", "vel"), "SoftGeom": ("refR1", "refR2"),
            "SoftPhys": ("tangensOfFrictionAngle", "normalForce")}
LONGEST = 3     # list that a repr shows


def teach(classes):
    """Gives the classes of the plugin their repr, and the refusal of names and values that they cannot take."""
    for kind in classes:
        kind.__init__ = _constructor(kind)
        kind.__setattr__ = _set
        kind.__repr__ = kind.__str__ = _told


def attributes(kind):
    """The attributes of a class and of its bases: {name: property}."""
    return {name: found for base in reversed(kind.__mro__) for name, found in vars(base).items()
            if isinstance(found, property)}


def _constructor(kind):
    made = kind.__init__

    def __init__(self, *positional, **named):
        for name, value in named.items():
            _attribute(kind, kind.__name__, name, value)
        try:
            made(self, *positional, **named)
        except TypeError:
            for name, value in named.items():   # which of them?
                if attributes(kind)[name].fset:
                    setattr(kind(), name, value)
            raise

    return __init__


def _set(self, name, value):
    kind = type(self)
    if kind.__module__ == "yade.wrapper":       # a class that a scene derives may have attributes of its own
        who = _name(self)
        found = _attribute(kind, who, name, value)
        if found.fset is None:
            raise AttributeError(f"{who}: {name} can be read only, not set to {value!r}.")
        try:
            object.__setattr__(self, name, value)
        except TypeError:
            wanted = KINDS.get("".join(KIND.findall(found.__doc__)), f"what help({kind.__name__}.{name}) says")
            raise TypeError(f"{who}: {name} = {value!r} is of the wrong type: give {wanted}.") from None
    else:
        object.__setattr__(self, name, value)


def _attribute(kind, who, name, value):
    """The property of this name, or AttributeError with the name that was perhaps meant."""
    found = inspect.getattr_static(kind, name, None)
    if isinstance(found, property):
        return found
    near = difflib.get_close_matches(name, attributes(kind), n=1, cutoff=0.5)
    hint = f"give {near[0]}, if that is meant" if near else f"help({kind.__name__}) lists those it has"
    raise AttributeError(f"{who} has no attribute {name} to be set to {value!r}: {hint}.")


def _name(self):
    label = getattr(self, "label", "")
    return type(self).__name__ + (f' "{label}"' if label else "")


def _told(self):
    kind = type(self)
    names = [name for base in kind.__mro__ for name in (*_own(base), *TOLD_TOO.get(base.__name__, ()))]
    words = [_word(name, getattr(self, name), inspect.getattr_static(kind, name).__doc__) for name in names]
    address = Serializable.__repr__(self).split()[-1]
    return " ".join([f"<{_name(self)}", *filter(None, words), "at", address])


def _own(kind):
    """Names of what can be set of a class of the plugin; nothing of another class."""
    if vars(kind).get("__repr__") is not _told:
        return []
    return [name for name, found in vars(kind).items()
            if isinstance(found, property) and found.fset and KIND.search(found.__doc__ or "")]


def _word(name, value, doc):
    """name=value with its unit; empty for what is not given."""
    shown = _shown(value)
    unit = UNIT.search(doc)
    return shown and f"{name}={shown}" + (f" {unit[1]}" if unit else "")


def _shown(value):
    if isinstance(value, float):
        return "" if math.isnan(value) else f"{value:.6g}"
    if isinstance(value, str):
        return repr(value) if value else ""
    if not hasattr(value, "__len__"):
        return "" if value is None else str(value)
    if len(value) > LONGEST:
        return f"({len(value)} values)"
    parts = [_shown(part) for part in value]
    return f"({', '.join(part or 'nan' for part in parts)})" if any(parts) else ""
