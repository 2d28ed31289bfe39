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
const std::vector<Case> cases { { "F_free_vibration_NH.csv", neo_hookean() }, { "F_free_vibration_NHsoft.csv", soft_neo_hookean() } };

/// The lowest frequencies, each as often as it occurs [Hz].
std::vector<double> expected_frequencies(const Table& table, size_t count)
{
    std::vector<double> all;
    for (size_t mode = 0; mode < table["f_analytic"].size(); ++mode)
        all.insert(all.end(), size_t(table["multiplicity"][mode]), table["f_analytic"][mode]);
    all.resize(count);
    return all;
}

/// Largest relative error of the first frequencies.
double worst_error(const Case& c, int points, size_t count, bool print)
{
    const auto f = frequencies(make_grain(disc_mesh(points, 0.2, 0.35), c.material));
    const auto expected = expected_frequencies(Table(c.file), count);
    // rigid motions: no stiffness but round-off and the differences', 1e-8 of the largest
    for (int k = 0; k < 3; ++k)
        EXPECT_LE(f[k], 1e-4 * f[f.size() - 1]) << c.file;
    double worst = 0;
    for (size_t k = 0; k < count; ++k) {
        const double error = f[long(k) + 3] / expected[k] - 1;
        worst = std::max(worst, std::abs(error));
        if (print) std::printf("  %9.1f Hz, expected %9.1f: %+.2f %%\n", f[long(k) + 3], expected[k], 100 * error);
    }
    return worst;
}

TEST(FreeVibration, FirstFrequenciesComeOutAt276Points)
{
    for (const auto& c : cases) {
        std::printf("%s, 276 points\n", c.file.c_str());
        EXPECT_LE(worst_error(c, 276, 6, true), 0.02);
    }
}

TEST(FreeVibration, FrequenciesConvergeWithOrder2)
{
    for (const auto& c : cases) {
        const double coarse = worst_error(c, 124, 6, false), fine = worst_error(c, 1200, 6, false);
        const double ratio = disc_mesh(124, 0.2, 0.35)->cell_width / disc_mesh(1200, 0.2, 0.35)->cell_width;
        const double order = std::log(coarse / fine) / std::log(ratio);
        std::printf("%s: worst of six frequencies %.2f %% at 124 points, %.2f %% at 1200, order %.1f\n", c.file.c_str(), 100 * coarse,
                    100 * fine, order);
        EXPECT_GE(order, 1.7);
    }
}

// The run itself: a disc squashed a little vibrates in its first mode (n = 2), whose frequency symplectic Euler shifts by
// (omega dt)^2 / 24 only.
TEST(FreeVibration, StepsOscillateAtTheOperatorsFrequency)
{
    const auto mesh = disc_mesh(276, 0.2, 0.35);
    World world;
    GrainStart start;
    start.velocity_gradient = (Mat<2>() << 10, 0, 0, -10).finished(); // strains of 1e-4
    world.add(make_grain(mesh, soft_neo_hookean(), start));
    const double dt = 0.5 * critical_step(world.grains[0], unit_critical_step(world.grains[0]));
    const double expected = frequencies(make_grain(mesh, soft_neo_hookean()))[3];
    // times of the zeros of F11 - F22, by lines; ten periods
    std::vector<double> zeros;
    double before = 0;
    while (zeros.size() < 20) {
        world.step(dt);
        const Mat<2> F = world.grains[0].motion.mean_gradient;
        const double now = F(0, 0) - F(1, 1);
        if (before * now < 0) zeros.push_back(world.time - dt * now / (now - before));
        before = now;
    }
    const double found = double(zeros.size() - 1) / 2 / (zeros.back() - zeros.front());
    std::printf("first mode: %.1f Hz in the run, %.1f Hz of the operator\n", found, expected);
    EXPECT_NEAR(found / expected, 1, 5e-3); // higher n = 2 modes take part and move the zeros
}

} // namespace
