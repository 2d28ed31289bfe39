// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/surface.hpp"

#include <algorithm>
#include <vector>

namespace softgrain {

/// Bodies in a strip, about: fewer make more contacts between strips, more leave threads without work.
inline constexpr int strip_bodies = 60;
inline constexpr int most_strips = 32;

/// Strip of each body along the longer side of the scene; null: a body without contacts.
template <int Dim> std::vector<int> strips_of(const std::vector<const Surface<Dim>*>& bodies)
{
    Vec<Dim> lo = Vec<Dim>::Constant(1e300), hi = -lo;
    int soft = 0;
    for (const Surface<Dim>* body : bodies) {
        if (!body || body->mobility == 0) continue;
        ++soft;
        lo = lo.cwiseMin(body->min);
        hi = hi.cwiseMax(body->max);
    }
    const int count = std::clamp(soft / strip_bodies, 1, most_strips);
    int axis = 0;
    (hi - lo).maxCoeff(&axis);
    const double length = std::max(hi[axis] - lo[axis], 1e-300);
    std::vector<int> strips(bodies.size(), 0);
    for (size_t b = 0; b < bodies.size(); ++b) {
        if (!bodies[b]) continue;
        const double middle = ((bodies[b]->min[axis] + bodies[b]->max[axis]) / 2 - lo[axis]) / length;
        strips[b] = std::clamp(int(middle * count), 0, count - 1);
    }
    return strips;
}

} // namespace softgrain
