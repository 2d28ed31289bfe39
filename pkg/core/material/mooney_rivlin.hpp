// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "material/material.hpp"

namespace softgrain {

/// Compressible Mooney-Rivlin solid, Vu et al. 2017, eq. 8:
///     S = 2 (c1 + c2 tr C) I - 2 c2 C + [2 c J (J - 1) - d] C^-1,   d = 2 (c1 + 2 c2),
/// which derives from W = c1 (I1 - 3) + c2 (I2 - 3) + c (J - 1)^2 - d ln J. Invariants of the 3 x 3 C.
struct MooneyRivlin {
    static constexpr const char* name = "Mooney-Rivlin";
    static constexpr std::array<const char*, 3> parameters { "c1", "c2", "c" };
    static constexpr std::array<double, 0> memory {};

    template <class T> static SOFTGRAIN_INLINE T volumetric_energy(const T* p, const T& J)
    {
        return p[2] * (J - 1.0) * (J - 1.0);
    }
    template <class T> static SOFTGRAIN_INLINE T volumetric_modulus(const T* p) { return 2.0 * p[2]; }
    template <class T> static SOFTGRAIN_INLINE T shear_modulus(const T* p) { return 2.0 * (p[0] + p[1]); }
    template <class T> static SOFTGRAIN_INLINE T volumetric_slope(const T* p, const T& J, const T&)
    {
        return 2.0 * p[2] * (J - 1.0);
    }
    template <class T> static SOFTGRAIN_INLINE T volumetric_curvature(const T* p, const T&, const T&) { return 2.0 * p[2]; }

    template <int Dim, class T> static SOFTGRAIN_INLINE T energy(const T* p, const Tensor<Dim, T>& F)
    {
        const Tensor<Dim, T> C = right_cauchy_green(F);
        const T I1 = first_invariant(F);
        T C_C = broadcast<T>(3 - Dim);
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                C_C += C.at[i][j] * C.at[i][j];
        return p[0] * (I1 - 3.0) + p[1] * (0.5 * (I1 * I1 - C_C) - 3.0)
            - 2.0 * (p[0] + 2.0 * p[1]) * logarithm(determinant(F));
    }
    template <int Dim, class T>
    static SOFTGRAIN_INLINE void stress(const T* p, const Tensor<Dim, T>& F, const Tensor<Dim, T>& cof, const T& inverse_J,
                                        Tensor<Dim, T>& P)
    {
        const Tensor<Dim, T> C = right_cauchy_green(F);
        const T a = 2.0 * (p[0] + p[1] * first_invariant(F)), b = 2.0 * p[1];
        const T k = 2.0 * (p[0] + 2.0 * p[1]) * inverse_J;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j) {
                T FC = F.at[i][0] * C.at[0][j];
                for (int m = 1; m < Dim; ++m)
                    FC += F.at[i][m] * C.at[m][j];
                P.at[i][j] = a * F.at[i][j] - b * FC - k * cof.at[i][j];
            }
    }

    /// In the plane I2 = tr C + J^2 - 1 and so w = (c1 + c2) (tr C - 3) + c2 (J^2 - 1) - d ln J, tr C of three dimensions.
    template <class T> static SOFTGRAIN_INLINE PlaneTangent<T> plane_tangent(const T* p, const T& J, const T& inverse_J)
    {
        const T d = 2.0 * (p[0] + 2.0 * p[1]);
        return { 2.0 * (p[0] + p[1]), 2.0 * p[1] + d * inverse_J * inverse_J, 2.0 * p[1] * J - d * inverse_J };
    }

    /// Small strains: mu = 2 (c1 + c2), lambda = 2 c + 4 c2.
    static double wave_modulus(const double* p) { return 2 * p[2] + 4 * p[1] + 4 * (p[0] + p[1]); }
    static std::string complaint(const double* p)
    {
        const double mu = 2 * (p[0] + p[1]), lambda = 2 * p[2] + 4 * p[1];
        for (size_t k = 0; k < parameters.size(); ++k)
            if (!std::isfinite(p[k])) return std::string(parameters[k]) + " = " + shown(p[k]) + " Pa has to be finite";
        if (!(p[0] + 2 * p[1] > 0)) return "c1 + 2 c2 = " + shown(p[0] + 2 * p[1]) + " Pa has to be positive";
        if (!(mu > 0)) return "the shear modulus 2 (c1 + c2) = " + shown(mu) + " Pa has to be positive";
        if (!(3 * lambda + 2 * mu > 0))
            return "the bulk modulus lambda + 2/3 mu = " + shown(lambda + 2 * mu / 3)
                + " Pa (lambda = 2 c + 4 c2) has to be positive; raise c = " + shown(p[2]) + " Pa";
        return "";
    }
};

} // namespace softgrain
