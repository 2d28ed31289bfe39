// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/batch.hpp"
#include "step/stiffness_pattern.hpp"

namespace softgrain {

/// Kernels with the stiffness of grains that share a pattern, for one lane and for eight; see stiffness_kernel.hpp.
struct StiffnessKernels {
    using Pattern = const StiffnessPattern<2>*;
    template <class... Arguments> using Pair = std::array<void (*)(Pattern, Arguments...), 2>;
    Pair<double*> factorise;                    ///< in place
    Pair<double*, double*> solve;               ///< with the factor: a vector, in place
    Pair<double*, double*, double*> compliance; ///< with the factor: room, then the compliance of the surface
};

const StiffnessKernels& stiffness_kernels();

} // namespace softgrain
