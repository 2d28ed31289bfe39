# SPDX-License-Identifier: GPL-2.0-or-later
"""A box whose top wall comes down at constant speed: the loop of compaction.py and rigid_compaction.py.

A row of the csv stands for one window of time, between two outputs. strain, solid_fraction, log_volume_change and the
stresses are means over the window, coordination, rattlers and contacts those of its middle: they belong together.
time_s, energies, dissipations, min_J, penetration and dt_s are those of its end; substeps and cut_steps, of implicit
steps, are counted since the start."""
import math

import numpy
from yade import O

from . import jamming, measures, shots
from .stepping import WallForces

OUTPUT_STRAIN = 0.004       # vertical strain between two rows [-]
COLUMNS = ("time_s,strain,solid_fraction,log_volume_change,stress_bottom_Pa,stress_top_Pa,coordination,rattlers,"
           "contacts,kinetic_J,elastic_J,external_work_J,friction_J,contact_dissipation_J,energy_residual_J,min_J,"
           "max_penetration_over_R,solver_iterations,solver_residual,dt_s,cpu_s").split(",")
VISCOUS_COLUMNS, PLASTIC_COLUMNS = ["viscous_dissipation_J"], ["plastic_dissipation_J"]
IMPLICIT_COLUMNS = "numerical_dissipation_J,contact_distance_over_R,substeps,cut_steps".split(",")


def columns_of(options):
    """Columns of the csv for the integrator and the material that were chosen."""
    return (COLUMNS + (IMPLICIT_COLUMNS if options.integrator == "implicit" else [])
            + (VISCOUS_COLUMNS if options.viscosity > 0 else [])
            + (PLASTIC_COLUMNS if options.material == "plastic" else []))


def implicit_step(box, speed):
    """Length of an implicit step that follows the loading well, half a row at the start [s]."""
    return box["height"] * OUTPUT_STRAIN / 2 / speed


class Press:
    """Drives a packing and records it.

    run      of runs.py; its memory keeps what is needed to go on
    packing  of packings.py
    box      dict: width [m], height at the start [m], body ids of the walls bottom and top
    speed    of the top wall, downwards [m/s]
    longest  implicit steps: the longest [s]
    """

    def __init__(self, run, packing, box, speed, longest=None):
        self.run, self.packing, self.box, self.speed = run, packing, box, speed
        self.memory = run.memory
        self.forces = WallForces({"bottom": (box["bottom"], 1), "top": (box["top"], 1)}, run, longest)
        if not run.resumed:
            self._begin()

    def go(self, until, stress_limit=math.inf):
        """Presses until a row's solid fraction reaches `until` or its stress on the bottom exceeds the limit [Pa].
        Raises Interrupted after a checkpoint when the run is asked to stop."""
        with self.run.computing():
            while self.memory["fraction"] < until and self.memory["stress"] < stress_limit:
                self._one_window()
                self.run.progress.show(self._share(until), self._text())
                self.run.checkpoint_if_due()
        self._take("end")

    def _one_window(self):
        window = self.memory["window"]
        self.forces.through_window(self._time_of(window), self._time_of(window + 1), self._instant)
        self._record()
        self.run.frame()
        self.forces.remember()

    def _instant(self):
        """What is seen half-way through a window."""
        return {"contacts": self.packing.contacts(),
                "penetration": self.packing.solver().get("max_penetration_over_R", 0.0)}

    def height(self):
        """Of the top wall above the bottom one, now [m]."""
        return O.bodies[self.box["top"]].state.pos[1]

    def _begin(self):
        """The first step, which prepares the grains, and what the run starts from."""
        O.bodies[self.box["top"]].state.vel = (0, -self.speed, 0)
        self.memory.update(window=0, middle=None, fraction=0.0, stress=0.0, steps=0, jammed=False, work=0.0)
        self.forces.first_step()
        self.forces.require_steps(self._time_of(1), self.speed)
        self.run.begin()
        area = self.packing.area()
        self.memory.update(steps=1, area0=area, area=area, h=self.height(),
                           sweeps=self.packing.total_sweeps(), energy0=self._stored_energy())
        self._take("start")
        self.forces.reset()
        self.forces.remember()
        self.run.checkpoint()

    def _time_of(self, window):
        """When the wall has come so far that the strain is `window` times OUTPUT_STRAIN [s]."""
        return self.box["height"] * -math.expm1(-window * OUTPUT_STRAIN) / self.speed

    def _record(self):
        """Appends the row of the window that has just ended, and begins the next one."""
        memory, packing, width = self.memory, self.packing, self.box["width"]
        area, height, sweeps = packing.area(), self.height(), packing.total_sweeps()
        mean_area, mean_height = (area + memory["area"]) / 2, (height + memory["h"]) / 2
        memory["work"] += self.forces.impulse("top") * self.speed
        energies = {"external_work_J": memory["work"], **packing.energies()}
        dissipated = sum(value for name, value in energies.items() if name.endswith("_dissipation_J"))
        balance = (self._stored_energy(energies) - memory["energy0"] + energies["friction_J"] + dissipated
                   - energies["external_work_J"])
        solver = packing.solver()
        solver["max_penetration_over_R"] = max(solver["max_penetration_over_R"], memory["middle"]["penetration"])
        coordination, rattlers, contacts = memory["middle"]["contacts"]
        row = {"time_s": O.time, "strain": math.log(self.box["height"] / mean_height),
               "solid_fraction": mean_area / (width * mean_height),
               "log_volume_change": measures.volumeChange(mean_area, memory["area0"]),
               "stress_bottom_Pa": -self.forces.mean("bottom") / width,
               "stress_top_Pa": self.forces.mean("top") / width,
               "coordination": coordination, "rattlers": rattlers, "contacts": contacts, **energies,
               "energy_residual_J": balance, **solver,
               "solver_iterations": (sweeps - memory["sweeps"]) / max(self.forces.steps, 1), "dt_s": O.dt,
               "cpu_s": self.run.cpu_seconds()}
        self.run.table.append(row)
        memory.update(window=memory["window"] + 1, middle=None, area=area, h=height, sweeps=sweeps,
                      steps=memory["steps"] + self.forces.steps, fraction=row["solid_fraction"],
                      stress=row["stress_bottom_Pa"], coordination=coordination)
        self.forces.reset()
        if not memory["jammed"] and row["stress_bottom_Pa"] > jamming.STRESS:
            memory["jammed"] = True
            self._take("jamming")

    def _stored_energy(self, energies=None):
        """Kinetic and elastic energy [J/m], of these or of now."""
        energies = energies or self.packing.energies()
        return energies["kinetic_J"] + energies["elastic_J"]

    def _take(self, name):
        """Writes the shot snapshot_NAME.npz, with strain and solid fraction."""
        height, width = self.height(), self.box["width"]
        shots.save(self.run.path(f"snapshot_{name}.npz"),
                   {**shots.take(["vonMises", "J"]), "strain": numpy.float64(math.log(self.box["height"] / height)),
                    "solid_fraction": numpy.float64(self.packing.area() / (width * height))})

    def _share(self, until):
        """Of the way to this solid fraction, for the progress."""
        fraction = self.memory["fraction"]
        begin = self.memory["area0"] / (self.box["width"] * self.box["height"])
        return (fraction - begin) / max(until - begin, 1e-12)

    def _text(self):
        memory = self.memory
        strain = memory["window"] * OUTPUT_STRAIN
        count = f"{memory['coordination']:.2f}" if memory["coordination"] == memory["coordination"] else "-"
        return f"strain {strain:.3f}  phi {memory['fraction']:.3f}  {memory['stress'] / 1e3:.4g} kPa  Z {count}"
