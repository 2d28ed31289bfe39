// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "support/random.hpp"
#include "support/scene.hpp"

namespace softgrain::testing_support {

/// Four columns of three discs in a box whose top comes down at 1 m/s.
class TwelveDiscs {
public:
    static constexpr double width = 1e-2; ///< of the box [m]

    /// make(row, start, radius) makes a disc of row 0, 1 or 2; the radius in m.
    template <class Make>
    TwelveDiscs(Scene& scene, Make make)
        : scene_(scene)
    {
        Random random(7);
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 3; ++j) {
                GrainStart start;
                start.centre = 2.5e-3 * Vec<2>(i + 0.5, j + 0.5) + random.vector<2>(1e-4);
                start.angle = random.uniform(0, 7);
                const double radius = random.uniform(0.7e-3, 1.15e-3);
                area_ += M_PI * radius * radius;
                scene.add(make(j, start, radius));
            }
        scene.planes = { { 0, 1, 0, 0 }, { 0, -1, width, 0 }, { 1, 1, 0, 0 }, { 1, -1, 7.5e-3, -1 } };
    }

    /// Area of the undeformed discs over that of the box now.
    double solid_fraction() const { return area_ / (width * scene_.planes[3].position); }

private:
    Scene& scene_;
    double area_ = 0; ///< [m^2]
};

} // namespace softgrain::testing_support
