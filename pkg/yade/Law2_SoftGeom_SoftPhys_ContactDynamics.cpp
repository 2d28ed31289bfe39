// SPDX-License-Identifier: GPL-2.0-or-later
#include "Law2_SoftGeom_SoftPhys_ContactDynamics.hpp"

namespace yade {

YADE_PLUGIN((Law2_SoftGeom_SoftPhys_ContactDynamics));

bool Law2_SoftGeom_SoftPhys_ContactDynamics::go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction*)
{
    static const softgrain::SignoriniCoulomb<2> law;
    static_cast<SoftPhys&>(*phys).law = &law;
    return static_cast<SoftGeom&>(*geom).near();
}

} // namespace yade
