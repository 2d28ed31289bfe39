// SPDX-License-Identifier: GPL-2.0-or-later
// The implicit step: order in time, energy, contact that never penetrates, equilibria that depend on nothing but the loads.
#include "grain/outline.hpp"
#include "support/implicit_world.hpp"
#include "support/twelve_discs.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// A disc stretched by a per cent and let go; displacements after 20 microseconds, a sixth of its slowest period.
std::vector<double> let_go(double theta, int steps)
{
    ImplicitWorld world;
    world.settings.theta = theta;
    world.settings.tolerance = 1e-7;
    Grain<2> grain = make_grain(disc_mesh(60), soft_neo_hookean());
    for (int i = 0; i < grain.mesh->master_count; ++i)
        for (int d = 0; d < 2; ++d)
            grain.displacement[size_t(2 * i + d)] += (d == 0 ? 0.01 : -0.01) * grain.mesh->node_position[size_t(i)][d];
    grain.refresh();
    world.add(grain);
    for (int k = 0; k < steps; ++k)
        world.step(2e-5 / steps);
    world.grains[0].pull();
    return world.grains[0].displacement;
}

double distance(const std::vector<double>& a, const std::vector<double>& b)
{
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum);
}

TEST(ThetaScheme, HasOrderOneAtOneAndOrderTwoAtOneHalf)
{
    const std::vector<double> exact = let_go(0.5, 640);
    for (double theta : { 1.0, 0.5 }) {
        const double coarse = distance(let_go(theta, 40), exact), fine = distance(let_go(theta, 80), exact);
        const double order = std::log2(coarse / fine);
        std::printf("theta %.1f: errors %.2e and %.2e, order %.2f\n", theta, coarse, fine, order);
        EXPECT_NEAR(order, theta == 0.5 ? 2 : 1, 0.1);
    }
}

// Parts of a step that are a little too short for it become the whole step again.
TEST(ImplicitRun, GoesBackToWholeSteps)
{
    ImplicitWorld world;
    world.add(make_grain(disc_mesh(60), neo_hookean()));
    world.step(1e-5);
    for (int k = 0; k < 3; ++k)
        world.step(2e-5);
    const int before = world.substeps;
    world.step(2e-5);
    EXPECT_EQ(world.substeps - before, 1);
}

struct Press {
    ImplicitWorld world;
    TwelveDiscs discs;

    explicit Press(double friction = 0)
        : discs(world, [mesh = disc_mesh(124)](int, const GrainStart& start, double radius) {
            return make_grain(mesh, neo_hookean(), start, radius);
        })
    {
        world.friction = friction;
    }
    void go(double until, double dt)
    {
        while (discs.solid_fraction() < until)
            world.step(dt);
    }
    double residual() { return (world.energy() + world.lost() + world.dissipated) / world.balance.external_work - 1; }
    double stress() const { return world.plane_force[3].y() / discs.width; }
};

// 0.2 microseconds is about the limit of explicit steps here.
TEST(ImplicitStep, IsCleanAtAnyLength)
{
    for (double dt : { 2e-6, 2e-5, 2e-4 }) {
        Press press;
        press.go(0.93, dt);
        std::printf("steps of %.0e s to 0.93: %d iterations, %d substeps, %d cuts, penetration %.1e, residual %.1e, stress "
                    "%.0f kPa, "
                    "energy %+.1e\n",
                    dt, press.world.iterations, press.world.substeps, press.world.cuts, press.world.worst_penetration,
                    press.world.worst_residual, press.stress() / 1e3, press.residual());
        EXPECT_LE(press.world.worst_penetration, 1e-4);
        EXPECT_LE(press.world.worst_residual, press.world.settings.tolerance);
        EXPECT_GT(press.world.min_J(), 0.5);
        EXPECT_LE(press.world.last.distance, 1e-5);
        EXPECT_NEAR(press.residual(), 0, 2e-3);
    }
}

// Steps so short that the forces stop the faces at once: gaps have to close to a share of next to nothing.
TEST(ImplicitStep, StartsFromFlatFacesInTouch)
{
    const Mesh square = mesh_of(PolygonOutline({ { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } }), 276);
    for (double theta : { 1.0, 0.5 })
        for (double dt : { 1e-10, 1e-8, 1e-6, 1e-5 }) {
            ImplicitWorld world;
            world.settings.theta = theta;
            const Surface<2>& surface = world.add(make_grain(square, neo_hookean())).surface;
            world.planes = { { 1, 1, surface.min[1], 0.5 }, { 1, -1, surface.max[1], -0.5 } };
            for (int k = 0; k < 5; ++k)
                world.step(dt);
            EXPECT_LE(world.cuts, 2);
            EXPECT_LE(world.worst_residual, world.settings.tolerance);
            EXPECT_LE(world.worst_penetration, 1e-4);
        }
}

// Contacts are looked for within the bounds of surfaces: those of a trial that came to nothing would hide some.
TEST(ImplicitStep, LeavesNoTraceWhereItFails)
{
    ImplicitWorld world;
    const Vec<2> centre = Vec<2>::Zero(), velocity(10, 0);
    const Surface<2>& surface = world.add(make_grain(disc_mesh(60), neo_hookean(), { centre, 0, velocity })).surface;
    const Surface<2> before = surface;
    world.planes = { { 0, -1, before.max[0], 0 } };
    world.settings.most_iterations = 0;
    EXPECT_THROW(world.step(1e-4), SimulationError);
    EXPECT_EQ(surface.position, before.position);
    EXPECT_EQ(surface.min, before.min);
    EXPECT_EQ(surface.max, before.max);
}

// A plane ahead that is near enough to be looked at but not to be reached neither stops a grain nor costs iterations.
TEST(ImplicitStep, LeavesGrainsAloneThatStandOff)
{
    const double speed = 1;
    for (double theta : { 1.0, 0.8, 0.5 })
        for (double dt : { 1e-8, 1e-7, 1e-6, 1e-5 }) {
            ImplicitWorld world;
            world.settings.theta = theta;
            const Vec<2> centre = Vec<2>::Zero(), velocity(speed, 0);
            const Grain<2>& grain = world.add(make_grain(disc_mesh(124), neo_hookean(), { centre, 0, velocity }));
            world.planes = { { 0, -1, grain.surface.max[0] + 0.05e-3 + 3 * speed * dt, 0 } };
            for (int k = 0; k < 3; ++k)
                world.step(dt);
            EXPECT_EQ(world.cuts, 0);
            EXPECT_LE(world.iterations, 6);
            EXPECT_NEAR(grain.motion.velocity[0] / speed, 1, 1e-3) << "theta " << theta << ", steps of " << dt << " s";
        }
}

TEST(ImplicitStep, AccountsForTheEnergyThatTheSchemeDissipates)
{
    Press press;
    press.go(0.95, 1e-5);
    std::printf("theta 1: %.3f of the work dissipated by the scheme, residual %+.1e\n",
                press.world.dissipated / press.world.balance.external_work, press.residual());
    EXPECT_GT(press.world.dissipated, 0);
    EXPECT_NEAR(press.residual(), 0, 5e-3);
}

// Contacts included. The balance is that of the whole run, at steps that keep to it and at longer ones that are cut.
TEST(ThetaScheme, BalancesEnergyAtOneHalf)
{
    for (double friction : { 0.0, 0.3 })
        for (double dt : { 2e-6, 2e-5, 2e-4 }) {
            Press press(friction);
            press.world.settings.theta = 0.5;
            press.go(0.93, dt);
            std::printf(
                "theta 1/2, friction %.1f, steps of %.0e s: %d iterations, %d substeps, %d cuts, scheme dissipates %+.3f "
                "of the work, residual %+.1e\n",
                friction, dt, press.world.iterations, press.world.substeps, press.world.cuts,
                press.world.dissipated / press.world.balance.external_work, press.residual());
            EXPECT_NEAR(press.residual(), 0, 5e-3);
            if (dt < 1e-4) {
                EXPECT_NEAR(press.world.dissipated / press.world.balance.external_work, 0, 0.02);
            }
            EXPECT_GT(press.world.lost(), 0);
            EXPECT_LE(press.world.worst_penetration, 1e-4);
            EXPECT_LE(press.world.worst_residual, press.world.settings.tolerance);
        }
}

// Coulomb: with friction every contact force lies in its cone, and the residual, which knows of sliding, is below the
// tolerance in every step.
TEST(ImplicitStep, CarriesFrictionToConvergence)
{
    for (bool quasistatic : { false, true }) {
        Press press(0.3);
        press.world.settings.quasistatic = quasistatic;
        press.go(0.93, 2e-5);
        std::printf("friction 0.3%s: %d iterations, residual %.1e, sliding takes %.3f of the work\n",
                    quasistatic ? ", quasi-static" : "", press.world.iterations, press.world.worst_residual,
                    press.world.balance.friction / press.world.balance.external_work);
        EXPECT_LE(press.world.worst_residual, press.world.settings.tolerance);
        EXPECT_GT(press.world.balance.friction, 0);
        EXPECT_LE(press.world.worst_penetration, 1e-4);
    }
}

/// A disc between plates, quasi-static, to 20 % squeeze.
struct Plates {
    double density = 1000, regularisation = 0.02, squeeze_of_step = 0.005, tolerance = 1e-5, friction = 0;
    double force() const // [N/m]
    {
        ImplicitWorld world;
        world.settings.quasistatic = true;
        world.settings.regularisation = regularisation;
        world.settings.tolerance = tolerance;
        world.friction = friction;
        world.add(make_grain(disc_mesh(124), neo_hookean(), {}, 1e-3, density));
        world.planes = { { 1, 1, -1e-3, 0.1 }, { 1, -1, 1e-3, -0.1 } };
        for (double done = 0; done < 0.2 - 1e-9; done += squeeze_of_step)
            world.step(squeeze_of_step * 1e-3 / 0.1);
        return (world.plane_force[1].y() - world.plane_force[0].y()) / 2;
    }
};

TEST(QuasiStatic, DependsOnNeitherDensityNorRegularisationNorSteps)
{
    const double force = Plates().force();
    EXPECT_NEAR(Plates { 50 }.force() / force, 1, 1e-9);
    const double halved = Plates { 1000, 0.01 }.force() / force - 1,
                 long_steps = Plates { 1000, 0.02, 0.02 }.force() / force - 1;
    std::printf("force %.2f N/m; regularisation halved %+.1e, four times longer steps %+.1e\n", force, halved, long_steps);
    EXPECT_NEAR(halved, 0, 1e-4);
    EXPECT_NEAR(long_steps, 0, 1e-3);
}

// Every step lets contacts that stick slide within the tolerance; a thousand of them may not let go what one holds.
TEST(QuasiStatic, PointsThatStickDoNotCreepWithTheNumberOfSteps)
{
    const double force = Plates { 1000, 0.02, 0.005, 1e-5, 0.3 }.force();
    for (double squeeze_of_step : { 0.005, 0.0002 }) {
        const double off = Plates { 1000, 0.02, squeeze_of_step, 1e-3, 0.3 }.force() / force - 1;
        std::printf("steps of %.2f %%: %+.1e\n", 100 * squeeze_of_step, off);
        EXPECT_NEAR(off, 0, 1e-3);
    }
}

} // namespace
