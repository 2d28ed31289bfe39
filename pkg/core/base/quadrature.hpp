// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <array>
#include <utility>

namespace softgrain {

/// Gauss-Legendre rule of 16 points on [-1, 1], as (abscissa, weight); exact to degree 31.
const std::array<std::pair<double, double>, 16>& gauss_legendre_16();

} // namespace softgrain
