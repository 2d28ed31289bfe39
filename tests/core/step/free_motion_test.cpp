// SPDX-License-Identifier: GPL-2.0-or-later
// Free flight: what has to stay constant, and what stops a run.
#include "support/random.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// Grains that fly, spin and vibrate, out of each other's reach.
void add_tumbling(World& world, const Material& material, int count)
{
    for (int g = 0; g < count; ++g) {
        GrainStart start;
        start.centre = Vec<2>(0.01 * g, 0.005);
        start.velocity = Vec<2>(3, -2 + g);
        start.velocity_gradient = spin(4000) + (Mat<2>() << 2000, 500, -300, -1500).finished();
        world.add(make_grain(disc_mesh(124), material, start));
    }
}

// The force has no resultant and no couple, and positions move along momenta: symplectic Euler keeps both sums exactly;
// each step rounds anew.
TEST(FreeFlight, KeepsMomentumAndAngularMomentum)
{
    for (const Material& material : { neo_hookean(), mooney_rivlin() })
        for (int count : { 1, 3 }) { // one lane, many lanes
            World world;
            add_tumbling(world, material, count);
            const Sums before(world);
            const double dt = step_of(world.grains[0], 0.6);
            constexpr int steps = 5000;
            for (int k = 0; k < steps; ++k)
                world.step(dt);
            const Sums after(world);
            const double round_off = 4 * std::sqrt(double(steps)) * 0x1p-53 * 100; // random walk of 100 roundings a step
            EXPECT_LE((after.momentum - before.momentum).norm(), round_off * before.momentum.norm()) << material.law;
            EXPECT_NEAR(after.angular / before.angular, 1, round_off) << material.law;
            std::printf("%s, %d grains, %d steps: momentum %.1e, angular momentum %.1e (relative)\n", material.law, count,
                        steps, (after.momentum - before.momentum).norm() / before.momentum.norm(),
                        after.angular / before.angular - 1);
        }
}

// Vibrating and spinning, no contact: the kinetic + elastic energy of a step would stay in a linear material; here it
// oscillates by O(dt^2) and does not drift.
TEST(FreeFlight, KeepsEnergyToOrder2)
{
    double error[2];
    for (int k = 0; k < 2; ++k) {
        World world;
        GrainStart start;
        start.velocity_gradient = spin(3000) + (Mat<2>() << 4000, 0, 0, -4000).finished();
        world.add(make_grain(disc_mesh(124), neo_hookean(), start));
        const double dt = step_of(world.grains[0], k == 0 ? 0.6 : 0.3);
        world.step(dt);
        const double first = world.energy();
        error[k] = 0;
        while (world.time < 1e-3) {
            world.step(dt);
            error[k] = std::max(error[k], std::abs(world.energy() / first - 1));
        }
    }
    EXPECT_LE(error[0], 2e-4); // a tenth, the strain, of (omega dt)^2 / 8 of the modes that move: omega dt of 0.1
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.4);
    std::printf("energy of a free vibration: %.1e at 0.6 of the critical step, %.1e at 0.3\n", error[0], error[1]);
}

// A slow spin: the centrifugal strain, rho omega^2 R^2 / mu = 8e-4 at 1000 rad/s, changes the rate by as much.
TEST(FreeFlight, SpinsAtItsRate)
{
    World world;
    GrainStart start;
    start.velocity_gradient = spin(1000);
    world.add(make_grain(disc_mesh(124), neo_hookean(), start));
    const double dt = step_of(world.grains[0], 0.6), whole = 2 * M_PI / 1000;
    while (world.time < whole)
        world.step(dt);
    const Mat<2> F = world.grains[0].motion.mean_gradient;
    const double angle = std::atan2(F(1, 0) - F(0, 1), F(0, 0) + F(1, 1)); // polar decomposition in the plane
    EXPECT_NEAR(angle, 1000 * world.time - 2 * M_PI, 2 * M_PI * 2e-3);
    world.evaluate();
    EXPECT_GT(world.grains[0].min_stretch, 1 - 2e-3);
    EXPECT_LE(world.grains[0].motion.position.norm(), 1e-12);
}

// v_n = n g dt, x_n = g dt^2 n (n + 1) / 2.
TEST(FreeFlight, FallsAsSymplecticEulerSays)
{
    World world;
    for (int g = 0; g < 2; ++g) {
        GrainStart start;
        start.centre = Vec<2>(0.01 * g, 0);
        world.add(make_grain(disc_mesh(60), neo_hookean(), start, g ? 2e-3 : 1e-3));
    }
    world.gravity = Vec<2>(1.5, -9.81);
    constexpr double dt = 2e-7;
    constexpr int steps = 2000;
    for (int k = 0; k < steps; ++k)
        world.step(dt);
    for (int g = 0; g < 2; ++g) {
        const Motion<2>& motion = world.grains[g].motion;
        EXPECT_LE((motion.velocity - steps * dt * world.gravity).norm(), 1e-14);
        EXPECT_LE((motion.position - Vec<2>(0.01 * g, 0) - dt * dt * steps * (steps + 1) / 2 * world.gravity).norm(), 1e-16);
    }
}

TEST(FreeFlight, GoesOnTheSameAfterAPause)
{
    World through, paused;
    for (World* world : { &through, &paused })
        for (int g = 0; g < 3; ++g) {
            GrainStart start;
            start.centre = Vec<2>(0.01 * g, 0);
            start.velocity_gradient = spin(500 * g) + (Mat<2>() << 2000, 500, -300, -1500).finished();
            world->add(make_grain(disc_mesh(60), neo_hookean(), start));
        }
    for (int k = 0; k < 200; ++k) {
        through.step(2e-7);
        if (k == 77) paused.release();
        paused.step(2e-7);
    }
    through.release();
    paused.release();
    for (int g = 0; g < 3; ++g) {
        EXPECT_EQ(through.grains[g].displacement, paused.grains[g].displacement);
        EXPECT_EQ(through.grains[g].velocity, paused.grains[g].velocity);
    }
}

/// The message of the SimulationError of a step, or "".
std::string failure(World& world, double dt, int steps = 1)
{
    try {
        for (int k = 0; k < steps; ++k)
            world.step(dt);
    } catch (const SimulationError& error) {
        return error.what();
    }
    return "";
}

void add_grains(World& world, int count)
{
    for (int g = 0; g < count; ++g) {
        GrainStart start;
        start.centre = Vec<2>(0.01 * g, 0);
        world.add(make_grain(disc_mesh(60), neo_hookean(), start));
    }
}

// Surfaces that contact does not want come on demand, the same but for round-off; boxes, speeds and travels in any case.
TEST(FreeFlight, BringsSurfacesOnDemand)
{
    World wanted, other;
    for (World* world : { &wanted, &other })
        add_tumbling(*world, neo_hookean(), 3);
    const double dt = 1e-7;
    wanted.step(dt); // the assembly wants all surfaces
    other.step(dt);
    for (auto& grain : other.grains)
        grain.surface.wanted = false;
    for (int k = 0; k < 200; ++k) {
        wanted.step(dt);
        other.step(dt);
    }
    for (int g = 0; g < 3; ++g) {
        const Surface<2>& there = wanted.grains[size_t(g)].surface;
        Surface<2>& here = other.grains[size_t(g)].surface;
        EXPECT_EQ(there.min, here.min);
        EXPECT_EQ(there.max, here.max);
        EXPECT_EQ(there.speed, here.speed);
        EXPECT_EQ(there.travel, here.travel);
        EXPECT_GT((there.x(0) - here.x(0)).norm(), 1e-5);
        other.grains[size_t(g)].renew_positions();
        for (int p = 0; p < there.count; ++p)
            EXPECT_LE((there.x(p) - here.x(p)).norm(), 1e-16);
    }
}

// What rests stays as it is, to the bit, until a force, a torque, gravity, a velocity or an impulse sets it in motion.
TEST(FreeFlight, RestsUntilSomethingMovesIt)
{
    using Wake = void (*)(World&);
    const std::vector<std::pair<const char*, Wake>> ways {
        { "force", [](World& world) { world.grains[1].acceleration = Vec<2>(1, 0); } },
        { "torque", [](World& world) { world.grains[1].spin_acceleration = spin(1e3); } },
        { "gravity", [](World& world) { world.gravity = Vec<2>(0, -9.81); } },
        { "velocity", [](World& world) { world.grains[1].add_velocity(Vec<2>(1, 0), Mat<2>::Zero()); } },
        { "impulse", [](World& world) { world.planes[0].position = world.grains[0].surface.min.x() + 1e-6; } },
    };
    for (int count : { 2, 9 })
        for (const auto& [name, wake] : ways) {
            World world;
            world.planes = { { 0, 1, -1, 0 } }; // far away
            const auto mesh = disc_mesh(124);
            for (int g = 0; g < count; ++g) {
                GrainStart start;
                start.centre = Vec<2>(0.01 * g, 0.005);
                start.angle = g;
                world.add(make_grain(mesh, neo_hookean(), start));
            }
            const auto nodes = [&world](int g) {
                const auto& surface = world.grains[size_t(g)].surface;
                return surface.position;
            };
            const int woken = std::string(name) == "impulse" ? 0 : 1;
            const std::vector<double> before = nodes(woken);
            for (int k = 0; k < 100; ++k)
                world.step(1e-7);
            EXPECT_EQ(nodes(woken), before) << name;
            wake(world);
            for (int k = 0; k < 2; ++k)
                world.step(1e-7);
            EXPECT_NE(nodes(woken), before) << name;
            EXPECT_NE(world.grains[size_t(woken)].motion.kinetic, 0) << name;
        }
}

// The guards have to hold in one lane and in many, also where the compiler may reorder arithmetic.
TEST(FreeFlight, StopsAtAPointTurnedInsideOut)
{
    for (int count : { 1, 5 }) {
        World world;
        add_grains(world, count);
        Grain<2>& grain = world.grains.back();
        for (int i = 0; i < grain.mesh->master_count; ++i)
            grain.displacement[2 * i] = -1.2 * grain.mesh->node_position[i].x(); // J = -0.2
        const std::string message = failure(world, 1e-8);
        EXPECT_NE(message.find("#" + std::to_string(count - 1)), std::string::npos) << message;
        EXPECT_NE(message.find("inside out (J = -0.2)"), std::string::npos) << message;
    }
}

TEST(FreeFlight, StopsAtValuesThatAreNotFinite)
{
    for (double bad : { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
        for (int count : { 1, 5 })
            for (bool velocity : { true, false }) {
                World world;
                add_grains(world, count);
                Grain<2>& grain = world.grains.back();
                (velocity ? grain.velocity : grain.displacement)[7] = bad;
                const std::string message = failure(world, 1e-8);
                EXPECT_NE(message.find("#" + std::to_string(count - 1)), std::string::npos) << message << bad << velocity;
                EXPECT_NE(message.find("material point "), std::string::npos) << message << bad << velocity;
            }
}

// Forces and torques on a grain as a whole, and velocities added by hand, are rigid: v = dt a + u, and an angular momentum
// of I (dt alpha + w) about the centre; with I constant while nothing moves far, to O(dt w).
TEST(FreeFlight, TakesForcesTorquesAndVelocities)
{
    for (int count : { 1, 5 }) {
        World world;
        add_grains(world, count);
        constexpr double dt = 1e-8, alpha = 3e9, w = 40;
        world.step(dt);
        Grain<2>& grain = world.grains.back();
        grain.acceleration = Vec<2>(1e7, -2e7);
        grain.spin_acceleration = spin(alpha);
        grain.add_velocity(Vec<2>(3, 4), spin(w));
        world.step(dt);
        const double inertia = grain.motion.second_moment.trace();
        EXPECT_LE((grain.motion.velocity - Vec<2>(3.1, 3.8)).norm(), 1e-12);
        EXPECT_NEAR(grain.motion.angular_momentum[0] / inertia, w + dt * alpha, 1e-6 * w);
        for (int i = 0; i < count - 1; ++i)
            EXPECT_EQ(world.grains[i].motion.kinetic, 0);
        const Vec<2> place = grain.motion.position, corner = grain.surface.x(0);
        grain.translate(Vec<2>(0.5, -0.25));
        EXPECT_LE((grain.surface.x(0) - corner - Vec<2>(0.5, -0.25)).norm(), 1e-15);
        world.step(dt);
        const Vec<2> flight = dt * grain.motion.velocity;
        EXPECT_LE((grain.motion.position - place - Vec<2>(0.5, -0.25) - flight).norm(), 1e-14);
    }
}

TEST(FreeFlight, StopsAtAStepOverTheStableLimit)
{
    World world;
    add_grains(world, 2);
    world.grains[1].velocity[3] += 1e-3;
    const double dt = step_of(world.grains[1], 1.05);
    EXPECT_NE(failure(world, dt, 2000), "");
}

TEST(FreeFlight, StopsAtAGrainThatOutrunsContact)
{
    World world;
    add_grains(world, 1);
    GrainStart start;
    start.velocity = Vec<2>(1e4, 0);
    world.grains[0].place(start.centre, turn(0), start.velocity, Mat<2>::Zero());
    const std::string message = failure(world, 1e-6);
    EXPECT_NE(message.find("radii in one step"), std::string::npos) << message;
    World slow;
    add_grains(slow, 1);
    EXPECT_EQ(failure(slow, 1e-7), "");
}

} // namespace
