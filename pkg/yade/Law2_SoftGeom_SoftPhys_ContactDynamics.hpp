// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

#include "SoftGeom.hpp"
#include "SoftPhys.hpp"

namespace yade {

class Law2_SoftGeom_SoftPhys_ContactDynamics : public LawFunctor {
public:
    bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction) override;

    FUNCTOR2D(SoftGeom, SoftPhys);
    YADE_CLASS_BASE_DOC(
            Law2_SoftGeom_SoftPhys_ContactDynamics,
            LawFunctor,
            "Contact Dynamics (Moreau 1994; Jean 1999): Signorini's condition in velocities with the gap, 0 ≤ rₙ ⊥ uₙ + g/dt ≥ 0, and Coulomb's "
            "friction |rₜ| ≤ μ rₙ, without stiffness or damping. The functor hands each pair its local law; all contacts together are "
            "solved by :yref:`SoftIntegrator`.");
};
REGISTER_SERIALIZABLE(Law2_SoftGeom_SoftPhys_ContactDynamics);

} // namespace yade
