// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law2_SoftGeom_SoftPhys_ContactDynamics.hpp"

namespace yade {

YADE_PLUGIN((Law2_SoftGeom_SoftPhys_ContactDynamics));

bool Law2_SoftGeom_SoftPhys_ContactDynamics::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction)
{
    static const softgrain::SignoriniCoulomb<2> law;
    auto& contact = static_cast<SoftPhys&>(*phys);
    if (!static_cast<SoftGeom&>(*geom).near()) return contact.remembers();
    contact.law = &law;
    handed_.take(scene->iter,
                 { interaction->id1, interaction->id2, boost::static_pointer_cast<SoftGeom>(geom),
                   boost::static_pointer_cast<SoftPhys>(phys) });
    return true;
}

} // namespace yade
