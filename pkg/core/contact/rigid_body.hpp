// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/types.hpp"

namespace softgrain {

/// A rigid body that impulses move. The surfaces that it shows to several others point to it.
template <int Dim> struct RigidBody {
    static constexpr int spins = Dim * (Dim - 1) / 2, twists = Dim + spins;
    using Twist = Vec<twists>;

    Vec<Dim> centre;            ///< of mass [m], at the start of the step
    Twist twist;                ///< velocity of the centre [m/s], then spin [rad/s]; the contact solver works on it
    Twist before;               ///< at the start of the step
    Twist gain = Twist::Zero(); ///< while the contact solver is at work: further change of the twist, by soft bodies
    /// Change of the twist by a unit impulse at the centre and a unit angular impulse [1/kg], [1/(kg m²)]; 0 where motion is
    /// blocked.
    Mat<twists> mobility;

    /// Velocities at a place that moves with the body, by a unit twist; transposed: what an impulse there sums up to.
    Eigen::Matrix<double, Dim, twists> lever(const Vec<Dim>& place) const
    {
        const Vec<Dim> arm = place - centre;
        Eigen::Matrix<double, Dim, twists> velocities;
        if constexpr (Dim == 2)
            velocities << 1, 0, -arm[1], 0, 1, arm[0];
        else
            velocities << 1, 0, 0, 0, arm[2], -arm[1], 0, 1, 0, -arm[2], 0, arm[0], 0, 0, 1, arm[1], -arm[0], 0;
        return velocities;
    }
};

} // namespace softgrain
