// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/types.hpp"

#include <array>

namespace softgrain {

/// Values and slopes of the three quadratic B-splines that cover one cell of a uniform grid, knots at the
/// cell's ends (de Boor 1978; in MPM: Steffen, Kirby, Berzins 2008).
struct QuadraticBSpline {
    std::array<double, 3> value, slope; ///< slope per cell width

    /// `from_middle`: position in the cell, in cell widths from the cell's middle, in [-1/2, 1/2].
    explicit QuadraticBSpline(double from_middle)
    {
        const double a = 0.5 - from_middle, b = 0.5 + from_middle;
        value = { a * a / 2, 0.75 - from_middle * from_middle, b * b / 2 };
        slope = { -a, -2 * from_middle, b };
    }
};

} // namespace softgrain
