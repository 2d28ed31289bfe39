// SPDX-License-Identifier: GPL-2.0-or-later
// A plastic disc squeezed between plates and released, against finite elements of another code (P_plates.csv).
#include "plates.hpp"
#include "reference.hpp"
#include "support/implicit_world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double R = 1e-3, mu = 1e6;
const Material metal { "plastic", { 1.5e6, mu, 0.01e6, 0.1e6 } };

/// Rows of the table on the way in, and on the way out.
struct Reference {
    std::vector<double> approach, force, half_width;
    size_t top = 0; ///< the row where the plates turn

    Reference()
    {
        const Table table("P_plates.csv");
        approach = table["approach"];
        force = table["force"];
        half_width = table["half_width"];
        while (top + 1 < approach.size() && approach[top + 1] > approach[top])
            ++top;
    }
    double at(double place, const std::vector<double>& values, bool back) const
    {
        size_t k = back ? top : 0;
        const auto passed = [&](size_t i) { return back ? approach[i] <= place + 1e-9 : approach[i] >= place - 1e-9; };
        while (!passed(k + 1))
            ++k;
        const double share = (place - approach[k]) / (approach[k + 1] - approach[k]);
        return (1 - share) * values[k] + share * values[k + 1];
    }
};

struct Errors {
    double rms = 0, worst = 0, width = 0, back = 0; ///< of the force; of the half-width, over R; of the force on the way out
};

Errors quasi_static(int points, const std::array<double, 3>& placing)
{
    static const Reference reference;
    ImplicitWorld world;
    world.settings.quasistatic = true;
    GrainStart start;
    start.angle = placing[2];
    world.add(make_grain(disc_mesh(points, placing[0], placing[1]), metal, start, R));
    world.planes = { { 1, 1, -R, R }, { 1, -1, R, -R } }; // a radius a second
    const auto force = [&] { return (world.plane_force[1].y() - world.plane_force[0].y()) / 2 / (mu * R); };
    Errors errors;
    int count = 0;
    for (double approach = 0.005; approach < 0.3001; approach += 0.005, ++count) {
        world.step(0.005);
        if (approach < 0.0499) continue;
        const double error = force() / reference.at(approach, reference.force, false) - 1;
        errors.rms += error * error;
        errors.worst = std::max(errors.worst, std::abs(error));
        const double width = (world.grains[0].surface.max.x() - world.grains[0].surface.min.x()) / 2 / R;
        errors.width = std::max(errors.width, std::abs(width - reference.at(approach, reference.half_width, false)));
    }
    errors.rms = std::sqrt(errors.rms / (count - 9));
    for (Plane& plane : world.planes)
        plane.speed *= -1;
    const double most = reference.force[reference.top];
    for (double approach = 0.3 - 0.0005; approach > 0.2925; approach -= 0.0005) {
        world.step(0.0005);
        errors.back = std::max(errors.back, std::abs(force() - reference.at(approach, reference.force, true)) / most);
    }
    return errors;
}

TEST(PlasticPlates, ForceAndShapeAgreeWithFiniteElements)
{
    Errors all[2];
    const int points[2] { 276, 1200 };
    for (int k : { 0, 1 }) {
        Random random(5);
        constexpr int placings = 6;
        for (int n = 0; n < placings; ++n) {
            const Errors errors = quasi_static(points[k], random_placing(random));
            all[k].rms += errors.rms * errors.rms / placings;
            all[k].worst = std::max(all[k].worst, errors.worst);
            all[k].width = std::max(all[k].width, errors.width);
            all[k].back = std::max(all[k].back, errors.back);
        }
        all[k].rms = std::sqrt(all[k].rms);
        std::printf(
            "%d points: force rms %.2f %%, worst %.2f %%; half-width %.4f R; on the way out %.2f %% of the largest\n",
            points[k], 100 * all[k].rms, 100 * all[k].worst, all[k].width, 100 * all[k].back);
    }
    EXPECT_LE(all[0].rms, 0.02);
    EXPECT_LE(all[1].rms, 0.01);
    EXPECT_LE(all[1].width, 0.005);
    EXPECT_LE(all[1].back, 0.02);
}

// With inertia, in steps of 0.25 % of a radius: what walls work is held, dissipated by flow and friction, or by the scheme.
TEST(PlasticPlates, ImplicitStepsKeepTheBalanceOfEnergies)
{
    for (double theta : { 1.0, 0.6 })
        for (double friction : { 0.0, 0.4 }) {
            ImplicitWorld world;
            world.settings.theta = theta;
            world.friction = friction;
            world.add(make_grain(disc_mesh(276), metal, {}, R));
            world.planes = { { 1, 1, -R, 0.1 }, { 1, -1, R, -0.1 } };
            for (int k = 0; k < 120; ++k)
                world.step(0.0025 * R / 0.1);
            const double held = world.energy() + world.flowed + world.dissipated + world.lost(),
                         missing = held / world.balance.external_work - 1;
            std::printf("theta %.1f, friction %.1f: flow took %.3f of the work, the scheme %.3f; missing %+.1e\n", theta,
                        friction, world.flowed / world.balance.external_work, world.dissipated / world.balance.external_work,
                        missing);
            EXPECT_GT(world.flowed, 0.5 * world.balance.external_work);
            EXPECT_NEAR(missing, 0, 5e-3);
        }
}

// The explicit scheme at 0.05 m/s: the same force, and energies that balance.
TEST(PlasticPlates, ExplicitStepsGiveTheSameForce)
{
    static const Reference reference;
    SqueezeCase c;
    c.material = metal;
    c.speed = 0.05;
    c.until = 0.3;
    const Squeeze run = squeeze(c);
    double rms = 0, worst = 0;
    int count = 0;
    for (const auto& window : run.windows) {
        if (window.squeeze < 0.1 || window.squeeze > 0.299) continue;
        const double error = window.force / (mu * R) / reference.at(window.squeeze, reference.force, false) - 1;
        rms += error * error;
        worst = std::max(worst, std::abs(error));
        ++count;
    }
    rms = std::sqrt(rms / count);
    std::printf("explicit, 276 points: force rms %.2f %%, worst %.2f %%; energy %+.1e; %d steps\n", 100 * rms, 100 * worst,
                run.residual, run.steps);
    EXPECT_LE(rms, 0.02);
    EXPECT_LE(std::abs(run.residual), 2e-3);
}

} // namespace
