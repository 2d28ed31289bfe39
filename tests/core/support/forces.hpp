// SPDX-License-Identifier: GPL-2.0-or-later
// Internal forces and the stiffness of grains, seen from outside: a step from rest gives velocities dt f / m.
#pragma once

#include "step/assembly.hpp"
#include "support/grains.hpp"

namespace softgrain::testing_support {

/// Force on the masters of each grain, [node][Dim] [N/m]. Grains of one mesh and law go through wide lanes together, a
/// grain alone through one lane.
inline std::vector<std::vector<double>> forces(std::deque<Grain<2>> grains)
{
    constexpr double dt = 1e-9;
    for (auto& grain : grains)
        std::fill(grain.velocity.begin(), grain.velocity.end(), 0.0);
    {
        Assembly<2> assembly(pointers(grains));
        assembly.predict(dt, Vec<2>::Zero(), 1);
        assembly.correct(dt, 1);
    }
    std::vector<std::vector<double>> all;
    for (const auto& grain : grains) {
        std::vector<double> f(grain.velocity);
        for (size_t i = 0; i < f.size(); ++i)
            f[i] *= grain.density * std::pow(grain.radius, 3) * grain.mesh->node_mass[i / 2] / dt;
        all.push_back(f);
    }
    return all;
}

/// Lumped mass of each degree of freedom [kg/m].
inline Eigen::VectorXd masses(const Grain<2>& grain)
{
    Eigen::VectorXd m(grain.displacement.size());
    for (int i = 0; i < m.size(); ++i)
        m[i] = grain.density * grain.radius * grain.radius * grain.mesh->node_mass[i / 2];
    return m;
}

/// K = -df/du by central differences; error of the square of a strain of 1e-5, and of 1e-16 over it.
inline Eigen::MatrixXd stiffness(const Grain<2>& grain)
{
    const int size = int(grain.displacement.size());
    const double h = 1e-5 * grain.mesh->cell_width;
    Eigen::MatrixXd K(size, size);
    for (int j = 0; j < size; ++j) {
        std::deque<Grain<2>> pair { grain, grain };
        pair[0].displacement[j] += h;
        pair[1].displacement[j] -= h;
        const auto f = forces(pair);
        for (int i = 0; i < size; ++i)
            K(i, j) = -(f[0][i] - f[1][i]) / (2 * h * grain.radius);
    }
    return K;
}

struct Mode {
    double frequency; ///< [Hz]
    /// Kinetic energy of the material points in that of the lumped nodes: below 1, since splines smooth what nodes do; near
    /// 0 for motions from node to node that the material hardly follows.
    double share;
    std::vector<double> shape; ///< nodal velocities, [node][Dim] [radius/s]
};

/// All natural modes, lowest first, without the three rigid motions.
inline std::vector<Mode> modes(Grain<2> grain)
{
    const Eigen::VectorXd root = masses(grain).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd K = stiffness(grain), A = root.asDiagonal() * (K + K.transpose()) / 2 * root.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
    std::vector<Mode> all;
    for (int k = 3; k < A.rows(); ++k) {
        const Eigen::VectorXd v = root.asDiagonal() * solver.eigenvectors().col(k); // of kinetic energy 1/2
        grain.velocity.assign(v.data(), v.data() + v.size());
        const auto at_points = grain.point_velocities();
        double share = 0;
        for (size_t p = 0; p < at_points.size(); ++p)
            share += grain.density * grain.mesh->point_volume[p] * at_points[p].squaredNorm(); // radii cancel
        all.push_back({ std::sqrt(std::max(0.0, solver.eigenvalues()[k])) / (2 * M_PI), share, grain.velocity });
    }
    return all;
}

} // namespace softgrain::testing_support
