// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "material/material.hpp"

namespace softgrain {

/// Compressible Ogden solid (Ogden 1972, of compressible rubberlike solids) with one to three terms, l1 and l2 the principal
/// stretches in the plane, l3 = 1 across it:
///     W = sum over terms of mu_k / alpha_k (l1^alpha_k + l2^alpha_k + l3^alpha_k - 3) - mu_k ln J,  and lambda/2 (ln J)^2.
/// One term with alpha = 2 is Neo-Hookean. Gels and rubbers stiffen or soften in large strains as alpha says.
template <int Terms> struct Ogden : LogarithmicVolume {
    static_assert(Terms >= 1 && Terms <= 3, "the names below");
    static constexpr const char* name = Terms == 1 ? "Ogden" : Terms == 2 ? "Ogden of two terms" : "Ogden of three terms";
    static constexpr std::array<const char*, 7> names { "lambda",   "mu[0]", "alpha[0]", "mu[1]",
                                                        "alpha[1]", "mu[2]", "alpha[2]" };
    static constexpr std::array<const char*, 1 + 2 * Terms> parameters = [] {
        std::array<const char*, 1 + 2 * Terms> first {};
        for (size_t k = 0; k < first.size(); ++k)
            first[k] = names[k];
        return first;
    }();
    static constexpr std::array<double, 0> memory {};

    template <class T> static SOFTGRAIN_INLINE T shear_modulus(const T* p)
    {
        T sum = p[1] * p[2];
        for (int k = 1; k < Terms; ++k)
            sum += p[1 + 2 * k] * p[2 + 2 * k];
        return 0.5 * sum;
    }

    /// Principal stretches in the plane: 2 F = turn + mirror, of sizes l1 + l2 and l1 - l2.
    template <class T> struct Stretches {
        T turn[2], mirror[2], sum, difference, log[2];

        template <int Dim> SOFTGRAIN_INLINE Stretches(const Tensor<Dim, T>& F)
        {
            turn[0] = F.at[0][0] + F.at[1][1];
            turn[1] = F.at[1][0] - F.at[0][1];
            mirror[0] = F.at[0][0] - F.at[1][1];
            mirror[1] = F.at[1][0] + F.at[0][1];
            sum = square_root(turn[0] * turn[0] + turn[1] * turn[1]);
            difference = square_root(mirror[0] * mirror[0] + mirror[1] * mirror[1]);
            // their product is J: the smaller one by its quotient, which cancels nothing
            const T large = 0.5 * (sum + difference), J = F.at[0][0] * F.at[1][1] - F.at[0][1] * F.at[1][0];
            log[0] = logarithm(large);
            log[1] = logarithm(J / large);
        }
    };

    template <int Dim, class T> static SOFTGRAIN_INLINE T energy(const T* p, const Tensor<Dim, T>& F)
    {
        static_assert(Dim == 2, "plane strain");
        const Stretches<T> stretches(F);
        T sum {};
        for (int k = 0; k < Terms; ++k) {
            const T &mu = p[1 + 2 * k], &alpha = p[2 + 2 * k];
            sum += mu
                * ((exponential(alpha * stretches.log[0]) + exponential(alpha * stretches.log[1]) - 2.0) / alpha
                   - (stretches.log[0] + stretches.log[1]));
        }
        return sum;
    }
    /// w1 = dw/dl1 along the turned and the mirrored part of F together, w2 = dw/dl2 along their difference. Of a
    /// three-dimensional F that is one of plane strain too: there dw/dl3 = 0.
    template <int Dim, class T>
    static SOFTGRAIN_INLINE void stress(const T* p, const Tensor<Dim, T>& F, const Tensor<Dim, T>&, const T&,
                                        Tensor<Dim, T>& P)
    {
        const Stretches<T> stretches(F);
        T slope[2] {};
        for (int i = 0; i < 2; ++i) {
            for (int k = 0; k < Terms; ++k)
                slope[i] += p[1 + 2 * k] * (exponential(p[2 + 2 * k] * stretches.log[i]) - 1.0);
            slope[i] *= exponential(-stretches.log[i]);
        }
        const T turned = 0.5 * (slope[0] + slope[1]) / stretches.sum,
                mirrored = 0.5 * (slope[0] - slope[1]) / larger(stretches.difference, broadcast<T>(1e-100));
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                P.at[i][j] = T {};
        P.at[0][0] = turned * stretches.turn[0] + mirrored * stretches.mirror[0];
        P.at[0][1] = mirrored * stretches.mirror[1] - turned * stretches.turn[1];
        P.at[1][0] = mirrored * stretches.mirror[1] + turned * stretches.turn[1];
        P.at[1][1] = turned * stretches.turn[0] - mirrored * stretches.mirror[0];
    }

    static double wave_modulus(const double* p) { return p[0] + 2 * shear_modulus(p); }
    static std::string complaint(const double* p)
    {
        for (size_t k = 1; k < parameters.size(); ++k)
            if (!std::isfinite(p[k])) return std::string(parameters[k]) + " = " + shown(p[k]) + " has to be finite";
        for (size_t k = 2; k < parameters.size(); k += 2)
            if (p[k] == 0) return std::string(parameters[k]) + " = 0 gives no energy; leave its term out";
        if (!(shear_modulus(p) > 0))
            return "the shear modulus, half the sum of mu[k] alpha[k], " + shown(shear_modulus(p))
                + " Pa, has to be positive";
        return volumetric_complaint(p);
    }
};

} // namespace softgrain
