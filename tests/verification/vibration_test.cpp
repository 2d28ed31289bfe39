// SPDX-License-Identifier: GPL-2.0-or-later
// Natural frequencies of the free disc in plane strain against F_*.csv (Bessel roots, confirmed by finite elements).
#include "reference.hpp"
#include "support/forces.hpp"
#include "support/grains.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

struct Case {
    std::string file;
    Material material;
};
const std::vector<Case> cases { { "F_free_vibration_NH.csv", neo_hookean() },
                                { "F_free_vibration_NHsoft.csv", soft_neo_hookean() } };

/// The lowest frequencies, each as often as it occurs [Hz].
std::vector<double> expected_frequencies(const Table& table, size_t count)
{
    std::vector<double> all;
    for (size_t mode = 0; mode < table["f_analytic"].size(); ++mode)
        all.insert(all.end(), size_t(table["multiplicity"][mode]), table["f_analytic"][mode]);
    all.resize(count);
    return all;
}

/// Modes that the material takes part in. Lumped splines have others below the shortest waves of the grid, in which nodes
/// move against each other and the material, which sees their mean, hardly moves.
std::vector<Mode> material_modes(const Grain<2>& grain, size_t count)
{
    std::vector<Mode> all;
    for (const Mode& mode : modes(grain))
        if (mode.share > 0.5) all.push_back(mode);
    all.resize(count);
    return all;
}

Grain<2> disc(const Case& c, int points) { return make_grain(disc_mesh(points, 0.2, 0.35), c.material); }

// Stiffness: with the inertia of the material, f / sqrt(share), the first frequencies (n = 2, 2, 1, 1) come out to 1 %.
TEST(FreeVibration, FirstFrequenciesComeOutAt276PointsWithTheInertiaOfTheMaterial)
{
    for (const auto& c : cases) {
        const Table table(c.file);
        const auto expected = expected_frequencies(table, 4);
        const auto found = material_modes(disc(c, 276), 4);
        for (size_t k = 0; k < expected.size(); ++k) {
            const double f = found[k].frequency / std::sqrt(found[k].share);
            std::printf("%s, 276 points: %9.1f Hz lumped (%+.2f %%), %9.1f Hz with the inertia of the material (%+.2f %%), "
                        "expected %9.1f\n",
                        c.file.c_str(), found[k].frequency, 100 * (found[k].frequency / expected[k] - 1), f,
                        100 * (f / expected[k] - 1), expected[k]);
            EXPECT_NEAR(f / expected[k], 1, 0.01) << c.file;
        }
    }
}

// Inertia: row-sum lumping of quadratic splines adds (k h)^2 / 4 to the inertia of a wave of wave number k (the second moment
// of a spline), so frequencies are low by (k h)^2 / 8, k = omega / c_t for these modes; slaves beyond the rim add as much at
// the most.
TEST(FreeVibration, FrequenciesOfTheRunAreLowByTheLumping)
{
    for (const auto& c : cases) {
        const double c_t = std::sqrt(c.material.parameters[1] / 1000);
        for (int points : { 276, 1200 }) {
            const Grain<2> grain = disc(c, points);
            const auto expected = expected_frequencies(Table(c.file), 4);
            const auto found = material_modes(grain, 4);
            for (size_t k = 0; k < expected.size(); ++k) {
                const double kh = 2 * M_PI * expected[k] / c_t * grain.mesh->cell_width * 1e-3;
                EXPECT_LE(found[k].frequency / expected[k] - 1, 0) << points;
                EXPECT_GE(found[k].frequency / expected[k] - 1, -2 * kh * kh / 8) << points;
            }
            std::printf("%s, %d points: first two frequencies %+.2f %% and %+.2f %%\n", c.file.c_str(), points,
                        100 * (found[0].frequency / expected[0] - 1), 100 * (found[2].frequency / expected[2] - 1));
        }
    }
}

TEST(FreeVibration, FrequenciesConvergeWithOrder2)
{
    for (const auto& c : cases) {
        const auto expected = expected_frequencies(Table(c.file), 6);
        const int points[] = { 556, 1200, 2800 };
        double worst[3], width[3];
        for (int k = 0; k < 3; ++k) {
            const Grain<2> grain = disc(c, points[k]);
            width[k] = grain.mesh->cell_width;
            worst[k] = 0;
            const auto found = material_modes(grain, 6);
            for (size_t i = 0; i < expected.size(); ++i)
                worst[k] = std::max(worst[k], std::abs(found[i].frequency / expected[i] - 1));
        }
        const double order = std::log(worst[0] / worst[2]) / std::log(width[0] / width[2]);
        std::printf(
            "%s: worst of the first three double frequencies %.2f %% at 556 points, %.2f %% at 1200, %.2f %% at 2800, "
            "order %.2f\n",
            c.file.c_str(), 100 * worst[0], 100 * worst[1], 100 * worst[2], order);
        EXPECT_NEAR(order, 2, 0.3);
        EXPECT_LE(worst[2], 0.01);
    }
}

// The run itself, started in a mode: symplectic Euler has sin(omega' dt / 2) = omega dt / 2 (Hairer, Lubich, Wanner 2006).
TEST(FreeVibration, StepsOscillateAtTheOperatorsFrequency)
{
    World world;
    Grain<2> grain = make_grain(disc_mesh(276), soft_neo_hookean());
    const Mode mode = material_modes(grain, 1)[0];
    const double fastest = std::abs(*std::max_element(mode.shape.begin(), mode.shape.end()));
    for (size_t i = 0; i < mode.shape.size(); ++i)
        grain.velocity[i] = mode.shape[i] * 1e-4 * 2 * M_PI * mode.frequency / fastest; // strains of 1e-4
    grain.refresh();
    world.add(grain);
    const double dt = step_of(grain, 0.5);
    // zeros of the strain that the mode has most of, by lines between the steps
    Mat<2> direction = Mat<2>::Zero();
    std::vector<double> zeros;
    double before = 0;
    while (zeros.size() < 41) {
        world.step(dt);
        const Mat<2> strain = world.grains[0].motion.mean_gradient - Mat<2>::Identity();
        if (world.steps == 3) direction = strain;
        const double now = strain.cwiseProduct(direction).sum();
        if (before * now < 0) zeros.push_back(world.time - dt * now / (now - before));
        before = now;
    }
    const double found = 20 / (zeros.back() - zeros.front());
    const double expected = std::asin(M_PI * mode.frequency * dt) / (M_PI * dt);
    std::printf("first mode: %.2f Hz in the run, %.2f Hz expected, %.2f Hz of the operator\n", found, expected,
                mode.frequency);
    EXPECT_NEAR(found / expected, 1, 2e-5); // zeros by lines between some 30 steps a period
}

} // namespace
