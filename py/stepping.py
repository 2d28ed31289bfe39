# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs steps and averages the forces on walls over them. About two microseconds of Python a step."""
import math

from yade import O

from . import measures
from .checks import InputError

LEAST_STEPS = 4     # in the time between two outputs
SHORT = 1e-3        # first step [implicit step]


class WallForces:
    """Time means of wall forces between two outputs, which are one window of time apart.

    walls    maps a name to (body id, axis 0 or 1): which component of the force on which wall is averaged [N/m]
    run      of runs.py, whose memory keeps what is needed to go on: `forces`, and `middle`, what was seen half-way through
             the window, None before
    longest  implicit steps: the longest [s]. O.dt is fitted so that steps end with the output. Forces are those at
             theta of a step, and means are over the straight lines between them
    """

    def __init__(self, walls, run, longest=None):
        self.walls, self.run, self.longest = walls, run, longest
        self.reset()
        if run.resumed:
            self._recall()

    def reset(self):
        """Begins a new average at the current time."""
        self.last = getattr(self, "last", [0.0] * len(self.walls))
        self.begin, self.steps = O.time, 0
        self.impulses = [0.0] * len(self.walls)

    def first_step(self):
        """The first step, a short one when steps are implicit."""
        if self.longest:
            O.dt = SHORT * self.longest
        self.run.first_step()

    def require_steps(self, window, speed):
        """InputError when the time between two outputs [s] is so short that few steps fall into it, which happens to
        walls of an absurd speed [m/s]."""
        if not self.longest and window < LEAST_STEPS * O.dt:
            raise InputError(f"--speed {speed:g} m/s leaves {window / O.dt:.2g} time steps of {O.dt:.3g} s between two "
                             f"rows of the csv: give less than {speed * window / (LEAST_STEPS * O.dt):.2g}.")

    def through_window(self, begin, end, look):
        """Steps from begin to end [s], and keeps what the function `look` returns half-way. Raises Interrupted after a
        checkpoint when the run is asked to stop."""
        memory = self.run.memory
        if memory["middle"] is None and self._advance((begin + end) / 2):
            memory["middle"] = look()
        if memory["middle"] is None or not self._advance(end):
            self.remember()
            self.run.stop()

    def _advance(self, end):
        """Steps until the time [s] is reached; false when stopped before."""
        step, force, walls = O.step, O.forces.f, list(enumerate(self.walls.values()))
        impulses, steps, now, asked_to_stop = self.impulses, 0, O.time, self.run.interrupted
        if self.longest and end > now:
            return self._advance_by_long_steps(end)
        try:
            while now < end:
                if asked_to_stop():
                    return False
                step()
                steps += 1
                before, now = now, O.time
                for i, (wall, axis) in walls:
                    impulses[i] += force(wall)[axis] * (now - before)
        finally:
            self.steps += steps
        return True

    def _advance_by_long_steps(self, end):
        """The same by implicit steps of equal length."""
        soft = measures.softIntegrator()
        before = 0.5 if soft.quasistatic else soft.theta - 0.5      # share of the last step's force
        while end - O.time > 1e-9 * self.longest:
            if self.run.interrupted():
                return False
            O.dt = (end - O.time) / math.ceil((end - O.time) / self.longest * (1 - 1e-9))
            O.step()
            self.steps += 1
            forces = [O.forces.f(wall)[axis] for wall, axis in self.walls.values()]
            for i, force in enumerate(forces):
                self.impulses[i] += (before * self.last[i] + (1 - before) * force) * O.dt
            self.last = forces
        return True

    def impulse(self, name):
        """Time integral of the force since the average began [N s/m]."""
        return self.impulses[list(self.walls).index(name)]

    def mean(self, name):
        """Mean force since the average began [N/m]."""
        return self.impulse(name) / (O.time - self.begin)

    def remember(self):
        """Puts the state of the average where checkpoints keep it."""
        self.run.memory["forces"] = {"begin": self.begin, "steps": self.steps, "impulses": list(self.impulses),
                                     "last": list(self.last)}

    def _recall(self):
        state = self.run.memory["forces"]
        self.begin, self.steps, self.impulses = state["begin"], state["steps"], list(state["impulses"])
        self.last = list(state["last"])
