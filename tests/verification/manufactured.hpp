// SPDX-License-Identifier: GPL-2.0-or-later
// Manufactured solutions: motions given in closed form, and the body force and boundary traction that make them exact
// (Roache 1998; for the Material Point Method Kamojjala, Brannon, Sadeghirad and Guilkey 2015).
#pragma once

#include "support/grains.hpp"

namespace softgrain::testing_support {

/// A motion of a grain and what drives it, at a reference place X [m, origin at the centroid] and a time [s]. At time 0 the
/// grain is where the reference is.
class Manufactured {
public:
    virtual ~Manufactured() = default;
    virtual Vec<2> displacement(const Vec<2>& X, double t) const = 0; ///< [m]
    virtual Vec<2> velocity(const Vec<2>& X, double t) const = 0;     ///< [m/s]
    virtual Mat<2> gradient(const Vec<2>& X, double t) const = 0;     ///< deformation gradient F
    virtual Vec<2> body_force(const Vec<2>& X, double t) const = 0;   ///< b = a - Div P / density [m/s2]
    /// First Piola-Kirchhoff traction P N at a surface point, mean over the boundary that belongs to it [Pa].
    virtual Vec<2> traction(const Vec<2>&, double) const { return Vec<2>::Zero(); }
};

/// First Piola-Kirchhoff stress P = J sigma F^-T of a law [Pa].
inline Mat<2> piola_stress(const Material& material, const Mat<2>& in_plane)
{
    Mat<3> F = Mat<3>::Identity();
    F.topLeftCorner<2, 2>() = in_plane;
    const double J = in_plane.determinant();
    const Mat<3> sigma = law_kernels<2>(material.law).cauchy_stress(material.parameters.data(), F, J);
    return J * sigma.topLeftCorner<2, 2>() * in_plane.inverse().transpose();
}

/// Shear modulus of small strains [Pa]: Neo-Hookean mu, Mooney-Rivlin 2 (c1 + c2) (Vu et al. 2017, below eq. 8).
inline double shear_modulus(const Material& material)
{
    const auto& p = material.parameters;
    return material.law == std::string("Neo-Hookean") ? p[1] : 2 * (p[0] + p[1]);
}

/// The two laws at a shear modulus of 1 Pa and a Poisson ratio: lambda = 2 mu nu / (1 - 2 nu). Mooney-Rivlin with a c2 that
/// matters, a quarter of c1; its lambda is 2 c + 4 c2.
inline Material unit_neo_hookean(double nu) { return { "Neo-Hookean", { 2 * nu / (1 - 2 * nu), 1 } }; }
inline Material unit_mooney_rivlin(double nu)
{
    constexpr double c1 = 0.4, c2 = 0.1;
    return { "Mooney-Rivlin", { c1, c2, nu / (1 - 2 * nu) - 2 * c2 } };
}

/// How far a vortex turns its rings: a profile h(R) with its first two derivatives.
struct VortexProfile {
    double value, slope, curvature;
};
/// h = 1 - 32 (R - 1)^2 + 256 (R - 1)^4 in 3/4 <= R <= 5/4, else 0 (Kamojjala et al. 2015); curvature jumps at both ends.
inline VortexProfile ring_profile(double R)
{
    const double s = R - 1, s2 = s * s;
    if (s2 > 1.0 / 16) return { 0, 0, 0 };
    return { 1 - 32 * s2 + 256 * s2 * s2, -64 * s + 1024 * s * s2, -64 + 3072 * s2 };
}
/// h = 27/4 R^2 (1 - R^2)^2: a polynomial in X and Y, no kink anywhere, largest value 1; still at the rim R = 1, where
/// value and slope vanish.
inline VortexProfile disc_profile(double R)
{
    const double q = R * R;
    return { 6.75 * q * (1 - q) * (1 - q), 13.5 * R * (1 - q) * (1 - 3 * q), 13.5 * (1 - 12 * q + 15 * q * q) };
}

/// Generalised vortex (Kamojjala et al. 2015): rings turn by alpha = A sin(rate t) h(R), x = Q(alpha) X. J = 1 everywhere, and
/// with gamma = R alpha_R, in the turned polar basis,
///
///     F = I + gamma e_theta E_R,   P = mu gamma (e_r E_Theta + e_theta E_R)
///
/// for Neo-Hookean and, with mu = 2 (c1 + c2), for Mooney-Rivlin too: with C33 = J = 1 both invariants are 3 + gamma^2. Thus
///
///     b_r = -R alpha_t^2 + mu / rho R alpha_R^2,   b_theta = R alpha_tt - mu / rho (3 alpha_R + R alpha_RR),
///
/// whatever lambda is. Where h and h' vanish at the rim it is free of stress.
class Vortex final : public Manufactured {
public:
    using Profile = VortexProfile (*)(double);
    Vortex(Profile profile, double amplitude, double rate, double mu_over_density)
        : profile_(profile)
        , amplitude_(amplitude)
        , rate_(rate)
        , mu_(mu_over_density)
    {
    }
    Vec<2> displacement(const Vec<2>& X, double t) const override { return turned(X, t) - X; }
    Vec<2> velocity(const Vec<2>& X, double t) const override
    {
        return spin(amplitude_ * rate_ * std::cos(rate_ * t) * profile_(X.norm()).value) * turned(X, t);
    }
    Mat<2> gradient(const Vec<2>& X, double t) const override
    {
        const double R = X.norm(), s = amplitude_ * std::sin(rate_ * t);
        const VortexProfile h = profile_(R);
        if (R == 0) return turn(s * h.value);
        const Vec<2> E_R = X / R, E_Theta(-E_R.y(), E_R.x());
        return turn(s * h.value) * (Mat<2>::Identity() + s * R * h.slope * E_Theta * E_R.transpose());
    }
    Vec<2> body_force(const Vec<2>& X, double t) const override
    {
        const double R = X.norm(), sine = std::sin(rate_ * t), cosine = std::cos(rate_ * t);
        if (R == 0) return Vec<2>::Zero();
        const VortexProfile h = profile_(R);
        const double along
            = std::pow(amplitude_, 2) * R * (mu_ * std::pow(h.slope * sine, 2) - std::pow(rate_ * h.value * cosine, 2));
        const double across = -amplitude_ * sine * (R * rate_ * rate_ * h.value + mu_ * (3 * h.slope + R * h.curvature));
        const Vec<2> e_r = turn(amplitude_ * sine * h.value) * X / R;
        return along * e_r + across * Vec<2>(-e_r.y(), e_r.x());
    }

private:
    Profile profile_;
    double amplitude_, rate_, mu_;

    Vec<2> turned(const Vec<2>& X, double t) const
    {
        return turn(amplitude_ * std::sin(rate_ * t) * profile_(X.norm()).value) * X;
    }
};

/// Axis-aligned displacement (Wallstedt and Guilkey 2008; Kamojjala et al. 2015) in the square of side 1:
///
///     u_k = A sin(2 pi (X_k + 1/2)) sin(rate t)
///
/// F is diagonal, and so is P. On an edge the normal displacement is 0 and the traction P_kk N_k is not: it is applied. The
/// published motion has opposite signs in x and y; the same sign and half a period keep all edges in tension, since a
/// given traction that pushes makes a surface unstable in itself.
class AxisAligned final : public Manufactured {
public:
    AxisAligned(const Material& material, double amplitude, double rate, double density)
        : material_(material)
        , amplitude_(amplitude)
        , rate_(rate)
        , density_(density)
    {
    }
    Vec<2> displacement(const Vec<2>& X, double t) const override { return wave(X, std::sin(rate_ * t)); }
    Vec<2> velocity(const Vec<2>& X, double t) const override { return rate_ * wave(X, std::cos(rate_ * t)); }
    Mat<2> gradient(const Vec<2>& X, double t) const override
    {
        const Vec<2> phase = 2 * M_PI * (X.array() + 0.5).matrix();
        const double s = 2 * M_PI * amplitude_ * std::sin(rate_ * t);
        return Vec<2>(1 + s * std::cos(phase.x()), 1 + s * std::cos(phase.y())).asDiagonal();
    }
    /// Div P along axis k is dP_kk/dF_kk dF_kk/dX_k, with P_kk of the laws of doc/theory.md, section 3.
    Vec<2> body_force(const Vec<2>& X, double t) const override
    {
        const Mat<2> F = gradient(X, t);
        const Vec<2> u = displacement(X, t);
        const double J = F.determinant();
        Vec<2> b;
        for (int k = 0; k < 2; ++k) {
            const double own = F(k, k), other = F(1 - k, 1 - k);
            const double change = -4 * M_PI * M_PI * u[k]; // dF_kk/dX_k
            b[k] = -rate_ * rate_ * u[k] - tangent(own, other, J) * change / density_;
        }
        return b;
    }
    Vec<2> traction(const Vec<2>& X, double t) const override
    {
        const Mat<2> P = piola_stress(material_, gradient(X, t));
        Vec<2> sum = Vec<2>::Zero();
        int edges = 0; // two meet in a corner
        for (int k = 0; k < 2; ++k)
            if (std::abs(std::abs(X[k]) - 0.5) < 1e-9) {
                sum[k] = P(k, k) * (X[k] > 0 ? 1 : -1);
                ++edges;
            }
        return sum / edges;
    }

private:
    Material material_;
    double amplitude_, rate_, density_;

    Vec<2> wave(const Vec<2>& X, double size) const
    {
        const Vec<2> phase = 2 * M_PI * (X.array() + 0.5).matrix();
        return amplitude_ * size * Vec<2>(std::sin(phase.x()), std::sin(phase.y()));
    }
    /// dP_kk/dF_kk at a diagonal F [Pa].
    double tangent(double own, double other, double J) const
    {
        const auto& p = material_.parameters;
        if (material_.law == std::string("Neo-Hookean")) return p[1] + (p[1] + p[0] * (1 - std::log(J))) / (own * own);
        return 2 * p[0] + 2 * p[1] * (other * other + 1) + 2 * (p[0] + 2 * p[1]) / (own * own) + 2 * p[2] * other * other;
    }
};

} // namespace softgrain::testing_support
