// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>
#include <pkg/common/MatchMaker.hpp>

#include "SoftMat.hpp"
#include "SoftPhys.hpp"

namespace yade {

class Ip2_FrictMat_SoftMat_SoftPhys : public IPhysFunctor {
public:
    void go(const shared_ptr<Material>& material1, const shared_ptr<Material>& material2,
            const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(FrictMat, SoftMat);
    YADE_CLASS_BASE_DOC_ATTRS(
            Ip2_FrictMat_SoftMat_SoftPhys,
            IPhysFunctor,
            "Contact of a soft grain with a body of :yref:`FrictMat`: friction, tan of the smaller friction angle unless frictAngle says otherwise; "
            "restitution by Newton's law of impact (Moreau 1994) and adhesion by Dugdale's law (Dugdale 1960; Maugis 1992), both none unless asked "
            "for, and both for :yref:`SoftIntegrator` alone. Numbers of a pair are those at its first touch.",
            ((shared_ptr<MatchMaker>,
              frictAngle,
              ,
              ,
              "Friction angle of a pair of materials [rad], from their ids and angles; none: the smaller of the two."))(
                    (shared_ptr<MatchMaker>,
                     en,
                     ,
                     ,
                     "Coefficient of normal restitution of surface points [-], 0 to 1, from the ids of the materials. It is no coefficient of whole grains: "
                     "these rebound by their elasticity."))(
                    (shared_ptr<MatchMaker>, et, , , "Coefficient of tangential restitution [-], 0 to 1; acts as far as friction bears it."))(
                    (shared_ptr<MatchMaker>, adhesion, , , "Tension between surfaces that are nearer than adhesionRange [Pa]."))(
                    (shared_ptr<MatchMaker>, adhesionRange, , , "Gap up to which adhesion acts [m]; times adhesion: the work of adhesion [J/m²]."))(
                    (bool, adhesionReversible, true, , "Surfaces that have come apart attract each other again.")));

    /// The largest adhesionRange of any pair [m].
    Real farthest() const;

private:
    void takeImpact(const FrictMat& first, const FrictMat& second, const Interaction& interaction, SoftPhys& phys) const;
    void takeAdhesion(const FrictMat& first, const FrictMat& second, const Interaction& interaction, SoftPhys& phys) const;
};
REGISTER_SERIALIZABLE(Ip2_FrictMat_SoftMat_SoftPhys);

class Ip2_SoftMat_SoftMat_SoftPhys : public Ip2_FrictMat_SoftMat_SoftPhys {
public:
    FUNCTOR2D(SoftMat, SoftMat);
    YADE_CLASS_BASE_DOC(
            Ip2_SoftMat_SoftMat_SoftPhys,
            Ip2_FrictMat_SoftMat_SoftPhys,
            "Friction of two soft grains, as :yref:`Ip2_FrictMat_SoftMat_SoftPhys`.");
};
REGISTER_SERIALIZABLE(Ip2_SoftMat_SoftMat_SoftPhys);

class Ip2_FrictMat_FrictMat_SoftPhys : public Ip2_FrictMat_SoftMat_SoftPhys {
public:
    FUNCTOR2D(FrictMat, FrictMat);
    YADE_CLASS_BASE_DOC(
            Ip2_FrictMat_FrictMat_SoftPhys,
            Ip2_FrictMat_SoftMat_SoftPhys,
            "Friction, restitution and adhesion of two rigid bodies for :yref:`Law2_ScGeom_FrictPhys_ContactDynamics`, as "
            ":yref:`Ip2_FrictMat_SoftMat_SoftPhys`. Restitution is that of the bodies here.");
};
REGISTER_SERIALIZABLE(Ip2_FrictMat_FrictMat_SoftPhys);

} // namespace yade
