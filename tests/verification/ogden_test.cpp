// SPDX-License-Identifier: GPL-2.0-or-later
// Ogden grains in homogeneous deformations against closed forms; against Neo-Hookean ones; their stable step in tension.
#include "step/critical_step.hpp"
#include "support/grains.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double lambda = 3e6;
const std::vector<std::pair<double, double>> terms { { 0.4e6, 3.5 }, { -0.2e6, -2.0 } }; // mu, alpha
const Material two_terms { "Ogden of two terms", { lambda, 0.4e6, 3.5, -0.2e6, -2.0 } };

/// Principal Kirchhoff stress of a stretch, l dW/dl [Pa].
double kirchhoff(double l, double J)
{
    double tau = lambda * std::log(J);
    for (const auto& [mu, alpha] : terms)
        tau += mu * (std::pow(l, alpha) - 1);
    return tau;
}

/// Largest difference of the Cauchy stresses of a grain, turned after it is deformed, from sigma [lambda].
double error(const Mat<2>& F, const Mat<3>& sigma)
{
    static const auto mesh = disc_mesh(60, 0.3, 0.1);
    double worst = 0;
    for (double angle : { 0.0, 0.7, -1.8 }) {
        Grain<2> grain = make_grain(mesh, two_terms);
        for (int i = 0; i < mesh->master_count; ++i)
            Eigen::Map<Vec<2>>(&grain.displacement[2 * size_t(i)])
                = (turn(angle) * F - Mat<2>::Identity()) * mesh->node_position[size_t(i)];
        Mat<3> Q = Mat<3>::Identity();
        Q.topLeftCorner<2, 2>() = turn(angle);
        for (const Mat<3>& found : grain.cauchy_stresses())
            worst = std::max(worst, (found - Q * sigma * Q.transpose()).cwiseAbs().maxCoeff() / lambda);
    }
    return worst;
}

// sigma_i = l_i dW/dl_i / J, across the plane lambda ln J / J.
TEST(Ogden, UniaxialAndBiaxialStrainAreTheClosedForms)
{
    for (double x : { 1.0, 0.6, 1.7 })
        for (double y : { 0.5, 0.8, 1.0, 1.6 }) {
            const double J = x * y;
            const Vec<3> principal(kirchhoff(x, J), kirchhoff(y, J), kirchhoff(1, J));
            EXPECT_LE(error(Vec<2>(x, y).asDiagonal(), (principal / J).asDiagonal()), 1e-13) << x << " " << y;
        }
}

// Simple shear g: l - 1/l = g, J = 1, b = (1 + g^2, g; g, 1), and sigma = s b + c 1 with s (l^2 - l^-2) = tau_1 - tau_2.
TEST(Ogden, SimpleShearIsTheClosedForm)
{
    for (double g : { 1e-9, 1e-3, 0.3, 1.0, 2.0 }) {
        const double l = (g + std::sqrt(g * g + 4)) / 2, first = kirchhoff(l, 1), second = kirchhoff(1 / l, 1);
        const double s = (first - second) / (g * std::sqrt(g * g + 4)), c = first - s * l * l;
        Mat<3> sigma = Mat<3>::Zero();
        sigma.diagonal() << s * (1 + g * g) + c, s + c, 0;
        sigma(0, 1) = sigma(1, 0) = s * g;
        // at 1e-9 the closed form above has lost eps / g of s, times g
        EXPECT_LE(error((Mat<2>() << 1, g, 0, 1).finished(), sigma), 1e-13) << g;
    }
}

TEST(Ogden, OneTermOfExponentTwoIsNeoHookean)
{
    const auto mesh = disc_mesh(60, 0.3, 0.1);
    Grain<2> one = make_grain(mesh, { "Ogden", { 61e6, 1.26e6, 2 } }), other = make_grain(mesh, neo_hookean());
    for (Grain<2>* grain : { &one, &other })
        for (size_t i = 0; i < grain->displacement.size(); ++i)
            grain->displacement[i] += 0.02 * std::sin(double(i));
    const auto found = one.cauchy_stresses(), expected = other.cauchy_stresses();
    double scale = 0;
    for (const auto& sigma : expected)
        scale = std::max(scale, sigma.norm());
    for (size_t p = 0; p < found.size(); ++p)
        EXPECT_LE((found[p] - expected[p]).norm(), 1e-13 * scale);
    EXPECT_NEAR(one.elastic_energy(), other.elastic_energy(), 1e-13 * other.elastic_energy());
}

// Tension stiffens a solid of high exponent, with no stretch below 1: the bound of a step has to fall with the step.
TEST(Ogden, BoundOfTheStableStepFollowsStiffeningInTension)
{
    const auto mesh = disc_mesh(60);
    for (double stretch : { 1.0, 1.2, 1.4, 1.6 }) {
        Grain<2> grain = make_grain(mesh, { "Ogden", { 1e6, 0.2e6, 10 } });
        const double unit = unit_critical_step(grain);
        const Mat<2> F = Vec<2>(stretch, 1).asDiagonal();
        for (int i = 0; i < mesh->master_count; ++i)
            Eigen::Map<Vec<2>>(&grain.displacement[2 * size_t(i)])
                = (F - Mat<2>::Identity()) * mesh->node_position[size_t(i)];
        grain.elastic_energy();
        const double bound = critical_step(grain, unit);
        const double step = SmallestCriticalStep<2>()({ &grain }, 1); // of its own stiffness, below 1.25 times the bound
        std::printf("stretch %.1f: bound %.3e s, step %.3e s\n", stretch, bound, step);
        EXPECT_LE(bound, 1.01 * step);
    }
}

} // namespace
