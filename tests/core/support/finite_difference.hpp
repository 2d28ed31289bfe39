// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <functional>
#include <vector>

namespace softgrain::testing_support {

/// Gradient of a function of n variables, the one oracle of every derivative in the core:
///     df/dx_i = (8 (f(x + h) - f(x - h)) - (f(x + 2h) - f(x - 2h))) / 12 h + O(h^4),
/// with round-off of about eps |f| / h.
inline std::vector<double> central_gradient(const std::function<double(const std::vector<double>&)>& f,
                                            std::vector<double> x, double h)
{
    std::vector<double> gradient;
    for (double& variable : x) {
        const double here = variable;
        const auto value = [&](double step) {
            variable = here + step;
            return f(x);
        };
        const double near = value(h) - value(-h), far = value(2 * h) - value(-2 * h);
        variable = here;
        gradient.push_back((8 * near - far) / (12 * h));
    }
    return gradient;
}

} // namespace softgrain::testing_support
