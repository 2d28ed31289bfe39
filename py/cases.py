# SPDX-License-Identifier: GPL-2.0-or-later
"""A run of several scenes, one after the other in one process: the rows of each come into the csv once it is done. A run that was
stopped goes on with the scenes that are missing."""
from .runs import Run


class Cases(Run):
    """As Run; `work(case, show)` builds the scene of a case, computes it and returns its rows, dicts. It calls show(share, text) now
    and then, which raises Interrupted when the run is asked to stop."""

    def __init__(self, name, options, columns):
        super().__init__(name, options, columns)
        if not self.resumed:
            self.begin()
            self.memory["done"] = 0
            self.checkpoint()

    def compute(self, cases, work):
        """All cases that have not been done."""
        for number in range(self.memory["done"], len(cases)):
            def show(share, text):
                self.progress.show((number + share) / len(cases), text)
                if self.interrupted():
                    self.stop()

            with self.computing():
                rows = work(cases[number], show)
            for row in rows:
                self.table.append(row)
            self.memory["done"] += 1
            self.checkpoint()

    def _save_scene(self):
        return None

    def _load_scene(self, stored):
        pass
