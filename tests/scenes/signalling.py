# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs an example that sends itself signals at moments told in advance, so that no test races with the run it interrupts:

    yade -n -x signalling.py FUNCTION:CALL:SIGNAL[,...] EXAMPLE [options]

FUNCTION is named in full, as softgrain.records.Table.append; just before its CALL-th call, counted from 1, SIGNAL goes out."""
import os
import pkgutil
import runpy
import signal
import sys


def signal_before(function, number, name):
    """Puts a count in the place of the function."""
    owner, _, attribute = function.rpartition(".")
    owner = pkgutil.resolve_name(owner)
    called, calls = getattr(owner, attribute), 0

    def counting(*arguments, **options):
        nonlocal calls
        calls += 1
        if calls == number:
            os.kill(os.getpid(), signal.Signals[name])
        return called(*arguments, **options)

    setattr(owner, attribute, counting)


moments, *sys.argv = sys.argv[1:]
for moment in moments.split(","):
    function, number, name = moment.split(":")
    signal_before(function, int(number), name)
runpy.run_path(sys.argv[0], init_globals=globals(), run_name="__main__")   # with the names that yade gives a script
