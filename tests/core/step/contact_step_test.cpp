// SPDX-License-Identifier: GPL-2.0-or-later
// Grains that meet: balances of momentum and energy, threads and lanes.
#include "support/layouts.hpp"
#include "support/sums.hpp"
#include "support/twelve_discs.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// Two discs of 1 and 1.3 mm that fly into each other off centre, turning.
void add_colliding_discs(World& world, int points, double speed)
{
    GrainStart left, right;
    left.centre = Vec<2>(-1.25e-3, -0.4e-3);
    left.velocity = Vec<2>(speed, 0);
    left.velocity_gradient = spin(300);
    left.angle = 0.3;
    right.centre = Vec<2>(1.1e-3, 0.4e-3);
    right.velocity = Vec<2>(-speed, 0.2 * speed);
    right.velocity_gradient = spin(-700);
    world.add(make_grain(disc_mesh(points), neo_hookean(), left, 1e-3));
    world.add(make_grain(disc_mesh(points), neo_hookean(), right, 1.3e-3));
}

struct Collision {
    int touching = 0;
    double momentum, angular, energy, dissipated; ///< changes, relative
    explicit Collision(World& world, double share, double duration = 4e-4)
    {
        const double dt = step_of(world.grains[0], share);
        const Sums before(world);
        world.step(dt);
        const double first = world.energy();
        while (world.time < duration) {
            world.step(dt);
            touching += std::any_of(world.problem.contacts.begin(), world.problem.contacts.end(),
                                    [](const auto& c) { return c.impulse.norm() > 0; });
        }
        const Sums after(world);
        momentum = (after.momentum - before.momentum).norm() / before.size;
        angular = (after.angular - before.angular) / (before.size * 1e-3);
        energy = (world.energy() + world.lost()) / first - 1;
        dissipated = world.lost() / first;
    }
};

// Impulses are equal and opposite, along the line of point and foot: momentum and, without friction, angular momentum stay.
TEST(Collision, KeepsMomentumAndAngularMomentumWithoutFriction)
{
    World world;
    add_colliding_discs(world, 124, 2);
    const Collision collision(world, 0.5);
    EXPECT_GT(collision.touching, 100);
    EXPECT_EQ(world.problem.contacts.size(), 0u) << "apart again";
    EXPECT_LE(collision.momentum, 1e-13);
    EXPECT_LE(std::abs(collision.angular), 1e-13);
    EXPECT_GE(world.balance.contact_dissipation, 0);
    EXPECT_NEAR(world.balance.friction, 0, 1e-15 * world.energy());
    std::printf("collision, %d steps in touch: momentum %.1e, angular momentum %.1e, energy %.1e, dissipated %.1e\n",
                collision.touching, collision.momentum, collision.angular, collision.energy, collision.dissipated);
}

// Friction acts at the point on the one side and at the foot on the other: its couple on the pair is friction x gap.
TEST(Collision, WithFrictionKeepsMomentumAndAngularMomentumToTheGap)
{
    World world;
    world.friction = 0.5;
    add_colliding_discs(world, 124, 2);
    const Collision collision(world, 0.5);
    EXPECT_LE(collision.momentum, 1e-13);
    EXPECT_GT(world.balance.friction, 0);
    // the frictional impulse is at most mu times the normal one, that at most the momentum of both; contacts are closed
    // within 1e-4 of the radius
    EXPECT_LE(std::abs(collision.angular), world.friction * 2 * 1e-4);
    std::printf("collision with friction: momentum %.1e, angular momentum %.1e, energy %.1e, dissipated %.1e\n",
                collision.momentum, collision.angular, collision.energy, collision.dissipated);
}

// Kinetic + elastic + dissipated energy: each contact's work is exact over a step, the rest is of the step's order (see
// FreeFlight.KeepsEnergyToOrder2).
TEST(Collision, BalancesItsEnergy)
{
    for (double friction : { 0.0, 0.5 }) {
        double error[2];
        for (int k = 0; k < 2; ++k) {
            World world;
            world.friction = friction;
            add_colliding_discs(world, 124, 2);
            error[k] = std::abs(Collision(world, k == 0 ? 0.5 : 0.125).energy);
        }
        EXPECT_LE(error[0], 1e-4); // single runs scatter, as impacts start at any part of a step
        EXPECT_LE(error[1], 1e-4 / 16);
        std::printf("energy of a collision, friction %.1f: %.1e at half the critical step, %.1e at an eighth\n", friction,
                    error[0], error[1]);
    }
}

/// A box full of discs and a few other shapes that is being closed.
void add_crowd(World& world, int across, int points, double spacing, bool shapes_too)
{
    const auto disc = disc_mesh(points);
    std::vector<Mesh> others;
    if (shapes_too)
        for (const auto& shape : shapes())
            if (shape.name == "hexagon" || shape.name == "ellipse") others.push_back(mesh_of(*shape.outline, points));
    Random random(5);
    for (int i = 0; i < across; ++i)
        for (int j = 0; j < across; ++j) {
            GrainStart start;
            start.centre = spacing * Vec<2>(i + 0.5, j + 0.5);
            start.angle = random.uniform(0, 7);
            start.velocity = random.vector<2>(1);
            start.velocity_gradient = spin(random.uniform(-500, 500));
            const int k = i * across + j;
            const auto mesh = shapes_too && k % 5 == 4 ? others[size_t(k / 5) % others.size()] : disc;
            world.add(make_grain(mesh, k % 3 ? neo_hookean() : mooney_rivlin(), start, random.uniform(0.9e-3, 1.0e-3)));
        }
    const double side = across * spacing;
    world.planes = { { 0, 1, 0, 1 }, { 0, -1, side, -1 }, { 1, 1, 0, 0 }, { 1, -1, side, -2 } };
    world.friction = 0.3;
}

std::vector<std::vector<double>> states(World& world)
{
    world.release();
    std::vector<std::vector<double>> all;
    for (const auto& grain : world.grains) {
        all.push_back(grain.displacement);
        all.push_back(grain.velocity);
    }
    return all;
}

TEST(Result, IsTheSameBitForBitForEveryNumberOfThreads)
{
    std::vector<std::vector<std::vector<double>>> results;
    for (int threads : { 1, 2, 3 }) {
        World world;
        add_crowd(world, 4, 60, 2.0e-3, true);
        world.threads = world.solver.threads = threads;
        int contacts = 0;
        for (int k = 0; k < 300; ++k) {
            world.step(2e-7);
            contacts += int(world.problem.contacts.size());
        }
        EXPECT_GT(contacts, 300 * 8);
        results.push_back(states(world));
    }
    EXPECT_EQ(results[1], results[0]);
    EXPECT_EQ(results[2], results[0]);
}

// The solver shares its sweeps between threads only when there are many contacts and several strips.
TEST(Result, IsTheSameBitForBitWhenTheSolverRunsOnThreads)
{
    std::vector<std::vector<std::vector<double>>> results;
    for (int threads : { 1, 3 }) {
        World world;
        add_crowd(world, 24, 30, 1.85e-3, false);
        world.threads = world.solver.threads = threads;
        for (int k = 0; k < 4; ++k)
            world.step(2e-7);
        EXPECT_GT(world.problem.contacts.size(), 1000u); // two threads' worth
        EXPECT_LE(world.problem.residual(), 1e-4);
        EXPECT_LT(world.sweeps, 4 * 1000);
        results.push_back(states(world));
    }
    EXPECT_EQ(results[1], results[0]);
}

// The order of the grains in the assembly decides which lane and batch each is in, and nothing else.
TEST(Result, IsTheSameBitForBitInEveryLane)
{
    std::vector<std::vector<std::vector<double>>> results;
    for (int variant = 0; variant < 3; ++variant) {
        World world;
        add_crowd(world, 4, 60, 2.0e-3, false);
        for (int k = 0; k < 16; ++k)
            world.order.push_back(variant == 0 ? k : variant == 1 ? 15 - k : (7 * k + 3) % 16);
        for (int k = 0; k < 200; ++k)
            world.step(2e-7);
        results.push_back(states(world));
    }
    EXPECT_EQ(results[1], results[0]);
    EXPECT_EQ(results[2], results[0]);
}

// Twelve discs of two materials, pressed from a loose state to solid fraction 0.95 at 1 m/s.
TEST(Compaction, TwelveDiscsStayWhole)
{
    World world;
    const TwelveDiscs discs(world, [](int row, const GrainStart& start, double radius) { // a mesh and so a batch for each
        return make_grain(disc_mesh(124), row % 2 ? neo_hookean() : mooney_rivlin(), start, radius);
    });
    world.solver.tolerance = 1e-3;
    std::vector<double> unit;
    for (const auto& grain : world.grains)
        unit.push_back(unit_critical_step(grain));
    double dt = 1e300, deepest = 0, min_J = 1;
    const auto renew = [&] {
        dt = 1e300;
        for (size_t g = 0; g < world.grains.size(); ++g) {
            dt = std::min(dt, 0.6 * critical_step(world.grains[g], unit[g]));
            min_J = std::min(min_J, world.grains[g].min_J);
        }
    };
    renew();
    while (discs.solid_fraction() < 0.95) {
        world.step(dt);
        deepest = std::min(deepest, world.deepest);
        if (world.steps % 20 == 0) {
            world.evaluate();
            renew();
        }
    }
    const double total = world.energy() + world.lost();
    EXPECT_GT(min_J, 0.5);
    EXPECT_GE(deepest, -5e-3 * 1.15e-3);
    EXPECT_NEAR(total / world.balance.external_work, 1, 5e-3);
    EXPECT_GE(world.balance.contact_dissipation, 0);
    for (const auto& grain : world.grains) {
        EXPECT_GT(grain.surface.min.x(), -1e-5);
        EXPECT_LT(grain.surface.max.x(), discs.width + 1e-5);
    }
    std::printf("12 discs to 0.95: %d steps, %.1f sweeps a step, J >= %.3f, deepest %.1e R, energy %+.1e of the work, "
                "residual %.1e\n",
                world.steps, double(world.sweeps) / world.steps, min_J, -deepest / 1e-3,
                total / world.balance.external_work - 1, world.problem.residual());
}

} // namespace
