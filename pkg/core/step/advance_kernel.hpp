// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/kernels.hpp"

namespace softgrain::kernels {

/// Makes the points remember the end of a step; what was dissipated.
template <int Dim, class Law> struct Advance {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* dissipated)
    {
        constexpr int points = power(2, Dim);
        T p[Law::parameters.size() + Law::memory.size()], sum {};
        for (size_t k = 0; k < Law::parameters.size(); ++k)
            p[k] = item<T, L>(data.parameters, k);
        for (int r = 0; r < data.region_count; ++r) {
            const auto& region = data.regions[r];
            double* memory = memory_of<Dim, Law, L>(data, r);
            const auto remembered = field<T, L>(memory);
            Tensor<Dim, T> F[points];
            deform<Dim, L>(data, region, F);
            for (int q = 0; q < points; ++q) {
                recall<Law, L>(memory, q, p);
                sum += region.volume / points * Law::advance(p, F[q]);
                for (size_t k = 0; k < Law::memory.size(); ++k)
                    remembered[long(q * Law::memory.size() + k)] = p[Law::parameters.size() + k];
            }
        }
        field<T, L>(dissipated)[0] = sum;
    }
};

} // namespace softgrain::kernels
