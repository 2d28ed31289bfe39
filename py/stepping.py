# SPDX-License-Identifier: GPL-2.0-or-later
"""Runs steps and averages the forces on walls over them. About two microseconds of Python a step."""
from yade import O

from .checks import InputError

LEAST_STEPS = 4     # in the time between two outputs


class WallForces:
    """Time means of wall forces between two outputs.

    walls   maps a name to (body id, axis 0 or 1): which component of the force on which wall is averaged [N/m]
    asked_to_stop  function without arguments: true when stepping has to end (an interrupt)
    """

    def __init__(self, walls, asked_to_stop):
        self.walls = walls
        self.asked_to_stop = asked_to_stop
        self.reset()

    def reset(self):
        """Begins a new average at the current time."""
        self.begin, self.steps = O.time, 0
        self.impulses = [0.0] * len(self.walls)

    @staticmethod
    def require_steps(window, speed):
        """InputError when the time between two outputs [s] is so short that few steps fall into it, which happens to
        walls of an absurd speed [m/s]."""
        if window < LEAST_STEPS * O.dt:
            raise InputError(f"--speed {speed:g} m/s leaves {window / O.dt:.2g} time steps of {O.dt:.3g} s between two "
                             f"rows of the csv: give less than {speed * window / (LEAST_STEPS * O.dt):.2g}.")

    def advance(self, end):
        """Steps until the time [s] is reached; false when stopped before."""
        step, force, walls = O.step, O.forces.f, list(enumerate(self.walls.values()))
        impulses, steps, now = self.impulses, 0, O.time
        try:
            while now < end:
                if self.asked_to_stop():
                    return False
                step()
                steps += 1
                before, now = now, O.time
                for i, (wall, axis) in walls:
                    impulses[i] += force(wall)[axis] * (now - before)
        finally:
            self.steps += steps
        return True

    def impulse(self, name):
        """Time integral of the force since the average began [N s/m]."""
        return self.impulses[list(self.walls).index(name)]

    def mean(self, name):
        """Mean force since the average began [N/m]."""
        return self.impulse(name) / (O.time - self.begin)

    def state(self):
        """What a checkpoint has to keep."""
        return {"begin": self.begin, "steps": self.steps, "impulses": list(self.impulses)}

    def restore(self, state):
        self.begin, self.steps, self.impulses = state["begin"], state["steps"], list(state["impulses"])
