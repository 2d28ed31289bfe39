// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/dem/FrictPhys.hpp>

#include "law/contact_law.hpp"

namespace yade {

class SoftPhys : public FrictPhys {
public:
    /// The local contact law, set by the Law2 functor in every step.
    const softgrain::ContactLaw<2>* law = nullptr;

    bool rebounds() const { return en > 0 || et > 0; }
    bool adheres() const { return adhesion > 0; }
    /// Of bodies that stand apart: whether the pair has to remember that they have come apart.
    bool remembers();

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftPhys,
            FrictPhys,
            "Friction and forces of a contact of soft grains under Contact Dynamics: tangensOfFrictionAngle is Coulomb's coefficient; normalForce "
            "and shearForce are the sums over the contact points on body id2 in the last step [N/m]; there is no stiffness, kn and ks stay 0.",
            ((Vector3r, contactPoint, Vector3r::Zero(), , "Mean of the contact points, weighted with their normal forces [m]."))(
                    (Real, en, 0, Attr::readonly, "Coefficient of normal restitution [-], see :yref:`Ip2_FrictMat_SoftMat_SoftPhys`."))(
                    (Real, et, 0, Attr::readonly, "Coefficient of tangential restitution [-]."))(
                    (Real, adhesion, 0, Attr::readonly, "Tension of adhesion [Pa]."))(
                    (Real, adhesionRange, 0, Attr::readonly, "Gap up to which it acts [m]."))(
                    (bool, adhesionReversible, true, Attr::readonly, "Surfaces that have come apart attract each other again."))(
                    (vector<int>, held, , Attr::readonly, "Irreversible adhesion: surface points that it holds; of two rigid bodies [0] or []."))(
                    (vector<int>, parted, , Attr::readonly, "Irreversible adhesion: surface points that have come apart."))(
                    (Real, pull, 0, Attr::readonly, "Force of adhesion between two rigid bodies in the last step, in normalForce too [N/m].")),
            createIndex(););
    REGISTER_CLASS_INDEX(SoftPhys, FrictPhys);
};
REGISTER_SERIALIZABLE(SoftPhys);

} // namespace yade
