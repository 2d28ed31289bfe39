# SPDX-License-Identifier: GPL-2.0-or-later
"""What can be asked of a packing in a box, of soft grains or of YADE's rigid discs: the same questions to both, so
that the same loop (press.py) drives and records them."""
import math

import yade.wrapper as wrapper
from yade import O, utils

from . import measures, summary


class SoftPacking:
    """All soft grains of the scene. InputError when there is no SoftIntegrator.

    frictional  whether two contacts hold a grain, see measures.coordination
    """

    def __init__(self, frictional):
        self.frictional = frictional
        self.bodies = measures.softBodies()
        self.ids = [body.id for body in self.bodies]
        self.integrator = measures.softIntegrator()
        self.points = measures.pointTotal()
        self.viscous = any(body.mat.viscosity > 0 for body in self.bodies)
        self.plastic = any(isinstance(body.mat, wrapper.PlasticMat) for body in self.bodies)

    def area(self):
        """Current area of the grains [m²]."""
        return self.integrator.solidArea()

    def contacts(self):
        """coordination, rattlers, contacts of the last step."""
        return measures.coordination(measures.contactPairs(), self.ids, self.frictional)

    def energies(self):
        """Energies now and works since the start [J/m]: csv columns."""
        soft = self.integrator
        return {"kinetic_J": soft.kineticEnergy(), "elastic_J": soft.elasticEnergy(),
                "external_work_J": soft.externalWork, "friction_J": soft.frictionDissipation,
                "contact_dissipation_J": soft.contactDissipation,
                **({"viscous_dissipation_J": soft.viscousDissipation} if self.viscous else {}),
                **({"plastic_dissipation_J": soft.plasticDissipation} if self.plastic else {}),
                **({"numerical_dissipation_J": soft.numericalDissipation} if self._implicit() else {})}

    def solver(self):
        """State of the solver in the last step: csv columns."""
        soft = self.integrator
        return {"min_J": soft.minJ(), "max_penetration_over_R": soft.maxPenetration(),
                "solver_residual": soft.residual(), **self._implicit()}

    def _implicit(self):
        """The same of implicit steps alone."""
        soft = self.integrator
        if not isinstance(soft, wrapper.SoftImplicitIntegrator):
            return {}
        return {"contact_distance_over_R": soft.contactDistance, "substeps": soft.totalSubsteps,
                "cut_steps": soft.totalCuts}

    def total_sweeps(self):
        """Sweeps of the contact solver since the scene was made, of implicit steps iterations [-]."""
        return self.integrator.totalIterations

    def stage_seconds(self):
        """Wall time by stage since the scene was made [s]."""
        return summary.stages()


class RigidPacking:
    """All spheres of the scene, taken as discs of unit thickness, with YADE's Cundall-Strack, which needs O.trackEnergy, or
    with Contact Dynamics. `frictional` as of SoftPacking."""

    def __init__(self, frictional):
        self.frictional = frictional
        self.bodies = [body for body in O.bodies if isinstance(body.shape, wrapper.Sphere)]
        self.ids = [body.id for body in self.bodies]
        self.radii = [body.shape.radius for body in self.bodies]
        self.points = len(self.bodies)
        self.integrator = next((engine for engine in O.engines if isinstance(engine, wrapper.SoftIntegrator)), None)

    def area(self):
        """Of the discs [m²]."""
        return math.pi * math.fsum(radius * radius for radius in self.radii)

    def contacts(self):
        """coordination, rattlers, contacts of the last step."""
        return measures.coordination(measures.rigidContactPairs(), self.ids, self.frictional)

    def energies(self):
        """Energies now and dissipations since the start [J/m]: csv columns. That of YADE's numerical damping stands in
        contact_dissipation_J; external_work_J is summed by the loop."""
        kinetic = {"kinetic_J": utils.kineticEnergy()}
        if self.integrator:
            return {**kinetic, "elastic_J": 0.0, "friction_J": self.integrator.frictionDissipation,
                    "contact_dissipation_J": self.integrator.contactDissipation}
        loop = next(engine for engine in O.engines if isinstance(engine, wrapper.InteractionLoop))
        tracked = dict(O.energy.items())
        return {**kinetic, "elastic_J": loop.lawDispatcher.functors[0].elasticEnergy(),
                "friction_J": tracked.get("plastDissip", 0.0), "contact_dissipation_J": tracked.get("nonviscDamp", 0.0)}

    def solver(self):
        """The deepest overlap, over the radius of the smaller disc: csv columns."""
        deepest = max((i.geom.penetrationDepth / min(i.geom.refR1, i.geom.refR2 if i.geom.refR2 > 0 else i.geom.refR1)
                       for i in O.interactions), default=0.0)
        residual = {"solver_residual": self.integrator.residual()} if self.integrator else {}
        return {"max_penetration_over_R": max(deepest, 0.0), **residual}

    def total_sweeps(self):
        """Of the contact solver; NaN where there is none."""
        return self.integrator.totalIterations if self.integrator else math.nan

    def stage_seconds(self):
        """Empty: there is no SoftIntegrator."""
        return {}
