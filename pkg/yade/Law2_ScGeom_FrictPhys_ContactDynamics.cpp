// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law2_ScGeom_FrictPhys_ContactDynamics.hpp"

#include "Problems.hpp"

namespace yade {

YADE_PLUGIN((Law2_ScGeom_FrictPhys_ContactDynamics));

bool Law2_ScGeom_FrictPhys_ContactDynamics::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction)
{
    const auto& touch = static_cast<const ScGeom&>(*geom);
    auto* const effects = dynamic_cast<SoftPhys*>(phys.get());
    const Real radius = std::min(touch.refR1, touch.refR2);
    if (effects && effects->adhesionRange > seen * radius)
        Problems::note("bodies #" + std::to_string(interaction->id1) + " and #" + std::to_string(interaction->id2)
                       + ": the range of their adhesion is " + softgrain::shown(effects->adhesionRange)
                       + " m, and rigid bodies see each other from " + softgrain::shown(seen * radius)
                       + " m on, a tenth of the smaller radius; give a range up to that.");
    if (-touch.penetrationDepth > ahead * radius) return effects && effects->remembers();
    RigidPair pair { interaction->id1,
                     interaction->id2,
                     boost::static_pointer_cast<ScGeom>(geom),
                     boost::static_pointer_cast<FrictPhys>(phys),
                     effects,
                     {},
                     {} };
    for (auto [id, twist] : { std::make_pair(pair.id1, &pair.twist1), std::make_pair(pair.id2, &pair.twist2) })
        *twist = FreeBodies::twistOf(*FreeBodies::whole(*scene, (*scene->bodies)[id])->state);
    handed_.take(scene->iter, std::move(pair));
    return true;
}

} // namespace yade
