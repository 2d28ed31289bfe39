// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/types.hpp"

#include <vector>

namespace softgrain {

/// Weights of the linear extrapolation of values at `from` to the place `at`, by moving least squares with weights of the
/// fourth inverse power of distance: c = W A G a, G = (A' W A)^-1, A the rows (1, x - at), a = (1, 0 ...). Lines are
/// reproduced. False when the places do not determine a linear function well.
template <int Dim>
bool extrapolate(const Vec<Dim>& at, const std::vector<Vec<Dim>>& from, double width, std::vector<double>& weights)
{
    using Normal = Mat<Dim + 1>;
    if (int(from.size()) <= Dim) return false;
    Normal normal = Normal::Zero();
    const auto row = [&](const Vec<Dim>& x) {
        Vec<Dim + 1> a;
        a << 1, (x - at) / width;
        return a;
    };
    const auto weight = [](const Vec<Dim + 1>& a) {
        const double squared_distance = a.template tail<Dim>().squaredNorm();
        return 1 / (squared_distance * squared_distance);
    };
    for (const Vec<Dim>& x : from) {
        const Vec<Dim + 1> a = row(x);
        normal += weight(a) * a * a.transpose();
    }
    const Eigen::FullPivLU<Normal> solver(normal);
    if (!solver.isInvertible() || solver.rcond() < 1e-4) return false;
    const Vec<Dim + 1> first = solver.solve(Vec<Dim + 1>::Unit(0));
    weights.clear();
    for (const Vec<Dim>& x : from) {
        const Vec<Dim + 1> a = row(x);
        weights.push_back(weight(a) * a.dot(first));
    }
    return true;
}

} // namespace softgrain
