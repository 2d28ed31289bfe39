# SPDX-License-Identifier: GPL-2.0-or-later
"""Mixtures of soft and rigid discs, compacted from all sides: the loop of mixed_packing.py, and what its curves say."""
import math

import numpy
import yade.wrapper as wrapper
from yade import O
from yade.minieigenHP import Vector2

from . import builders, jamming, measures, stresses

STRAIN = 0.004          # of each side between two rows [-]
COLUMNS = ["rigid_fraction", "friction", "time_s", "strain", "solid_fraction", "stress_Pa", "contact_stress_Pa", "coordination",
           "rattlers", "contacts", "max_penetration_over_R", "energy_residual_over_work", "cpu_s"]
SAMPLES = 20            # of contact stresses in a row: those of a single step fluctuate
GROW = 1e-12            # of stresses, below which there is none to compare with [Pa]


class Mixture:
    """A scene of one cloud of discs, of which a share is rigid, in a box whose sides all shrink at one rate.

    options   grains, diameters, solid_fraction, points, seed, material, rate [1/s], dt_rigid [s]
    rigid     share of the discs that is rigid, 0 to 1; the same ones are rigid in every larger share
    friction  Coulomb's coefficient between all discs; walls have none
    """

    def __init__(self, options, material, rigid, friction):
        O.reset()
        self.rigid, self.friction, self.rate = rigid, friction, options.rate
        O.materials.append(material)
        O.materials.append(wrapper.FrictMat(density=material.density, frictionAngle=math.atan(friction), label="rigid"))
        O.materials.append(wrapper.FrictMat(frictionAngle=0, label="walls"))
        width = builders.widthOfSquareCloud(options.grains, options.diameters, options.solid_fraction)
        radii, places, angles, height = builders.discCloud(width, options.grains, options.diameters, options.solid_fraction,
                                                           options.seed)
        hard = set(numpy.random.default_rng(options.seed).permutation(options.grains)[:round(rigid * options.grains)])
        self.ids = O.bodies.append(
            [builders.rigidDisc(place, radius, "rigid") if number in hard else
             builders.softDisc(place, radius, 0, points=options.points, angle=angle)
             for number, (radius, place, angle) in enumerate(zip(radii, places, angles))])
        self.rigid_area = math.pi * math.fsum(radii[number]**2 for number in hard)
        walls = O.bodies.append(builders.softBox(width, height, "walls"))
        self.box = wrapper.SoftBoxController(walls=walls, goal=Vector2(math.inf, math.inf), symmetric=True,
                                             maxStrainRate=Vector2(options.rate, options.rate))
        O.engines = builders.softEngines(functors=builders.rigidContacts(), friction=friction, wallFriction=0,
                                         dt=options.dt_rigid if len(hard) == options.grains else None, more=[self.box])
        self.soft = measures.softIntegrator()

    def compact(self, limit, show, cpu_seconds):
        """Until the mean stress on the walls exceeds the limit [Pa]; the rows."""
        O.step()
        rows, start, energy = [], cpu_seconds(), self._stored()
        while not rows or rows[-1]["stress_Pa"] < limit:
            between = max(int(STRAIN / self.rate / O.dt / SAMPLES), 1)
            self.box.globUpdate = between * SAMPLES
            borne = []
            for _ in range(SAMPLES):
                for _ in range(between):
                    O.step()
                borne.append(-numpy.trace(stresses.ofPackingByContacts(self.box.boxArea)) / 2)
            rows.append({**self._row(energy), "contact_stress_Pa": numpy.mean(borne), "cpu_s": cpu_seconds() - start})
            show(min(max(math.log10(rows[-1]["stress_Pa"] + 1) / math.log10(limit + 1), 0), 1),
                 f"rigid {self.rigid:.2f}  friction {self.friction:g}  solid fraction {rows[-1]['solid_fraction']:.3f}  "
                 f"stress {rows[-1]['stress_Pa'] / 1e3:.1f} kPa")
        return rows

    def _row(self, energy):
        area = self.box.boxArea
        work = self.box.externalWork
        missing = self._stored() - energy + self.soft.frictionDissipation + self.soft.contactDissipation - work
        coordination, rattlers, contacts = measures.coordination(measures.contactPairs(), self.ids, self.friction > 0)
        return {"rigid_fraction": self.rigid, "friction": self.friction, "time_s": O.time, "strain": self.box.strain[0],
                "solid_fraction": (self.soft.solidArea() + self.rigid_area) / area,
                "stress_Pa": numpy.mean(self.box.wallStress),
                "coordination": coordination, "rattlers": rattlers, "contacts": contacts, "max_penetration_over_R": self.soft.maxPenetration(),
                "energy_residual_over_work": missing / work if work > 0 else 0.0}

    def _stored(self):
        """Elastic energy, and kinetic energy of all discs [J/m]."""
        rigid = (O.bodies[i].state for i in self.ids if isinstance(O.bodies[i].shape, wrapper.Sphere))
        return (self.soft.elasticEnergy() + self.soft.kineticEnergy()
                + math.fsum((state.mass * state.vel.squaredNorm() + state.inertia[2] * state.angVel[2]**2) / 2 for state in rigid))


def fraction_at(table, case, stress):
    """Solid fraction at which the packing of a case, (rigid fraction, friction), first bears a stress [Pa], by interpolation in its
    logarithm; nan when it never does. `table`: columns of mixed_packing.csv."""
    rows = (table["rigid_fraction"] == case[0]) & (table["friction"] == case[1])
    fraction, borne = table["solid_fraction"][rows], numpy.log(numpy.maximum(table["stress_Pa"][rows], GROW))
    beyond = numpy.flatnonzero(borne >= math.log(stress))
    if not len(beyond) or beyond[0] == 0:
        return math.nan
    last = beyond[0]
    return float(numpy.interp(math.log(stress), borne[last - 1:last + 1], fraction[last - 1:last + 1]))


def jamming_fraction(table, case):
    """The same at the stress that counts as jamming."""
    return fraction_at(table, case, jamming.STRESS)
