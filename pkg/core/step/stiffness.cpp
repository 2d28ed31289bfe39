// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/stiffness.hpp"

#include "step/stiffness_kernel.hpp"
#include "step/versions.hpp"

namespace softgrain {

const StiffnessKernels& stiffness_kernels()
{
    using Pattern = StiffnessKernels::Pattern;
    static const StiffnessKernels all { Versions<kernels::Factorise, Pattern, double*>::table(),
                                        Versions<kernels::Solve, Pattern, double*, double*>::table(),
                                        Versions<kernels::Compliance, Pattern, double*, double*, double*>::table() };
    return all;
}

} // namespace softgrain
