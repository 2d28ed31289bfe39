// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

#include "RigidPairs.hpp"

namespace yade {

class Law2_ScGeom_FrictPhys_ContactDynamics : public LawFunctor {
public:
    bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction) override;
    /// Moves the pairs of a step to the end of `pairs`, in no certain order.
    void handOver(long step, std::vector<RigidPair>& pairs) { handed_.to(step, pairs); }

    FUNCTOR2D(ScGeom, FrictPhys);
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            Law2_ScGeom_FrictPhys_ContactDynamics,
            LawFunctor,
            "Contact Dynamics (Moreau 1994; Jean 1999) between YADE's rigid bodies: Signorini's condition in velocities with the gap, 0 ≤ rₙ ⊥ uₙ + "
            "g/dt ≥ 0, and Coulomb's friction |rₜ| ≤ μ rₙ; kn and ks of the FrictPhys count for nothing, and a :yref:`SoftPhys` brings restitution "
            "and adhesion. In the xy-plane: bodies are kept there by "
            "'zXY' in their blockedDOFs. All contacts, those of soft grains too, are solved together by :yref:`SoftIntegrator`; "
            "softgrain.rigidContacts() makes the functors that go with it.",
            ((Real, ahead, 0.2, , "Gap from which on an interaction is given up [radius of the smaller body].")),
            );

private:
    static constexpr Real seen = 0.1; ///< gap from which on pairs are there [radius of the smaller body], by rigidContacts()
    HandedOver<RigidPair> handed_;
};
REGISTER_SERIALIZABLE(Law2_ScGeom_FrictPhys_ContactDynamics);

} // namespace yade
