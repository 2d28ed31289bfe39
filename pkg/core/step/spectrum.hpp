// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/batch.hpp"

namespace softgrain {

/// Highest eigenvalue of M^-1 K of each grain of a batch as it is deformed, omega^2 density radius^2 [Pa], [lane]; from
/// below. That many steps of Lanczos (1950), each of one internal force; the vectors are not orthogonalised again, which
/// repeats eigenvalues and leaves the highest.
template <int Dim> void highest_eigenvalues(Batch<Dim>& batch, int steps, double* per_lane);

extern template void highest_eigenvalues<2>(Batch<2>&, int, double*);

} // namespace softgrain
