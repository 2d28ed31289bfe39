// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SoftBoundaryController.hpp"

namespace yade {

class SoftWallController : public SoftBoundaryController {
public:
    YADE_CLASS_BASE_DOC_ATTRS(
            SoftWallController,
            SoftBoundaryController,
            "Presses a wall on grains with a given mean stress. See :yref:`SoftBoundaryController` for how, and for where the engine stands.",
            ((int, wall, -1, , "Id of the wall, a Wall normal to x or y whose sense tells on which side the grains are."))(
                    (Real, goal, NaN, , "Stress on the wall that is wanted, positive in compression [Pa]."))(
                    (Real, length, NaN, , "Length of the wall that the stress acts on [m]."))(
                    (Real, maxVelocity, NaN, , "Speed of the wall where nothing resists [m/s]; well below sqrt(goal / density), grains are pressed quasi-statically."))(
                    (Real, stress, NaN, Attr::readonly, "Mean stress on the wall in the last globUpdate steps [Pa]."))(
                    (Real, lastGoal, NaN, Attr::hidden, "Goal when the stress was last renewed [Pa].")));

protected:
    void steer(bool implicit) override;
    void publish(Real share) override { stress = share * gatheredForces[0] / length; }
    bool atGoal() const override { return isNear(stress, goal); }
    bool sameGoal() override { return std::exchange(lastGoal, goal) == goal; }
};
REGISTER_SERIALIZABLE(SoftWallController);

} // namespace yade
