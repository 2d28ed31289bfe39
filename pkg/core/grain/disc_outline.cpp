// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/quadrature.hpp"
#include "grain/outline.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {

Box<2> DiscOutline::bounds() const { return { Vec<2>(-1, -1), Vec<2>(1, 1) }; }

Moments<2> DiscOutline::moments() const { return { M_PI, Vec<2>::Zero(), M_PI / 4 * Mat<2>::Identity() }; }

Moments<2> DiscOutline::moments(const Box<2>& box) const
{
    // Columns x = cos(theta): between two breakpoints the column's ends are either the box's or the circle's,
    // so that the integrands are trigonometric polynomials and Gauss-Legendre converges to round-off.
    const double x0 = std::max(box.min.x(), -1.0), x1 = std::min(box.max.x(), 1.0);
    if (x0 >= x1) return {};
    std::vector<double> breaks { std::acos(x1), std::acos(x0) };
    for (double y : { box.min.y(), box.max.y() })
        if (std::abs(y) < 1)
            for (double theta : { std::asin(std::abs(y)), M_PI - std::asin(std::abs(y)) })
                if (theta > breaks[0] && theta < breaks[1]) breaks.push_back(theta);
    std::sort(breaks.begin(), breaks.end());

    Moments<2> sum;
    for (size_t k = 0; k + 1 < breaks.size(); ++k) {
        const double middle = (breaks[k] + breaks[k + 1]) / 2, half = (breaks[k + 1] - breaks[k]) / 2;
        for (const auto& [abscissa, weight] : gauss_legendre_16()) {
            const double theta = middle + half * abscissa, x = std::cos(theta), s = std::sin(theta);
            const double lo = std::max(box.min.y(), -s), hi = std::min(box.max.y(), s);
            if (hi <= lo) continue;
            const double dx = weight * half * s; // |dx| = sin(theta) dtheta
            const double m0 = hi - lo, m1 = (hi * hi - lo * lo) / 2, m2 = (hi * hi * hi - lo * lo * lo) / 3;
            sum.volume += dx * m0;
            sum.first += dx * Vec<2>(x * m0, m1);
            sum.second(0, 0) += dx * x * x * m0;
            sum.second(0, 1) += dx * x * m1;
            sum.second(1, 1) += dx * m2;
        }
    }
    sum.second(1, 0) = sum.second(0, 1);
    return sum;
}

std::vector<BoundaryPoint<2>> DiscOutline::sample(double spacing) const
{
    // The error of a contact's force is periodic in the place of its middle between two points. With an odd number of
    // points, places on opposite sides differ by half a distance, and odd harmonics of that error cancel between two
    // plates. The first point stands an eighth of a distance off the x axis, which takes the second one out along both axes.
    const int count = std::max(8, int(std::ceil(2 * M_PI / spacing - 1e-9))) | 1;
    std::vector<BoundaryPoint<2>> points(count);
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * M_PI * (i + 0.125) / count;
        points[i] = { Vec<2>(std::cos(angle), std::sin(angle)), 2 * M_PI / count, false };
    }
    return points;
}

} // namespace softgrain
