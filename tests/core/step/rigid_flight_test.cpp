// SPDX-License-Identifier: GPL-2.0-or-later
// Grains in flight move as rigid bodies: what that keeps, when they take off, and what it changes.
#include "support/layouts.hpp"
#include "support/random.hpp"
#include "support/sums.hpp"

#include "step/rigid_flight.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

// Thrown, undeformed: x_n = x_0 + n dt v_0 + dt^2 g n (n + 1) / 2 of symplectic Euler, and no strain, for every shape.
TEST(RigidFlight, OfAThrownGrainIsThatOfAPoint)
{
    Random random(1);
    for (const auto& layout : layouts(random, { 60 }, 2)) {
        World world;
        world.gravity = Vec<2>(0.5, -9.81);
        GrainStart start;
        start.angle = 0.7;
        start.velocity = Vec<2>(1, 2);
        world.add(make_grain(layout.mesh, neo_hookean(), start));
        Grain<2>& grain = world.grains[0];
        const Vec<2> origin = grain.motion.position;
        constexpr int steps = 1000;
        constexpr double dt = 1e-6;
        for (int k = 0; k < steps; ++k)
            world.step(dt);
        EXPECT_EQ(world.flying(), 1) << layout.name;
        const Vec<2> expected = origin + steps * dt * start.velocity + dt * dt * steps * (steps + 1) / 2 * world.gravity;
        EXPECT_LE((grain.motion.position - expected).norm(), 1e-15) << layout.name;
        grain.pull();
        for (const Mat<2>& F : grain.deformation_gradients())
            ASSERT_LE((F - turn(start.angle)).norm(), 1e-12) << layout.name;
        for (const Vec<2>& v : grain.point_velocities())
            ASSERT_LE((v - grain.motion.velocity).norm(), 1e-12) << layout.name;
    }
}

/// A grain that spins and vibrates, so viscous that it soon stops to vibrate.
void add_tumbling(World& world, double below, double strain_rate)
{
    GrainStart start;
    start.velocity = Vec<2>(0.3, -0.2);
    start.velocity_gradient = spin(100) + (Mat<2>() << strain_rate, 0, 0, -strain_rate).finished();
    world.add(make_grain(disc_mesh(124), soft_neo_hookean(), start));
    world.grains[0].viscosity = 5;
    world.rigid_below = below;
}

double vibration(const Grain<2>& grain)
{
    const Motion<2>& m = grain.motion;
    return m.kinetic - grain.mass() / 2 * m.velocity.squaredNorm()
        - m.angular_momentum[0] * m.angular_momentum[0] / m.second_moment.trace() / 2;
}

// It takes off as soon as the energy of vibration and deformation is below that of the tolerance, loses what vibrated, and
// nothing else: momentum, angular momentum and shape stay, and it turns at its spin.
TEST(RigidFlight, BeginsBelowTheToleranceAndKeepsTheRest)
{
    constexpr double below = 1e-2;
    World world;
    add_tumbling(world, below, 3000);
    Grain<2>& grain = world.grains[0];
    const double most = below * below / 2 * 1e6 * M_PI * 1e-6, dt = 0.5 * step_of(grain, 1);
    const Sums first(world);
    world.step(dt);
    double held = world.energy(), before = held, lost = 0;
    EXPECT_GT(vibration(grain) + grain.elastic, 10 * most);
    while (world.flying() == 0 && world.steps < 20000) {
        grain.pull();
        before = vibration(grain) + grain.elastic_energy();
        world.step(dt);
        world.energy();
        const auto dissipated = world.dissipated();
        held -= dissipated.viscous;
        lost += dissipated.numerical;
    }
    ASSERT_EQ(world.flying(), 1);
    EXPECT_GT(before, most); // in the step before
    EXPECT_GT(lost, 0);
    EXPECT_LE(lost, most);
    EXPECT_NEAR((world.energy() + lost) / held, 1, 1e-3); // viscosity's balance is of second order

    const double rate = grain.motion.angular_momentum[0] / grain.motion.second_moment.trace(), start = world.time;
    const Mat<2> F = grain.motion.mean_gradient;
    const Vec<2> place = grain.motion.position;
    for (int k = 0; k < 3000; ++k)
        world.step(dt);
    const Sums last(world);
    EXPECT_LE((last.momentum - first.momentum).norm(), 1e-12 * first.momentum.norm());
    EXPECT_NEAR(last.angular / first.angular, 1, 1e-11);
    const Mat<2> Q = turn(rate * (world.time - start));
    EXPECT_LE((grain.motion.mean_gradient - Q * F).norm(), 1e-10);
    EXPECT_LE((grain.motion.position - place - (world.time - start) * grain.motion.velocity).norm(), 1e-14);

    // nodes and surface say the same
    const std::vector<double> surface = grain.surface.position;
    grain.pull();
    Grain<2> copy = grain;
    copy.flight.reset();
    copy.refresh();
    for (size_t i = 0; i < surface.size(); ++i)
        ASSERT_NEAR(copy.surface.position[i], surface[i], 1e-15);
    EXPECT_LE((copy.motion.mean_gradient - grain.motion.mean_gradient).norm(), 1e-10);
    EXPECT_NEAR(copy.motion.angular_momentum[0] / grain.motion.angular_momentum[0], 1, 1e-10);
    EXPECT_NEAR(copy.motion.kinetic / grain.motion.kinetic, 1, 1e-10);
}

// A spin that would strain the grain by more than the tolerance, rho omega^2 R^2 / 2 of mu, keeps it from taking off.
TEST(RigidFlight, DoesNotBeginWhereSpinStrains)
{
    for (double rate : { 100.0, 400.0 }) {
        World world;
        add_tumbling(world, 1e-2, 0);
        world.grains[0].add_velocity(Vec<2>::Zero(), spin(rate - 100));
        for (int k = 0; k < 3000; ++k)
            world.step(1e-6);
        EXPECT_EQ(world.flying(), rate * rate * 1e-6 * 1000 / 2 < 1e-2 * 1e6) << rate;
    }
}

/// Speed of a viscous grain after it went to and fro between two planes [m/s].
double bounced(double below)
{
    World world;
    world.planes = { { 0, 1, -1.5e-3, 0 }, { 0, -1, 1.5e-3, 0 } };
    GrainStart start;
    start.velocity = Vec<2>(1, 0);
    world.add(make_grain(disc_mesh(124), soft_neo_hookean(), start));
    world.grains[0].viscosity = 2;
    world.rigid_below = below;
    const Grain<2>& grain = world.grains[0];
    int flights = 0, last = 0;
    while (world.time < 6e-3) {
        world.step(5e-7);
        flights += world.flying() > last;
        last = world.flying();
    }
    EXPECT_GE(flights, below > 0 ? 3 : 1);
    return grain.motion.velocity.norm();
}

// Vibrations of the tolerance have velocities of that share of the wave speed. Gone, they change what an impact gives by no more.
TEST(RigidFlight, ChangesVelocitiesByNoMoreThanItsTolerance)
{
    const double exact = bounced(0), wave_speed = std::sqrt(1e6 / 1000);
    for (double below : { 1e-2, 1e-3, 1e-4 }) {
        const double off = bounced(below) - exact;
        std::printf("rigid below %.0e: %.1e m/s of %.1e m/s, tolerance %.1e\n", below, off, exact, below * wave_speed);
        EXPECT_LE(std::abs(off), below * wave_speed);
    }
}

// In which lane a grain sits, and beside which others, makes no difference to the last digit, however often they change places.
TEST(Seating, DoesNotChangeFields)
{
    Random random(2);
    const auto mesh = disc_mesh(60), other = disc_mesh(30);
    std::deque<Grain<2>> grains;
    for (int g = 0; g < 21; ++g)
        grains.push_back(make_grain(g % 3 ? mesh : other, g % 2 ? neo_hookean() : mooney_rivlin()));
    for (Grain<2>& grain : grains)
        for (double& u : grain.displacement)
            u += random.uniform(-1e-3, 1e-3);
    const auto before = grains;
    Seating<2> seating(pointers(grains));
    for (Grain<2>& grain : grains)
        seating.put_in(grain);
    for (int k = 0; k < 200; ++k) {
        Grain<2>& grain = grains[size_t(random.integer(0, 20))];
        if (grain.batch)
            seating.take_out(grain);
        else
            seating.put_in(grain);
        int seated = 0, partial = 0;
        for (int b = 0; b < seating.count(); ++b) {
            const int members = int(seating.members(b).size());
            seated += members;
            partial += members > 0 && members < seating.batch(b).lanes;
            for (int lane = 0; lane < members; ++lane)
                ASSERT_EQ(seating.members(b)[size_t(lane)]->lane, lane);
        }
        ASSERT_LE(partial, 4); // one of each mesh and law
        ASSERT_EQ(seated, std::count_if(grains.begin(), grains.end(), [](const Grain<2>& g) { return g.batch; }));
    }
    for (size_t g = 0; g < grains.size(); ++g) {
        std::fill(grains[g].displacement.begin(), grains[g].displacement.end(), 0);
        if (!grains[g].batch) continue;
        grains[g].pull();
        ASSERT_EQ(grains[g].displacement, before[g].displacement) << g;
    }
}

} // namespace
