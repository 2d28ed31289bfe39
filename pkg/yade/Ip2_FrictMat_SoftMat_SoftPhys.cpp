// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ip2_FrictMat_SoftMat_SoftPhys.hpp"

#include "Problems.hpp"
#include "SoftPhys.hpp"

namespace yade {

YADE_PLUGIN((Ip2_FrictMat_SoftMat_SoftPhys)(Ip2_SoftMat_SoftMat_SoftPhys));

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
    interaction->phys = phys;
}

} // namespace yade
