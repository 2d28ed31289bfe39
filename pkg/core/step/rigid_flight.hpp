// SPDX-License-Identifier: GPL-2.0-or-later
// Grains in flight: nothing touches them, and they hardly deform or vibrate. They move as rigid bodies (Grain::flight), with
// their nodes as these are, until something comes near. For translation of an undeformed grain that is exact.
#pragma once

#include "step/grain.hpp"

namespace softgrain {

/// Elastic energies of the grains of a batch over the last step, per radius^Dim [J/m^Dim], [lane]: 2 E(u - dt v / 2)
/// - [E(u) + E(u - dt v)] / 2. Velocities stand half a step behind displacements; with the kinetic energy this is what symplectic
/// Euler conserves, exactly where the force is linear (for one spring, k u_n u_(n+1) / 2), and it differs from E by O(dt^2).
template <int Dim> void energy_over_step(Batch<Dim>& batch, double dt, std::vector<double>& energy);

/// Undeformed, and moves without turning: no forces but round-off. Of the fields that the grain holds.
template <int Dim> bool only_translates(const Grain<Dim>& grain);
/// The energy of deformation and vibration is no more than that of a shear by `tolerance` shear moduli in all points, and spin
/// strains the grain by no more than that. Brings the node fields from the batch to find out.
template <int Dim> bool is_nearly_rigid(Grain<Dim>& grain, double tolerance);

/// From now on it is in flight, with the fields that it holds; without what vibrated.
template <int Dim> void take_off(Grain<Dim>& grain);
/// A step of a grain in flight, accelerated as a whole; `damping` as of local_damping.hpp. Returns what that dissipates [J].
template <int Dim> double accelerate(Grain<Dim>& grain, double dt, const Vec<Dim>& gravity, double damping);
/// False when it stays where it is.
template <int Dim> bool fly(Grain<Dim>& grain, double dt);
/// Node fields of a grain in flight; positions of its surface points.
template <int Dim> void write_nodes(Grain<Dim>& grain);
template <int Dim> void write_positions(Grain<Dim>& grain);
/// What is to be saved of a flight, besides the displacements when it began.
template <int Dim> std::vector<double> packed_flight(const Grain<Dim>& grain);
/// The reverse, of a grain that holds these displacements; false when the size does not fit.
template <int Dim> bool unpack_flight(const std::vector<double>& values, Grain<Dim>& grain);
/// Out of flight, with the velocities that it has.
template <int Dim> void land(Grain<Dim>& grain);

} // namespace softgrain
