// SPDX-License-Identifier: GPL-2.0-or-later
// What a world holds in total.
#pragma once

#include "support/world.hpp"

namespace softgrain::testing_support {

inline double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

struct Sums {
    Vec<2> momentum = Vec<2>::Zero();
    double angular = 0, size = 0; ///< angular momentum about the origin; m |v| of all
    explicit Sums(const World& world)
    {
        for (const auto& g : world.grains) {
            momentum += g.mass() * g.motion.velocity;
            size += g.mass() * g.motion.velocity.norm();
            angular += g.motion.angular_momentum[0] + g.mass() * cross(g.motion.position, g.motion.velocity);
        }
    }
};

} // namespace softgrain::testing_support
