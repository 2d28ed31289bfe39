// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/IPhys.hpp>

#include "law/contact_law.hpp"

namespace yade {

class SoftPhys : public IPhys {
public:
    /// The local contact law, set by the Law2 functor in every step.
    const softgrain::ContactLaw<2>* law = nullptr;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftPhys,
            IPhys,
            "Physical properties and forces of a contact of soft grains under Contact Dynamics: no stiffness.",
            ((Real, friction, 0, , "Coulomb's coefficient of friction [-]."))(
                    (Vector3r, normalForce, Vector3r::Zero(), , "Sum of the normal forces on body id2 in the last step [N/m]."))(
                    (Vector3r, shearForce, Vector3r::Zero(), , "Sum of the friction forces on body id2 in the last step [N/m]."))(
                    (Vector3r, contactPoint, Vector3r::Zero(), , "Mean of the contact points, weighted with their normal forces [m].")),
            createIndex(););
    REGISTER_CLASS_INDEX(SoftPhys, IPhys);
};
REGISTER_SERIALIZABLE(SoftPhys);

} // namespace yade
