// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/batch.hpp"

#include <functional>

namespace softgrain {

/// The linear map of which eigenvalues are sought, on vectors of the masters, [node][Dim][lane].
using Response = std::function<void(const AlignedVector&, AlignedVector&)>;

/// Highest eigenvalue of M^-1 times a response of each grain of a batch, M its node masses, [lane]; from below. That many steps
/// of Lanczos (1950), each of one response; the vectors are not orthogonalised again, which repeats eigenvalues and leaves the
/// highest.
template <int Dim> void lanczos(Batch<Dim>& batch, int steps, double* per_lane, const Response& respond);

/// Highest eigenvalue of M^-1 K of each grain of a batch as it is deformed, omega^2 density radius^2 [Pa], [lane].
template <int Dim> void highest_eigenvalues(Batch<Dim>& batch, int steps, double* per_lane);

extern template void highest_eigenvalues<2>(Batch<2>&, int, double*);
extern template void lanczos<2>(Batch<2>&, int, double*, const Response&);

} // namespace softgrain
