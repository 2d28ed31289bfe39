// SPDX-License-Identifier: GPL-2.0-or-later
// Viscosity of the solid (Kelvin-Voigt): beside the elastic stress acts
//
//     sigma = 2 eta (D - tr D / 3 1),        P = sigma cof F,
//
// D the symmetric part of the velocity gradient dF/dt F^-1 in space: no stress in rigid motion, and none by change of volume
// (Stokes's hypothesis). Grains without it do not come here.
#pragma once

#include "step/batch.hpp"

namespace softgrain {

/// Adds viscous forces at the present displacements and velocities of a batch with viscosities to its forces, masters only, and
/// keeps what they give in a step as Batch::viscous.
template <int Dim> void add_viscous_force(Batch<Dim>& batch, double dt);

/// What these impulses take from the grain in a lane at its present velocities, per radius^Dim [J/m^Dim]. The mean of that
/// before the kick and after all impulses is what the scheme loses by them.
template <int Dim> double viscous_loss(const Batch<Dim>& batch, int lane);

/// Highest eigenvalue of M^-1 C of an undeformed grain for a viscosity and an inertia of 1 [1/(density radius^2)], C the
/// derivative of the viscous force by velocities; from below, as highest_eigenvalues.
template <int Dim> double highest_viscous_eigenvalue(const std::shared_ptr<const Discretisation<Dim>>& mesh);

extern template void add_viscous_force<2>(Batch<2>&, double);
extern template double viscous_loss<2>(const Batch<2>&, int);
extern template double highest_viscous_eigenvalue<2>(const std::shared_ptr<const Discretisation<2>>&);

} // namespace softgrain
