// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "material/material.hpp"

namespace softgrain {

/// Compressible Neo-Hookean solid, Vu et al. 2017, eq. 7: S = (lambda ln J - mu) C^-1 + mu I, which derives from
///     W = mu/2 (tr C - 3) - mu ln J + lambda/2 (ln J)^2.
struct NeoHookean : LogarithmicVolume {
    static constexpr const char* name = "Neo-Hookean";
    static constexpr std::array<const char*, 2> parameters { "lambda", "mu" };
    static constexpr std::array<double, 0> memory {};

    template <class T> static SOFTGRAIN_INLINE T shear_modulus(const T* p) { return p[1]; }

    template <int Dim, class T> static SOFTGRAIN_INLINE T energy(const T* p, const Tensor<Dim, T>& F)
    {
        return p[1] * (0.5 * (first_invariant(F) - 3.0) - logarithm(determinant(F)));
    }
    template <int Dim, class T>
    static SOFTGRAIN_INLINE void stress(const T* p, const Tensor<Dim, T>& F, const Tensor<Dim, T>& cof, const T& inverse_J,
                                        Tensor<Dim, T>& P)
    {
        const T k = p[1] * inverse_J;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                P.at[i][j] = p[1] * F.at[i][j] - k * cof.at[i][j];
    }

    template <class T> static SOFTGRAIN_INLINE PlaneTangent<T> plane_tangent(const T* p, const T&, const T& inverse_J)
    {
        return { p[1], p[1] * inverse_J * inverse_J, -p[1] * inverse_J };
    }

    static double wave_modulus(const double* p) { return p[0] + 2 * p[1]; }
    static std::string complaint(const double* p)
    {
        if (!(p[1] > 0) || !std::isfinite(p[1])) return "mu = " + shown(p[1]) + " Pa has to be positive and finite";
        return volumetric_complaint(p);
    }
};

} // namespace softgrain
