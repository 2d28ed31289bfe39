# SPDX-License-Identifier: GPL-2.0-or-later
"""Checkpoints of scenes of one's own, and how they go on: checkpoints() writes, resume() reads. (Those of the examples: runs.py.)

A checkpoint PATH is PATH.json, which names the saved scene PATH-STEP.yade and holds its digest and the versions that wrote it. The
scene is written first, the json in one stroke after it, the scene before only then removed: there is a whole checkpoint at every moment."""
import glob
import os
import signal
import sys
import time

import yade.wrapper as wrapper
from yade import O

from . import live, summary
from .checks import InputError, positive
from .records import digest, read_json, sealed, write_json

SAVED_BY = ("softgrain", "yade")    # versions that a saved scene depends on
POLL_SECONDS = 0.2                  # between two looks at clock and signals
TICK = "softgrain.restart.tick("
_last = {}                          # when a checkpoint was written last, by path [s]
_path = None                        # the one that an interrupt writes


def checkpoints(path, seconds=600.0):
    """An engine that saves the scene every so many seconds of wall time, on the signal SIGUSR1 (kill -USR1), and when Ctrl-C or SIGTERM
    stops the run after its step. It stands first, so that it saves between two steps:

        if not resume("packing"):
            ...                                     # bodies
            O.engines = [checkpoints("packing"), *softEngines()]
        O.run(wait=True)

    What is resumed goes on with the same digits, also with another number of threads.

    path     of the files, without ending
    seconds  between two [s]
    Raises InputError.
    """
    global _path
    path, seconds = os.path.abspath(path), positive("checkpoints: seconds", seconds, "s")
    if not os.path.isdir(os.path.dirname(path)) or not os.access(os.path.dirname(path), os.W_OK):
        raise InputError(f"checkpoints: {os.path.dirname(path)} is no folder that can be written: give another path.")
    _last[path], _path = time.monotonic(), path
    _take_signals()
    return wrapper.PyRunner(command=_command(path, seconds), realPeriod=POLL_SECONDS)


def resume(path):
    """Loads the scene of a checkpoint, which goes on writing checkpoints there; False when there is none. Raises InputError for one
    that is damaged, or that other versions wrote."""
    global _path
    path = os.path.abspath(path)
    try:
        stored = read_json(f"{path}.json")
    except FileNotFoundError:
        return False
    except (OSError, ValueError):
        stored = None
    if not isinstance(stored, dict) or not {"scene", "versions", "scene_digest"} <= set(stored) or stored != sealed(stored):
        raise InputError(f"{path}.json is no checkpoint, or is damaged: remove it to start anew, or give another path.")
    if stored["versions"] != versions():
        raise InputError(f"the checkpoint {path} was saved by {named(stored['versions'])}, but this is {named(versions())}: resume with "
                         "the versions that saved it, or remove it to start anew.")
    scene = os.path.join(os.path.dirname(path), stored["scene"])
    if _digest(scene) != stored["scene_digest"]:
        raise InputError(f"{scene} is missing or damaged: remove {path}.json to start anew.")
    O.load(scene, quiet=True)
    for engine in O.engines:
        if TICK in getattr(engine, "command", ""):
            engine.command = _command(path, stored["seconds"])
    _last[path], _path = time.monotonic(), path
    _take_signals()
    return True


def tick(path, seconds):
    """What the engine of checkpoints() does at the beginning of a step."""
    global _path
    _path = path
    _require_first()
    wanted = live.asked(signal.SIGUSR1)
    if wanted or time.monotonic() - _last.setdefault(path, time.monotonic()) > seconds:
        save(path, seconds)


def save(path, seconds):
    """Writes a checkpoint of the scene as it is between two steps."""
    scene = f"{path}-{O.iter:09d}.yade"
    O.save(scene, quiet=True)
    write_json(f"{path}.json", sealed({"scene": os.path.basename(scene), "scene_digest": _digest(scene), "iter": O.iter, "time_s": O.time,
                                       "seconds": seconds, "versions": versions()}))
    for old in glob.glob(f"{glob.escape(path)}-{'[0-9]' * 9}.yade"):
        if old != scene:
            os.remove(old)
    _last[path] = time.monotonic()


def versions():
    """Versions on which a saved scene depends."""
    return {name: version for name, version in summary.versions().items() if name in SAVED_BY}


def named(known):
    """The versions in words, for messages."""
    return " under ".join(f"{name} {known.get(name, '?') if isinstance(known, dict) else '?'}" for name in SAVED_BY)


def _require_first():
    """InputError where the engine of checkpoints() stands in the middle of a step."""
    for engine in O.engines:
        command = getattr(engine, "command", None)
        if command is None:
            raise InputError(f"checkpoints() stands behind {type(engine).__name__} in O.engines, in the middle of a step: put it first, as in "
                             "O.engines = [checkpoints('packing'), *softEngines()].")
        if TICK in command:
            return


def _command(path, seconds):
    return f"import softgrain.restart; {TICK}{path!r}, {seconds!r})"


def _digest(scene):
    try:
        with open(scene, "rb") as file:
            return digest(file.read())
    except OSError:
        return None


def _take_signals():
    for number in live.INTERRUPTS:
        signal.signal(number, _stop)
    signal.signal(signal.SIGUSR1, lambda *_: None)     # the engine asks for it


def _stop(number, _frame):
    """The run ends after its step, which a checkpoint keeps, if O.engines still has the engine."""
    live.stop_after_step()
    seconds = next((engine.command.rpartition(", ")[2][:-1] for engine in O.engines if TICK in getattr(engine, "command", "")), None)
    sys.stdout.flush()
    if seconds is None:
        raise KeyboardInterrupt
    save(_path, float(seconds))
    print(f"\nstopped after step {O.iter}; {_path}.json keeps it, and resume({os.path.relpath(_path)!r}) goes on from there.", file=sys.stderr)
    sys.exit(128 + number)
