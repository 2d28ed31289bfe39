// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/batch.hpp"
#include "step/stiffness_pattern.hpp"

namespace softgrain {

/// Kernels with the stiffness of a batch; see stiffness_kernel.hpp.
struct StiffnessKernels {
    using Pattern = const StiffnessPattern<2>*;
    KernelPair<2, Pattern, double*> factorise;      ///< in place
    KernelPair<2, Pattern, double*, double*> solve; ///< with the factor: a vector, in place
    KernelPair<2, Pattern, double*, double*, double*>
        compliance; ///< with the factor: room, then the compliance of the surface
};

const StiffnessKernels& stiffness_kernels();

} // namespace softgrain
