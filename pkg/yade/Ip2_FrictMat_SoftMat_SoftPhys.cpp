// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ip2_FrictMat_SoftMat_SoftPhys.hpp"

#include "Problems.hpp"

namespace yade {

YADE_PLUGIN((Ip2_FrictMat_SoftMat_SoftPhys)(Ip2_SoftMat_SoftMat_SoftPhys)(Ip2_FrictMat_FrictMat_SoftPhys));

namespace {
    /// Materials have no such number of their own: 0.
    Real ofPair(const shared_ptr<MatchMaker>& numbers, const FrictMat& first, const FrictMat& second)
    {
        return numbers ? (*numbers)(first.id, second.id, 0, 0) : 0;
    }

    void complain(const Interaction& pair, const char* what, const char* attribute, Real value, const char* range)
    {
        Problems::note("bodies #" + std::to_string(pair.id1) + " and #" + std::to_string(pair.id2) + ": their " + what
                       + " is " + softgrain::shown(value) + "; set " + attribute + " of the Ip2 functor for their materials "
                       + range + ".");
    }
} // namespace

void Ip2_FrictMat_SoftMat_SoftPhys::go(const shared_ptr<Material>& material1, const shared_ptr<Material>& material2,
                                       const shared_ptr<Interaction>& interaction)
{
    if (interaction->phys) return;
    const auto& first = static_cast<const FrictMat&>(*material1);
    const auto& second = static_cast<const FrictMat&>(*material2);
    const Real angle = frictAngle ? (*frictAngle)(first.id, second.id, first.frictionAngle, second.frictionAngle)
                                  : std::min(first.frictionAngle, second.frictionAngle);
    if (!(angle >= 0 && angle < M_PI / 2))
        Problems::note("bodies #" + std::to_string(interaction->id1) + " and #" + std::to_string(interaction->id2)
                       + ": their friction angle is " + softgrain::shown(angle)
                       + " rad; set frictionAngle of their materials in [0, pi/2).");
    auto phys = shared_ptr<SoftPhys>(new SoftPhys);
    phys->tangensOfFrictionAngle = std::tan(angle);
    if (en || et) takeImpact(first, second, *interaction, *phys);
    if (adhesion) takeAdhesion(first, second, *interaction, *phys);
    interaction->phys = phys;
}

void Ip2_FrictMat_SoftMat_SoftPhys::takeImpact(const FrictMat& first, const FrictMat& second, const Interaction& interaction,
                                               SoftPhys& phys) const
{
    phys.en = ofPair(en, first, second);
    phys.et = ofPair(et, first, second);
    for (const auto& [name, value] : { std::pair("en", phys.en), std::pair("et", phys.et) })
        if (!(value >= 0 && value <= 1)) complain(interaction, "coefficient of restitution", name, value, "in [0, 1]");
}

void Ip2_FrictMat_SoftMat_SoftPhys::takeAdhesion(const FrictMat& first, const FrictMat& second,
                                                 const Interaction& interaction, SoftPhys& phys) const
{
    phys.adhesion = ofPair(adhesion, first, second);
    phys.adhesionRange = ofPair(adhesionRange, first, second);
    phys.adhesionReversible = adhesionReversible;
    if (!(phys.adhesion >= 0 && std::isfinite(phys.adhesion)))
        complain(interaction, "tension of adhesion", "adhesion", phys.adhesion, "to 0 Pa or more, and finite");
    else if (phys.adhesion > 0 && !(phys.adhesionRange > 0 && std::isfinite(phys.adhesionRange)))
        complain(interaction, "range of adhesion", "adhesionRange", phys.adhesionRange, "above 0 m, and finite");
}

Real Ip2_FrictMat_SoftMat_SoftPhys::farthest() const
{
    if (!adhesion || !adhesionRange) return 0;
    Real range = adhesionRange->algo == "val" ? adhesionRange->val : 0;
    for (const Vector3r& match : adhesionRange->matches)
        range = std::max(range, match[2]);
    return std::isfinite(range) ? range : 0;
}

} // namespace yade
