// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace softgrain {

/// Force against a slide d of a contact that bears b at most, and its slope; see ImplicitStep.
struct SmoothedFriction {
    double force, slope, energy;
    SmoothedFriction(double d, double b, double kappa)
    {
        const double root = std::sqrt(kappa * kappa + b * b * d * d), sum = kappa + root;
        force = sum > 0 ? b * b * d / sum : 0;
        slope = root > 0 ? b * b / sum : 0; // secant
        energy = root - kappa - (kappa > 0 ? kappa * std::log(sum / (2 * kappa)) : 0);
    }
    /// Slope for a force t of its own (Chan, Golub and Mulet 1999).
    static double slope_for(double t, double d, double b, double kappa)
    {
        const double root = std::sqrt(kappa * kappa + b * b * d * d);
        return b * b * (1 - std::abs(t * d) / std::max(root, 1e-300)) / (kappa + root);
    }
};

} // namespace softgrain
