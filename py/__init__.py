# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft grains for YADE: Material Point Method inside the grains, Contact Dynamics between them.

A scene says `from softgrain import *` and has the classes of the plugin (NeoHookeanMat, SoftGrain, SoftIntegrator...),
the builders (softDisc, softPolygon, softCloud, softBox, softEngines), and the modules arrays (what a grain holds, as
numpy arrays) and measures (of a running scene)."""
from . import _guard
_guard.check()
from . import _softgrain  # noqa: E402  registers the classes in yade.wrapper
import yade.wrapper  # noqa: E402

from . import arrays, builders, measures  # noqa: E402
from .builders import discCloud, softBox, softCloud, softDisc, softEngines, softPolygon  # noqa: E402
from .checks import InputError  # noqa: E402

__version__ = "0.1.0"

globals().update({name: getattr(yade.wrapper, name) for name in _softgrain.classes})

__all__ = [*_softgrain.classes, "InputError", "arrays", "discCloud", "measures", "softBox", "softCloud", "softDisc",
           "softEngines", "softPolygon"]
