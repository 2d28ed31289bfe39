# SPDX-License-Identifier: GPL-2.0-or-later
"""Long runs of scenes of one's own: progress() tells how far they are, and Ctrl-C stops them after the step.

While O.run(wait=True) waits, Python handles no signals: YADE by itself would run on to the end. Python still writes the number of a
signal into a pipe at once; a thread that sleeps at the other end of it stops YADE, O.run returns, and the signal takes its course."""
import math
import os
import signal
import sys
import threading
import time

import yade.wrapper as wrapper
from yade import O

from . import measures
from .checks import InputError, positive
from .progress import Progress

POLL_SECONDS = 0.005
CLOSER = "softgrain progress"      # the thread that ends the line
INTERRUPTS = (signal.SIGINT, signal.SIGTERM)
_shown = None       # the Progress of this process
_asked = set()      # numbers of signals that have come, besides INTERRUPTS


def watch_for_interrupts():
    """Lets Ctrl-C stop O.run(wait=True). Does nothing where another owner has the pipe of signals, as event loops do, or in a thread."""
    if threading.current_thread() is not threading.main_thread():
        return
    reader, writer = os.pipe()
    os.set_blocking(writer, False)
    before = signal.set_wakeup_fd(writer, warn_on_full_buffer=False)
    if before != -1:
        signal.set_wakeup_fd(before)
        os.close(reader)
        os.close(writer)
        return
    threading.Thread(target=_watch, args=(reader,), daemon=True).start()


def _watch(reader):
    while True:
        numbers = os.read(reader, 64)
        _asked.update(numbers)
        if any(number in INTERRUPTS for number in numbers):
            stop_after_step()


def stop_after_step():
    """Ends O.run() once its step is done, and returns then. O.pause() would return in the middle of the step."""
    before, ahead = O.stopAtIter, 1
    while O.running:
        last = O.stopAtIter = O.iter + ahead
        while O.running and O.iter <= last:
            time.sleep(POLL_SECONDS)
        ahead *= 4      # steps were faster than these lines
    O.stopAtIter = before


def asked(number):
    """Whether the signal has come since this was asked last."""
    if number in _asked:
        _asked.discard(number)
        return True
    return False


def progress(share=None, show=None, seconds=0.5):
    """An engine that keeps a line on the terminal: a bar with the time to go, and strain, solid fraction, stress and steps a second.
    Without a terminal it says nothing. O.engines = softEngines(more=[progress()]).

    share    what tells how far the run is, 0 to 1: a Python expression in the names of the script, as a PyRunner's command, such as
             "O.time / 0.1"; None: by O.stopAtIter or O.stopAtTime, where one is set
    show     an expression that gives further words, such as "f'torque {torque():.2f} N'"; None: strain ln(A0 / A) of the box of walls,
             solid fraction in it and mean normal stress on them, where the scene has such a box
    seconds  between two looks [s]
    Raises InputError.
    """
    for name, text in (("share", share), ("show", show)):
        if text is not None:
            try:
                compile(text, name, "eval")
            except (TypeError, SyntaxError, ValueError):
                raise InputError(f"progress: {name} is {text!r}: give a Python expression as a string, such as 'O.time / 0.1'.") from None
    return wrapper.PyRunner(command=f"import softgrain.live; softgrain.live.tell({share!r}, {show!r})",
                            realPeriod=positive("progress: seconds", seconds, "s"), initRun=True)


def tell(share, show):
    """What the engine of progress() does."""
    global _shown
    if _shown is None:
        _shown = Progress(steps=lambda: O.iter)
    if not _shown.terminal:
        return
    names = vars(sys.modules["__main__"])
    done = eval(share, names) if share else _share()
    _shown.show(done, str(eval(show, names)) if show else box_text())
    if O.running and not any(thread.name == CLOSER for thread in threading.enumerate()):
        threading.Thread(target=_close_at_end, name=CLOSER, daemon=True).start()


def _close_at_end():
    """O.run(wait=True) looks for the end every 40 ms; this is there before."""
    while O.running:
        time.sleep(POLL_SECONDS)
    _shown.close()


def _share():
    """By where O stops; nan without."""
    if O.stopAtIter > 0:
        return O.iter / O.stopAtIter
    return O.time / O.stopAtTime if O.stopAtTime > 0 else math.nan


def box_text():
    """Strain, solid fraction and stress of the box of walls, in words; without one, the number of the step."""
    walls = {axis: [body for body in O.bodies if isinstance(body.shape, wrapper.Wall) and body.shape.axis == axis] for axis in (0, 1)}
    if any(len(pair) != 2 for pair in walls.values()):
        return f"t = {O.time:.4g} s  step {O.iter}"
    length, length0 = ({axis: abs(getattr(pair[0].state, name)[axis] - getattr(pair[1].state, name)[axis])
                        for axis, pair in walls.items()} for name in ("pos", "refPos"))
    area, area0 = length[0] * length[1], length0[0] * length0[1]
    solid = sum(math.pi * body.shape.radius**2 for body in O.bodies if isinstance(body.shape, wrapper.Sphere))
    if measures.softBodies():
        solid += measures.softIntegrator().solidArea()
    stress = sum(measures.wallStress(wall.id, axis, length[1 - axis]) for axis, pair in walls.items() for wall in pair) / 4
    return f"strain {math.log(area0 / area):.3f}  phi {solid / area:.3f}  {stress / 1e3:.4g} kPa"
