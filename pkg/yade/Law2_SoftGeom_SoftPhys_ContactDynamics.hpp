// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

#include "HandedOver.hpp"
#include "SoftPairs.hpp"

namespace yade {

class Law2_SoftGeom_SoftPhys_ContactDynamics : public LawFunctor {
public:
    bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction) override;
    /// Moves the pairs of a step to the end of `pairs`, in no certain order.
    void handOver(long step, std::vector<TouchingPair>& pairs) { handed_.to(step, pairs); }

    FUNCTOR2D(SoftGeom, SoftPhys);
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            Law2_SoftGeom_SoftPhys_ContactDynamics,
            LawFunctor,
            "Contact Dynamics (Moreau 1994; Jean 1999): Signorini's condition in velocities with the gap, 0 ≤ rₙ ⊥ uₙ + g/dt ≥ 0, and Coulomb's "
            "friction |rₜ| ≤ μ rₙ, without stiffness or damping. The functor hands each pair over with its local law; all contacts together are "
            "solved by :yref:`SoftIntegrator`.",
            ,);

private:
    HandedOver<TouchingPair> handed_;
};
REGISTER_SERIALIZABLE(Law2_SoftGeom_SoftPhys_ContactDynamics);

} // namespace yade
