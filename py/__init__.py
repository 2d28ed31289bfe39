# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft grains for YADE: Material Point Method inside the grains, Contact Dynamics between them.

A scene says `from softgrain import *` and has the classes of the plugin (NeoHookeanMat, SoftGrain, SoftIntegrator...),
the builders (softDisc, softPolygon, softCloud, softBox, rigidDisc, softEngines), and the modules arrays (what a grain holds, as
numpy arrays), measures and stresses (of a running scene) and fclib (its contact problems, for other solvers)."""
from . import _guard
_guard.check()
from . import _softgrain  # noqa: E402  registers the classes in yade.wrapper
import yade.wrapper  # noqa: E402

from . import arrays, fclib, measures, prompt, stresses  # noqa: E402
from .builders import discCloud, rigidContacts, rigidDisc, softBox, softCloud, softDisc, softEngines, softPolygon  # noqa: E402
from .checks import InputError  # noqa: E402

__version__ = "0.1.0"

globals().update({name: getattr(yade.wrapper, name) for name in _softgrain.classes})
prompt.teach([getattr(yade.wrapper, name) for name in _softgrain.classes])


def _renew_dispatchers():
    """The engines that YADE itself puts into O.engines are older than the classes registered above, and so are the
    tables by which they find the functor of a class: too short for a soft grain, which would end the process. Setting
    the functors anew renews the tables."""
    for engine in yade.wrapper.Omega().engines:
        for name in ("boundDispatcher", "geomDispatcher", "physDispatcher", "lawDispatcher"):
            dispatcher = getattr(engine, name, None)
            if dispatcher is not None:
                dispatcher.functors = dispatcher.functors


_renew_dispatchers()

__all__ = [*_softgrain.classes, "InputError", "arrays", "discCloud", "fclib", "measures", "rigidContacts", "rigidDisc",
           "softBox", "softCloud", "softDisc", "softEngines", "softPolygon", "stresses"]
