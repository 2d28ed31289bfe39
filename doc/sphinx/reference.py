# SPDX-License-Identifier: GPL-2.0-or-later
"""Writes the reference of classes and functions, from the docstrings that the running package has.

    yade -n -x doc/sphinx/reference.py FOLDER
"""
import inspect
import os
import re
import sys
from fnmatch import fnmatch

import yade.wrapper as wrapper

import softgrain
from softgrain import _softgrain, arrays, builders, data, fclib, live, measures, pictures, restart, stresses

OURS = set(_softgrain.classes)
YADE = "https://yade-dem.org/doc/yade.wrapper.html#yade.wrapper."
GROUPS = {"Grains": ("SoftGrain", "SoftState"), "Materials": ("SoftMat", "*Mat"),
          "Steps": ("SoftIntegrator", "SoftImplicit*", "*Stepper"), "Walls and boxes under stresses and strains": ("*Controller",),
          "Contacts": ("SoftGeom", "SoftPhys", "Ig2_*", "Ip2_*", "Law2_*"), "Others": ("*",)}


def escaped(text):
    """Plain text of a docstring for reStructuredText."""
    return re.sub(r"([\\*|_`])", r"\\\1", text)


def linked(match):
    """A role :yref:`text<Target>` of YADE as a link, to this reference or to YADE's."""
    shown, _, target = match[1].rstrip(">").partition("<")
    target = target or shown
    if target.partition(".")[0] in OURS:
        return f":py:obj:`{shown} <{target}>`"
    if hasattr(softgrain, target):
        return f":py:func:`{shown} <softgrain.{target}>`"
    return f"`{escaped(shown)} <{YADE}{target}>`__"


def prose(doc):
    """A docstring of YADE's kind as one paragraph of reStructuredText."""
    doc = re.sub(r" *:y(?:default|attrtype|attrflags):`[^`]*`", "", doc).strip()
    parts = re.split(r"(:yref:`[^`]+`|``[^`]+``)", " ".join(doc.split()))
    return "".join(re.sub(r":yref:`([^`]+)`", linked, part) if part.startswith(":yref:") else
                   part if part.startswith("``") else escaped(part) for part in parts)


def role(doc, name):
    """What YADE keeps in a docstring under this name: default, attrtype, attrflags."""
    return "".join(re.findall(rf":y{name}:`([^`]*)`", doc))


def attribute(name, doc):
    flags = int(role(doc, "attrflags") or 0)
    kind, default = role(doc, "attrtype"), role(doc, "default")
    lines = [f"   .. py:attribute:: {name}"]
    lines += [f"      :type: {kind}"] if kind else []
    lines += [f"      :value: {default}"] if default and not flags & 2 else []
    return lines + ["", f"      {prose(doc)}" + (" *(to be read only)*" if flags & 2 else ""), ""]


def method(name, doc):
    signature, _, text = doc.strip().partition(" :\n")
    given, back = re.fullmatch(r"\w+\((.*)\) -> (\w+)", signature.strip()).groups()
    given = re.sub(r"\(\w+\)arg1 ?,? ?", "", given)
    given = re.sub(r"\(\w+\)", "", given).replace("[,", "[").strip()
    return [f"   .. py:method:: {name}({given}) -> {back}", "", f"      {prose(text)}", ""]


def class_lines(kind):
    bases = ", ".join(base.__name__ for base in kind.__bases__)
    said, *shared = kind.__doc__.split(f".. ystaticattr:: {kind.__name__}.")
    lines = [f".. py:class:: {kind.__name__}({bases})", "", f"   {prose(said)}", ""]
    for name, default, doc in (re.match(r"(\w+)\(=(.*?)\)\n(.*)", one, re.DOTALL).groups() for one in shared):
        lines += [f"   .. py:attribute:: {name}", f"      :value: {default}", "", f"      {prose(doc)} *(of the class)*", ""]
    for name, member in vars(kind).items():
        if name.startswith("_") or type(member).__name__ == "StaticProperty":
            continue
        lines += attribute(name, member.__doc__) if isinstance(member, property) else method(name, member.__doc__)
    return lines


def classes_page():
    lines = ["Classes", "=======", "", "Those that the plugin adds to YADE. What a class has of its bases stands there; "
             "attributes with a default can be given to the constructor, ``NeoHookeanMat(mu=1e6)``.", ""]
    left = list(_softgrain.classes)
    for title, patterns in GROUPS.items():
        group = list(dict.fromkeys(name for pattern in patterns for name in left if fnmatch(name, pattern)))
        left = [name for name in left if name not in group]
        lines += [title, "-" * len(title), ""] if group else []
        for name in group:
            lines += class_lines(getattr(wrapper, name))
    return lines


def function_lines(name, function):
    doc = inspect.getdoc(function)
    return [f".. py:function:: {name}{inspect.signature(function)}", "", "   ::", "",
            *(f"      {line}".rstrip() for line in doc.splitlines()), ""]


def functions_page():
    lines = ["Functions", "=========", "", "What ``from softgrain import *`` brings beside the classes.", ""]
    for module, shown in ((builders, "Bodies and engines"), (pictures, "Pictures"), (live, "Live runs"), (restart, "Checkpoints"),
                          (data, "Data of runs"), (arrays, "arrays"), (measures, "measures"), (stresses, "stresses"), (fclib, "fclib")):
        own = module in (arrays, measures, stresses, fclib)
        prefix = "softgrain." + (f"{shown}." if own else "")
        lines += [shown, "-" * len(shown), "", escaped(" ".join(module.__doc__.split())), ""]
        for name, function in vars(module).items():
            public = not name.startswith("_") and (own or name in softgrain.__all__)
            if inspect.isfunction(function) and public and function.__module__ == module.__name__:
                lines += function_lines(prefix + name, function)
    return lines


folder = sys.argv[1]
os.makedirs(folder, exist_ok=True)
for page, lines_ in (("classes", classes_page()), ("functions", functions_page())):
    with open(os.path.join(folder, page + ".rst"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines_) + "\n")
