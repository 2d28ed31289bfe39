# SPDX-License-Identifier: GPL-2.0-or-later
"""A scene that runs through windows of time, a row of the csv for each: the loop of heavy_ball.py, funnel.py and drum.py."""
import numpy
from yade import O

from . import shots


class Timed:
    """Runs a scene that stands ready, or was loaded.

    run       of runs.py; run.memory["window"] counts the windows that are done, ["start"] is when the present one began [s]
    begin     time at which the first window begins [s]; before, nothing is recorded
    duration  of all windows [s]; count: how many
    row       function that returns the row of the window that has just ended, from its length [s]
    text      function that tells the state in a few words
    shots     numbers of windows after which a shot is taken; shots are snapshot_1.npz and so on
    """

    def __init__(self, run, begin, duration, count, row, text, shots):
        self.run, self.begin, self.duration, self.count = run, begin, duration, count
        self.row, self.text, self.shots = row, text, shots

    def go(self, released=lambda: None):
        """To the end. `released` is called once, when the first window begins."""
        memory = self.run.memory
        if not self.run.resumed:
            self.run.first_step()
            self.run.begin()
            memory["window"] = -1
            self.run.checkpoint()
        with self.run.computing():
            while memory["window"] < self.count:
                if memory["window"] == -1:
                    self._until(self.begin)
                    released()
                else:
                    self._until(self.begin + self.duration * (memory["window"] + 1) / self.count)
                    self.run.table.append(self.row(O.time - memory["start"]))
                    self.run.frame()
                memory["window"] += 1
                memory["start"] = O.time
                if memory["window"] in self.shots:
                    self._take(self.shots.index(memory["window"]) + 1)
                self.run.checkpoint_if_due()

    def _until(self, time):
        while O.time < time:
            if O.iter % 200 == 0:
                self.run.progress.show(O.time / (self.begin + self.duration), self.text())
                if self.run.interrupted():      # with a step to go, since what is known of the last one is not saved
                    self.run.stop()
            O.step()

    def _take(self, number):
        shots.save(self.run.path(f"snapshot_{number}.npz"), {**shots.take(), "time": numpy.float64(O.time - self.begin)})
