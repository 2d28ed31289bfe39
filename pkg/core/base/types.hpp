// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <Eigen/Dense>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace softgrain {

template <int Dim> using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim> using Mat = Eigen::Matrix<double, Dim, Dim>;

/// Integer power, for sizes such as nodes in a stencil: 3^Dim.
constexpr int power(int base, int exponent) { return exponent == 0 ? 1 : base * power(base, exponent - 1); }

/// Threads for so many pieces of work: one that nobody has to wait for costs nothing, a team does.
inline int team(int threads, size_t pieces) { return int(std::clamp<size_t>(pieces, 1, size_t(std::max(1, threads)))); }

/// A user's mistake: one sentence that names the object, the value and the fix.
class UserError : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

/// The computation cannot go on (a point inverted, a value is not finite).
class SimulationError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A number as a sentence shows it, with so many significant digits.
std::string shown(double value, int digits = 6);

} // namespace softgrain
