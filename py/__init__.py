# SPDX-License-Identifier: GPL-2.0-or-later
"""Soft grains for YADE: Material Point Method inside the grains, Contact Dynamics between them.

A scene says `from softgrain import *` and has the classes of the plugin (NeoHookeanMat, SoftGrain, SoftIntegrator...),
the builders (softDisc, softPolygon, softCloud, softBox, rigidDisc, softEngines), pictures (snapshot, movie), what long runs want
(progress, checkpoints, resume, save_run, load_run), and the modules arrays (what a grain holds, as numpy arrays), measures and
stresses (of a running scene) and fclib (its contact problems, for other solvers).

Outside of YADE, in any python3 with numpy, there are movie and load_run, which read what runs have written."""
import sys
import warnings

from . import _guard
from .checks import InputError
from .data import load_run
from .pictures import movie

__version__ = "0.1.0"

_OF_SCENES = ["arrays", "checkpoints", "discCloud", "fclib", "measures", "progress", "resume", "rigidContacts", "rigidDisc", "save_run",
              "snapshot", "softBox", "softCloud", "softDisc", "softEngines", "softPolygon", "stresses"]
__all__ = ["InputError", "load_run", "movie", *_OF_SCENES]


def _renew_dispatchers():
    """The engines that YADE itself puts into O.engines are older than the classes of the plugin, and so are the
    tables by which they find the functor of a class: too short for a soft grain, which would end the process. Setting
    the functors anew renews the tables."""
    for engine in yade.wrapper.Omega().engines:
        for name in ("boundDispatcher", "geomDispatcher", "physDispatcher", "lawDispatcher"):
            dispatcher = getattr(engine, name, None)
            if dispatcher is not None:
                dispatcher.functors = dispatcher.functors


def _enter_windows():
    """YADE's windows, where they are open, know the classes of when they opened, in their 3D view and by name."""
    qt = sys.modules.get("yade.qt")
    if qt is None:
        return
    _softgrain.renewRenderer(qt.Renderer())
    for window in (qt, sys.modules["yade.qt.SerializableEditor"]):
        vars(window).update({name: getattr(yade.wrapper, name) for name in _softgrain.classes})
    if qt.controller and "Gl1_SoftGrain" in _softgrain.classes:
        qt.controller.displayCombo.addItem("Gl1_SoftGrain")


if _guard.inside_yade():
    _guard.check()
    from . import _softgrain  # registers the classes in yade.wrapper
    import yade.wrapper

    from . import arrays, fclib, live, measures, prompt, stresses
    from .builders import discCloud, rigidContacts, rigidDisc, softBox, softCloud, softDisc, softEngines, softPolygon
    from .data import save_run
    from .live import progress
    from .pictures import snapshot
    from .restart import checkpoints, resume

    globals().update({name: getattr(yade.wrapper, name) for name in _softgrain.classes})
    prompt.teach([getattr(yade.wrapper, name) for name in _softgrain.classes])
    __all__ += _softgrain.classes
    _renew_dispatchers()
    _enter_windows()
    live.watch_for_interrupts()
else:
    warnings.warn("this is not YADE: softgrain has load_run and movie here; scenes are scripts run by `yade script.py`.", stacklevel=2)

    def __getattr__(name):
        """Says what is missing outside of YADE."""
        if name in _OF_SCENES:
            raise _guard.outside(f"softgrain.{name}")
        raise AttributeError(f"module 'softgrain' has no attribute '{name}'")
