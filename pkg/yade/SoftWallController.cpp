// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftWallController.hpp"

namespace yade {

YADE_PLUGIN((SoftWallController));

void SoftWallController::steer(bool implicit)
{
    demand(goal >= 0 && std::isfinite(goal), "goal", goal, "be a stress of 0 or more, positive in compression");
    demand(length > 0 && std::isfinite(length), "length", length, "be positive and finite");
    demand(maxVelocity > 0 && std::isfinite(maxVelocity), "maxVelocity", maxVelocity, "be positive and finite");
    ControlledWall controlled(*scene, getClassName(), wall);
    gather(controlled, 0);
    press(controlled, 0, { goal * length, maxVelocity }, implicit);
}

} // namespace yade
