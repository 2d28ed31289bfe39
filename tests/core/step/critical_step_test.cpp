// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/forces.hpp"
#include "support/grains.hpp"
#include "support/layouts.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// 2 / omega_max of the undeformed grain from all its eigenvalues [s].
double exact_step(const Grain<2>& grain) { return 2 / (2 * M_PI * modes(grain).back().frequency); }

TEST(CriticalStep, IsTwoOverTheHighestFrequency)
{
    Random random(1);
    double worst = 0;
    for (const auto& layout : layouts(random, { 60 }, 2))
        for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
            Grain<2> grain = make_grain(layout.mesh, material, {}, 1.7e-3, 1900);
            const double ratio = critical_step(grain, unit_critical_step(grain)) / exact_step(grain);
            // eigenvalues of a Lanczos space come from below, so steps from above
            EXPECT_GE(ratio, 1 - 1e-6) << layout.name << " " << material.law;
            EXPECT_LE(ratio, 1 + 1e-4) << layout.name << " " << material.law;
            worst = std::max(worst, ratio - 1);
        }
    std::printf("unit_critical_step is over 2 / omega_max by at most %.1e\n", worst);
}

/// Growth of the largest nodal velocity of a grain that was disturbed a little, over some steps.
double growth(double share, int steps)
{
    Random random(2);
    World world;
    Grain<2> grain = make_grain(disc_mesh(60), neo_hookean());
    const double dt = share * exact_step(grain);
    for (double& v : grain.velocity)
        v = random.uniform(-1e-9, 1e-9);
    grain.refresh();
    world.add(grain);
    for (int k = 0; k < steps; ++k)
        world.step(dt);
    world.release();
    double largest = 0;
    for (double v : world.grains[0].velocity)
        largest = std::max(largest, std::abs(v));
    return largest / 1e-9;
}

// Symplectic Euler is stable for omega dt < 2. At (1 + e) 2 / omega the fastest mode grows by 1 + sqrt(8 e) a step, at
// (1 - e) it is amplified by at most 1 / sqrt(2 e) at all times.
TEST(CriticalStep, DividesStableFromUnstable)
{
    EXPECT_LE(growth(0.998, 3000), 10 / std::sqrt(2 * 0.002));
    const double expected = 150 * std::log(1 + std::sqrt(8 * 0.002));
    EXPECT_GE(std::log(growth(1.002, 150)), 0.7 * expected); // less what of the disturbance is in other modes
}

TEST(CriticalStep, ScalesWithSizeDensityAndCompression)
{
    const auto mesh = disc_mesh(60);
    Grain<2> one = make_grain(mesh, neo_hookean()), two = make_grain(mesh, neo_hookean(), {}, 3e-3, 4000);
    const double unit = unit_critical_step(one);
    EXPECT_NEAR(unit_critical_step(two) / unit, 1, 1e-9);
    EXPECT_NEAR(critical_step(two, unit) / critical_step(one, unit), 3 * 2, 1e-12);
    one.min_stretch = 0.5;
    EXPECT_NEAR(critical_step(one, unit), 0.5 * unit * std::sqrt(1000.0) * 1e-3, 1e-12 * unit);
    one.min_stretch = 1.3;
    EXPECT_NEAR(critical_step(one, unit), unit * std::sqrt(1000.0) * 1e-3, 1e-12 * unit);
}

/// Displacements by a smooth random field, of gradients up to about the size.
void deform(Grain<2>& grain, Random& random, double size)
{
    Mat<2> gradient, bend[2];
    for (Mat<2>* matrix : { &gradient, &bend[0], &bend[1] })
        for (int i = 0; i < 4; ++i)
            (*matrix)(i / 2, i % 2) = random.uniform(-size, size) / 2;
    for (int i = 0; i < grain.mesh->master_count; ++i) {
        const Vec<2>& X = grain.mesh->node_position[i];
        for (int d = 0; d < 2; ++d)
            grain.displacement[2 * i + d] = gradient.row(d).dot(X) + X.dot(bend[d] * X) / 2;
    }
    grain.elastic_energy();
}

// Of many grains: each one's own highest frequency from all its eigenvalues, or 1.25 times its bound.
TEST(CriticalStep, OfManyIsThatOfTheStiffestAsDeformed)
{
    Random random(3);
    for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
        std::deque<Grain<2>> grains;
        double expected = 1e300, undeformed = 1e300;
        for (int k = 0; k < 21; ++k) {
            grains.push_back(make_grain(disc_mesh(k % 2 ? 60 : 80), material, {}, random.uniform(1e-3, 1.5e-3)));
            const double unit = unit_critical_step(grains.back());
            undeformed = std::min(undeformed, critical_step(grains.back(), unit));
            deform(grains.back(), random, 0.4);
            expected = std::min({ expected, exact_step(grains.back()), 1.25 * critical_step(grains.back(), unit) });
        }
        for (int threads : { 1, 2 }) {
            const double found = SmallestCriticalStep<2>()(pointers(grains), threads);
            EXPECT_GE(found, (1 - 1e-5) * expected);
            EXPECT_LE(found, 1.01 * expected); // 12 steps of Lanczos
            EXPECT_LT(found, 0.95 * undeformed);
        }
    }
}

// The deformed grain's own highest frequency, from its stiffness: the estimate from the smallest stretch has to be safe
// with the share of 0.6 that callers take.
TEST(CriticalStep, IsSafeForACompressedGrain)
{
    for (const Material& material : { neo_hookean(), mooney_rivlin() })
        for (double stretch : { 0.9, 0.7, 0.5 }) {
            Grain<2> grain = make_grain(disc_mesh(60), material);
            const Mat<2> A = (Mat<2>() << 1 / std::sqrt(stretch), 0, 0, stretch).finished();
            for (int i = 0; i < grain.mesh->master_count; ++i)
                for (int d = 0; d < 2; ++d)
                    grain.displacement[2 * i + d] = (A(d, d) - 1) * grain.mesh->node_position[i][d];
            grain.elastic_energy();
            const double estimate = critical_step(grain, unit_critical_step(make_grain(disc_mesh(60), material)));
            const double exact = exact_step(grain);
            std::printf("%s, stretches %.2f and %.2f: estimate / exact = %.2f\n", material.law, A(0, 0), A(1, 1),
                        estimate / exact);
            EXPECT_LE(0.6 * estimate, exact) << material.law << " " << stretch;
        }
}

} // namespace
