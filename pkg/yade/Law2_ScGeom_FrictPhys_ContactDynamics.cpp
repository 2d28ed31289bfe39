// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law2_ScGeom_FrictPhys_ContactDynamics.hpp"

namespace yade {

YADE_PLUGIN((Law2_ScGeom_FrictPhys_ContactDynamics));

bool Law2_ScGeom_FrictPhys_ContactDynamics::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction)
{
    const auto& touch = static_cast<const ScGeom&>(*geom);
    if (-touch.penetrationDepth > ahead * std::min(touch.refR1, touch.refR2)) return false;
    RigidPair pair { interaction->id1,
                     interaction->id2,
                     boost::static_pointer_cast<ScGeom>(geom),
                     boost::static_pointer_cast<FrictPhys>(phys),
                     {},
                     {} };
    for (auto [id, twist] : { std::make_pair(pair.id1, &pair.twist1), std::make_pair(pair.id2, &pair.twist2) })
        *twist = FreeBodies::twistOf(*FreeBodies::whole(*scene, (*scene->bodies)[id])->state);
    handed_.take(scene->iter, std::move(pair));
    return true;
}

} // namespace yade
