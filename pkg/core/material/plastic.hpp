// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "material/material.hpp"

#include <limits>

namespace softgrain {

/// Hencky's elasticity with plastic flow by von Mises and linear isotropic hardening, finite strains, plane strain. With
/// F = F_e F_p, b = F_e F_e^T = F G F^T and e = dev ln sqrt(b), G the inverse of F_p^T F_p and a the plastic strain gathered,
///     W = kappa/2 (ln J)^2 + mu |e|^2,     kirchhoff's stress tau = kappa ln J 1 + 2 mu e,
///     sqrt(3/2) |dev tau| <= yieldStress + hardening a.
/// A step is the exponential return map (Weber and Anand 1990; Eterovic and Bathe 1990; Simo 1992), which shortens the trial e
/// and keeps volume: with q = sqrt(6) mu |e| and f = q - yieldStress - hardening a of the trial state, where f > 0,
///     the flow in the step is f / (3 mu + hardening),   e <- e (1 - 3 mu flow / q).
/// That minimises the sum of stored and dissipated energy, which as a function of F alone is the w of the step (Ortiz and
/// Stainier 1999): w = mu |e|^2 - f^2 / (2 (3 mu + hardening)), with the trial e, has the slope dev tau F^-T.
struct Plastic {
    static constexpr const char* name = "plastic";
    static constexpr std::array<const char*, 4> parameters { "lambda", "mu", "yieldStress", "hardening" };
    /// G_11, G_12, G_22 (G_33 keeps det G = 1), and a.
    static constexpr std::array<double, 4> memory { 1, 0, 1, 0 };

    template <class T> static SOFTGRAIN_INLINE T volumetric_modulus(const T* p) { return p[0] + p[1] * (2.0 / 3); }
    template <class T> static SOFTGRAIN_INLINE T shear_modulus(const T* p) { return p[1]; }
    template <class T> static SOFTGRAIN_INLINE T volumetric_energy(const T* p, const T& J)
    {
        const T log_J = logarithm(J);
        return 0.5 * volumetric_modulus(p) * log_J * log_J;
    }
    template <class T> static SOFTGRAIN_INLINE T volumetric_slope(const T* p, const T& J, const T& inverse_J)
    {
        return volumetric_modulus(p) * logarithm(J) * inverse_J;
    }
    template <class T> static SOFTGRAIN_INLINE T volumetric_curvature(const T* p, const T& J, const T& inverse_J)
    {
        return volumetric_modulus(p) * (1.0 - logarithm(J)) * inverse_J * inverse_J;
    }

    /// The trial state of a step and what it flows. In the plane b = middle 1 + D with D^2 = radius^2 1, and
    /// e = mean 1 + half D / (2 radius); across it e_33 = -2 mean.
    template <class T> struct Trial {
        T D[2][2], middle, radius, mean, half; ///< half: of the difference of the principal values of ln b
        T size2, stress, flow;                 ///< |e|^2, q [Pa], plastic strain of the step
        T kept;                                ///< of e

        SOFTGRAIN_INLINE Trial(const T* p, const T (&F)[2][2])
        {
            const T *G = p + 4, &mu = p[1];
            T FG[2][2], b[2][2];
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j)
                    FG[i][j] = F[i][0] * G[j] + F[i][1] * G[j + 1];
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j)
                    b[i][j] = FG[i][0] * F[j][0] + FG[i][1] * F[j][1];
            middle = 0.5 * (b[0][0] + b[1][1]);
            D[0][0] = 0.5 * (b[0][0] - b[1][1]);
            D[1][1] = -D[0][0];
            D[0][1] = D[1][0] = b[0][1];
            radius = square_root(D[0][0] * D[0][0] + D[0][1] * D[0][1]);
            const T J = F[0][0] * F[1][1] - F[0][1] * F[1][0], det_G = G[0] * G[2] - G[1] * G[1], det_b = J * J * det_G;
            const T largest = middle + radius;
            mean = (1.0 / 12) * logarithm(det_b * det_G * det_G);
            half = 0.5 * logarithm(largest * largest / det_b);
            size2 = 6.0 * mean * mean + 0.5 * half * half;
            stress = mu * square_root(6.0 * size2);
            flow = larger(stress - p[2] - p[3] * p[7], T {}) / (3.0 * mu + p[3]);
            kept = 1.0 - 3.0 * mu * flow / larger(stress, broadcast<T>(1e-300));
        }
        /// Of D in e; where D vanishes it does not matter.
        SOFTGRAIN_INLINE T slope() const { return 0.5 * half / larger(radius, broadcast<T>(1e-100)); }
    };

    template <int Dim, class T> static SOFTGRAIN_INLINE T energy(const T* p, const Tensor<Dim, T>& F)
    {
        static_assert(Dim == 2, "plane strain");
        const Trial<T> trial(p, F.at);
        return p[1] * trial.size2 - 0.5 * (3.0 * p[1] + p[3]) * trial.flow * trial.flow;
    }
    /// Of a three-dimensional F that is one of plane strain too.
    template <int Dim, class T>
    static SOFTGRAIN_INLINE void stress(const T* p, const Tensor<Dim, T>& F, const Tensor<Dim, T>& cof, const T& inverse_J,
                                        Tensor<Dim, T>& P)
    {
        const T plane[2][2] = { { F.at[0][0], F.at[0][1] }, { F.at[1][0], F.at[1][1] } };
        const Trial<T> trial(p, plane);
        const T size = 2.0 * p[1] * trial.kept * inverse_J, slope = trial.slope();
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                P.at[i][j] = size * (i < 2 ? trial.mean : -2.0 * trial.mean) * cof.at[i][j];
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                P.at[i][j] += size * slope * (trial.D[i][0] * cof.at[0][j] + trial.D[i][1] * cof.at[1][j]);
    }
    /// G goes with b: b exp(-2 (1 - kept) e) pulled back. Returns what the flow dissipates, the integral of the yield stress
    /// over the plastic strain of the step [J/m3].
    template <class T> static SOFTGRAIN_INLINE T advance(T* p, const Tensor<2, T>& F)
    {
        const Trial<T> trial(p, F.at);
        const T lost = 1.0 - trial.kept, scale = exponential(-2.0 * lost * trial.mean),
                stretch = exponential(lost * trial.half), inverse_stretch = 1.0 / stretch,
                cosh = 0.5 * (stretch + inverse_stretch), sinh = 0.5 * (stretch - inverse_stretch);
        const T small = larger(trial.radius, broadcast<T>(1e-100));
        const T even = scale * (trial.middle * cosh - trial.radius * sinh) - trial.middle,
                odd = scale * (cosh - trial.middle * sinh / small) - 1.0; // of 1 and of D in the change of b
        const Tensor<2, T> cof = cofactor(F);
        const T J = determinant(F), inverse_J2 = 1.0 / (J * J);
        T change[2][2];
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                change[i][j] = inverse_J2 * (odd * trial.D[i][j] + (i == j ? even : T {}));
        const auto pulled_back = [&](int i, int j) {
            T sum {};
            for (int k = 0; k < 2; ++k)
                for (int l = 0; l < 2; ++l)
                    sum += cof.at[k][i] * change[k][l] * cof.at[l][j];
            return sum;
        };
        p[4] += pulled_back(0, 0);
        p[5] += pulled_back(0, 1);
        p[6] += pulled_back(1, 1);
        const T dissipated = (p[2] + p[3] * (p[7] + 0.5 * trial.flow)) * trial.flow;
        p[7] += trial.flow;
        return dissipated;
    }
    /// Constants of the same solid without flow.
    template <class Constants> static Constants elastic(Constants p)
    {
        p[2] = std::numeric_limits<double>::infinity();
        return p;
    }

    /// Of the Neo-Hookean solid of this shear modulus: an estimate, near enough for a search direction.
    template <class T> static SOFTGRAIN_INLINE PlaneTangent<T> plane_tangent(const T* p, const T&, const T& inverse_J)
    {
        return { p[1], p[1] * inverse_J * inverse_J, -p[1] * inverse_J };
    }
    static double wave_modulus(const double* p) { return p[0] + 2 * p[1]; }
    static std::string complaint(const double* p)
    {
        if (!(p[1] > 0) || !std::isfinite(p[1])) return "mu = " + shown(p[1]) + " Pa has to be positive and finite";
        if (!(p[0] >= 0) || !std::isfinite(p[0])) return "lambda = " + shown(p[0]) + " Pa has to be 0 or more, and finite";
        if (!(p[2] > 0) || !std::isfinite(p[2])) return "yieldStress = " + shown(p[2]) + " Pa has to be positive and finite";
        if (!(p[3] >= 0) || !std::isfinite(p[3]))
            return "hardening = " + shown(p[3]) + " Pa has to be 0 or more, and finite";
        return "";
    }
};

} // namespace softgrain
