// SPDX-License-Identifier: GPL-2.0-or-later
// A discretisation's operators as dense matrices, written down from its tables the obvious way.
#pragma once

#include "grid/discretisation.hpp"

namespace softgrain::testing_support {

/// All nodes from the masters, [node][master].
inline Eigen::MatrixXd extension(const Discretisation<2>& mesh)
{
    Eigen::MatrixXd E = Eigen::MatrixXd::Zero(mesh.node_count(), mesh.master_count);
    E.topRows(mesh.master_count).setIdentity();
    mesh.each_link([&](int slave, int master, double weight) { E(slave, master) += weight; });
    return E;
}

/// Surface points from the masters, [point][master].
inline Eigen::MatrixXd surface_interpolation(const Discretisation<2>& mesh)
{
    Eigen::MatrixXd N = Eigen::MatrixXd::Zero(mesh.surface_count(), mesh.node_count());
    for (int p = 0; p < mesh.surface_count(); ++p)
        for (size_t k = 0; k < mesh.surface_stencil[p].node.size(); ++k)
            N(p, mesh.surface_stencil[p].node[k]) += mesh.surface_stencil[p].weight[k];
    return N * extension(mesh);
}

/// N M^-1 N^T of the surface points, per unit density and radius^2.
inline Eigen::MatrixXd dense_delassus(const Discretisation<2>& mesh)
{
    const Eigen::MatrixXd N = surface_interpolation(mesh);
    const Eigen::VectorXd mass = Eigen::Map<const Eigen::VectorXd>(mesh.node_mass.data(), mesh.master_count);
    return N * mass.cwiseInverse().asDiagonal() * N.transpose();
}

} // namespace softgrain::testing_support
