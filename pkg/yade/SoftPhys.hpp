// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/dem/FrictPhys.hpp>

#include "law/contact_law.hpp"

namespace yade {

class SoftPhys : public FrictPhys {
public:
    /// The local contact law, set by the Law2 functor in every step.
    const softgrain::ContactLaw<2>* law = nullptr;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftPhys,
            FrictPhys,
            "Friction and forces of a contact of soft grains under Contact Dynamics: tangensOfFrictionAngle is Coulomb's coefficient; normalForce "
            "and shearForce are the sums over the contact points on body id2 in the last step [N/m]; there is no stiffness, kn and ks stay 0.",
            ((Vector3r, contactPoint, Vector3r::Zero(), , "Mean of the contact points, weighted with their normal forces [m].")),
            createIndex(););
    REGISTER_CLASS_INDEX(SoftPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(SoftPhys);

} // namespace yade
