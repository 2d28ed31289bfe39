# SPDX-License-Identifier: GPL-2.0-or-later
"""A line on the terminal that says how far a run is and when it will be done."""
import math
import shutil
import sys
import time

INTERVAL = 0.2          # between two lines [s]
BAR = 10                # length of the bar [letters]
RECENT = 5.0            # time over which rates are means [s]


class Progress:
    """Shows the share that is done, what is measured, steps a second and the time to go, from the recent rate. Says nothing but the
    last sentence where the output is not a terminal.

    steps  function that returns the number of steps so far; None: there are none to count
    """

    def __init__(self, stream=None, steps=None):
        self.stream, self.steps = stream or sys.stdout, steps
        self.terminal = self.stream.isatty()
        self._shown, self._recent = -math.inf, []

    def show(self, share, text):
        """`share` from 0 to 1 of the run is done, nan where that is not known; `text` tells the state in a few words."""
        now = time.monotonic()
        if not self.terminal or now - self._shown < INTERVAL:
            return
        self._shown = now
        self._recent.append((now, share, self.steps() if self.steps else 0))
        while len(self._recent) > 2 and now - self._recent[1][0] > RECENT:
            self._recent.pop(0)
        parts = [self._bar(share), self._to_go(), self._rate(), text]
        line = "  ".join(part for part in parts if part)
        self.stream.write("\r\x1b[K" + line[:shutil.get_terminal_size().columns - 1])
        self.stream.flush()

    def end(self, text):
        """Closes the line with a last sentence."""
        self.close()
        self.stream.write(text + "\n")
        self.stream.flush()

    def close(self):
        """What is written next stands on a line of its own."""
        if self._recent:
            self.stream.write("\n")
            self.stream.flush()
        self._recent = []

    @staticmethod
    def _bar(share):
        if math.isnan(share):
            return ""
        done = round(BAR * min(max(share, 0), 1))
        return f"[{'#' * done}{'-' * (BAR - done)}] {100 * min(share, 1):3.0f} %"

    def _rate(self):
        """Steps a second in words, empty where none are counted."""
        (then, _, before), (now, _, steps) = self._recent[0], self._recent[-1]
        return f"{(steps - before) / (now - then):.0f} steps/s" if now > then and steps > before else ""

    def _to_go(self):
        """The time to go in words, empty as long as it is not known."""
        (then, before, _), (now, share, _) = self._recent[0], self._recent[-1]
        if now - then < 1 or not share > before:
            return ""
        seconds = (1 - min(share, 1)) * (now - then) / (share - before)
        if seconds < 90:
            return f"{seconds:.0f} s to go"
        if seconds < 5400:
            return f"{seconds / 60:.0f} min to go"
        return f"{seconds / 3600:.1f} h to go"
