// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftPhys.hpp"

#include "solver/adhesion.hpp"

namespace yade {

YADE_PLUGIN((SoftPhys));

bool SoftPhys::remembers()
{
    if (adhesionReversible || (held.empty() && parted.empty())) return false;
    softgrain::Bonds bonds { held, parted };
    bonds.hold({});
    held.clear();
    parted = bonds.parted;
    normalForce = shearForce = contactPoint = Vector3r::Zero();
    pull = 0;
    return true;
}

} // namespace yade
