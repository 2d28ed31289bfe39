// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/quadrature.hpp"

#include <cmath>

namespace softgrain {

const std::array<std::pair<double, double>, 16>& gauss_legendre_16()
{
    static const auto rule = [] {
        constexpr int n = 16;
        std::array<std::pair<double, double>, n> points;
        for (int i = 0; i < n; ++i) {
            // Newton on P_n from Chebyshev's estimate of the root; P_n by its three-term recurrence
            double x = std::cos(M_PI * (i + 0.75) / (n + 0.5)), slope = 0;
            for (int iteration = 0; iteration < 50; ++iteration) {
                double p = 1, previous = 0;
                for (int k = 1; k <= n; ++k) {
                    const double next = ((2 * k - 1) * x * p - (k - 1) * previous) / k;
                    previous = p;
                    p = next;
                }
                slope = n * (x * p - previous) / (x * x - 1);
                const double correction = p / slope;
                x -= correction;
                if (std::abs(correction) < 1e-16) break;
            }
            points[i] = { x, 2 / ((1 - x * x) * slope * slope) };
        }
        return points;
    }();
    return rule;
}

} // namespace softgrain
