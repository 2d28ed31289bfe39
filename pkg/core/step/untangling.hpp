// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/grain.hpp"

namespace softgrain {

/// Brings a total-Lagrangian grain some of whose points are turned inside out, or pressed to nothing, into a state from which
/// steps can go on: J >= least_J (0 to 1) at every material point, and a boundary that does not cross itself. Its nodes come as
/// near to where they are, u0, as a barrier lets them: the place reached minimises
///     hold / 2 |u - u0|^2_m + sum over points of V_p a(F_p)^4,    a = (|F|^2 + J^2 + 1) / 4J
/// (in the plane 1 where F is a rotation, infinite where J = 0; Garanzha et al. 2021). It is followed from the undeformed grain
/// nearest to u0 on, inside of J > 0, while `hold` grows, until J or the boundary would not do any more. Centre of mass and node
/// velocities stay; a grain that is sound stays as it is. The node fields are those held by the grain (Grain::pull); surface and
/// motion are renewed. Throws UserError for another least_J and for displacements that are not finite.
template <int Dim> void untangle(Grain<Dim>& grain, double least_J);

/// a(F)^4 at a point with J > 0, its gradient, and its second derivative with negative eigenvalues set to zero; components of F
/// row by row.
template <int Dim> struct UntanglingEnergy {
    static constexpr int size = Dim * Dim;
    double value;
    Eigen::Matrix<double, size, 1> slope;
    Eigen::Matrix<double, size, size> curvature;

    explicit UntanglingEnergy(const Mat<Dim>& F);
};

extern template void untangle<2>(Grain<2>&, double);
extern template struct UntanglingEnergy<2>;

} // namespace softgrain
