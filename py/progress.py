# SPDX-License-Identifier: GPL-2.0-or-later
"""A line that says how far a run is and when it will be done."""
import sys
import time

SPARSE_SECONDS = 20.0     # between lines when the output is not a terminal
TERMINAL_SECONDS = 0.2


class Progress:
    """Shows the share that is done, what is measured, and the time to go, from the recent rate."""

    def __init__(self, stream=None):
        self.stream = stream or sys.stdout
        self.terminal = self.stream.isatty()
        self._begin = self._shown = None
        self._share_at_begin = 0.0
        self._recent = []

    def show(self, share, text):
        """`share` from 0 to 1 of the run is done; `text` tells the state in a few words."""
        now = time.monotonic()
        if self._begin is None:
            self._begin, self._share_at_begin = now, share
        self._recent = (self._recent + [(now, share)])[-20:]
        interval = TERMINAL_SECONDS if self.terminal else SPARSE_SECONDS
        if self._shown is not None and now - self._shown < interval:
            return
        self._shown = now
        line = f"{100 * min(share, 1):5.1f} %  {text}  {self._to_go(share)}"
        if self.terminal:
            self.stream.write("\r" + line.ljust(100)[:118])
        else:
            self.stream.write(line.rstrip() + "\n")
        self.stream.flush()

    def end(self, text):
        """Closes the line with a last sentence."""
        self.stream.write(("\n" if self.terminal and self._shown is not None else "") + text + "\n")
        self.stream.flush()

    def _to_go(self, share):
        """The time to go in words, empty as long as it is not known."""
        (then, before), (now, _) = self._recent[0], self._recent[-1]
        if share <= before or now - self._begin < 1:
            return ""
        seconds = (1 - min(share, 1)) * (now - then) / (share - before)
        if seconds < 90:
            return f"{seconds:.0f} s to go"
        if seconds < 5400:
            return f"{seconds / 60:.0f} min to go"
        return f"{seconds / 3600:.1f} h to go"
