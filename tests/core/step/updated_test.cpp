// SPDX-License-Identifier: GPL-2.0-or-later
// The updated-Lagrangian form of a grain: what it conserves, and where it agrees with the total-Lagrangian one.
#include "support/implicit_world.hpp"
#include "support/random.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

GrainStart updated(const Mat<2>& velocity_gradient = Mat<2>::Zero(), const Vec<2>& velocity = Vec<2>::Zero())
{
    GrainStart start;
    start.updated = true;
    start.centre = Vec<2>(0.3, -0.2);
    start.angle = 0.4;
    start.velocity = velocity;
    start.velocity_gradient = velocity_gradient;
    return start;
}

// An affine velocity is in the range of the grid: nodes, surface and points carry it exactly, and the motion sums are those
// of the lumped masses.
TEST(UpdatedForm, IsPutWhereItIsToldWithTheVelocityItIsTold)
{
    Random random(4);
    for (int points : { 60, 276 }) {
        const Mat<2> G = random.matrix<2>(1000);
        const GrainStart start = updated(G, random.vector<2>(10));
        const Grain<2> grain = make_grain(disc_mesh(points), mooney_rivlin(), start, 2e-3, 700);
        for (int p = 0; p < grain.surface.count; ++p) {
            const Vec<2> arm = 2e-3 * turn(start.angle) * grain.mesh->surface[p].position;
            EXPECT_LE((grain.surface.x(p) - start.centre - arm).norm(), 1e-15);
            EXPECT_LE((Grain<2>(grain).surface.v(p) - start.velocity - G * arm).norm(), 1e-9);
        }
        const auto v = grain.point_velocities(), x = grain.point_positions();
        for (size_t p = 0; p < v.size(); ++p)
            EXPECT_LE((v[p] - start.velocity - G * (x[p] - start.centre)).norm(), 1e-11);
        EXPECT_LE((grain.motion.position - start.centre).norm(), 1e-15);
        EXPECT_LE((grain.motion.velocity - start.velocity).norm(), 1e-10);
        EXPECT_LE((grain.motion.mean_gradient - turn(start.angle)).norm(), 1e-12);
        const Mat<2> S = grain.motion.second_moment, SG = S * G.transpose();
        EXPECT_NEAR(grain.motion.angular_momentum[0], SG(0, 1) - SG(1, 0), 1e-11 * S.norm() * G.norm());
        EXPECT_NEAR(grain.motion.kinetic, 0.5 * grain.mass() * start.velocity.squaredNorm() + 0.5 * (G * SG).trace(),
                    1e-11 * grain.motion.kinetic);
    }
}

// A grain at rest in itself moves along as a whole, through cell after cell: the grid never shows in its deformation.
TEST(UpdatedForm, TranslatesWithoutStrain)
{
    World world;
    world.add(make_grain(disc_mesh(124), neo_hookean(), updated(Mat<2>::Zero(), Vec<2>(4, -3))));
    Grain<2>& grain = world.grains[0];
    const double dt = step_of(grain, 0.6), width = grain.mesh->cell_width * grain.radius;
    while (5 * world.time < 3 * width)
        world.step(dt);
    for (const Mat<2>& F : grain.deformation_gradients())
        ASSERT_LE((F - turn(0.4)).norm(), 1e-9);
    EXPECT_LE((grain.motion.velocity - Vec<2>(4, -3)).norm(), 1e-10);
    EXPECT_LE((grain.motion.position - Vec<2>(0.3, -0.2) - world.time * Vec<2>(4, -3)).norm(), 1e-14);
}

// A turn: F grows along v with the step, |F - Q| = O(dt) per turn, and the centrifugal strain is rho w^2 R^2 / mu = 8e-4.
TEST(UpdatedForm, TurnsAtItsRate)
{
    World world;
    GrainStart start = updated(spin(1000));
    start.angle = 0;
    world.add(make_grain(disc_mesh(124), neo_hookean(), start));
    const double dt = step_of(world.grains[0], 0.3);
    while (world.time < 2 * M_PI / 1000)
        world.step(dt);
    const Mat<2> F = world.grains[0].motion.mean_gradient;
    EXPECT_NEAR(std::atan2(F(1, 0) - F(0, 1), F(0, 0) + F(1, 1)), 1000 * world.time - 2 * M_PI, 2 * M_PI * 2e-3);
    world.evaluate();
    EXPECT_GT(world.grains[0].min_stretch, 1 - 1e-2);
    std::printf("after a turn: smallest stretch %.4f, angle off by %.1e of it\n", world.grains[0].min_stretch,
                (std::atan2(F(1, 0) - F(0, 1), F(0, 0) + F(1, 1)) - 1000 * world.time + 2 * M_PI) / (2 * M_PI));
}

// Freely vibrating: the grid moves with the points, as in the total form.
TEST(UpdatedForm, KeepsMomentumAngularMomentumAndEnergy)
{
    for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
        World world;
        const Mat<2> G = spin(4000) + (Mat<2>() << 2000, 500, -300, -1500).finished();
        world.add(make_grain(disc_mesh(124), material, updated(G, Vec<2>(3, -2))));
        const double dt = step_of(world.grains[0], 0.6);
        world.step(dt);
        const Sums before(world);
        const double energy = world.energy();
        double error = 0;
        for (int k = 0; k < 2000; ++k) {
            world.step(dt);
            if (k % 20 == 0) error = std::max(error, std::abs(world.energy() / energy - 1));
        }
        const Sums after(world);
        EXPECT_LE((after.momentum - before.momentum).norm(), 1e-12 * before.momentum.norm()) << material.law;
        EXPECT_NEAR(after.angular / before.angular, 1, 1e-10) << material.law;
        EXPECT_LE(error, 1e-3) << material.law;
        std::printf("%s, 2000 steps: momentum %.1e, angular momentum %.1e, energy within %.1e (relative)\n", material.law,
                    (after.momentum - before.momentum).norm() / before.momentum.norm(), after.angular / before.angular - 1,
                    error);
    }
}

// One half of a grain is sheared against the other until its cells are out of shape: a new grid holds the same momentum, angular
// momentum and kinetic energy, and the points keep their places and deformations.
TEST(UpdatedForm, KeepsInvariantsWhenItsGridIsLaidAnew)
{
    Random random(11);
    Grain<2> grain = make_grain(disc_mesh(276), neo_hookean(), updated(spin(300), Vec<2>(3, -2)), 2e-3, 700);
    UpdatedBody<2>& body = *grain.updated;
    const int nodes = body.grid().node_count();
    for (int i = 0; i < nodes; ++i) {
        const Vec<2> X = body.grid().node_position[i], v = body.node_velocity()[i];
        const double across = turn(0.4).transpose().row(1).dot(X);
        body.put(i, X + (across > 0 ? 2.2 * across * across : 0) * turn(0.4).col(0), v + random.vector<2>(100));
    }
    ASSERT_TRUE(body.arrive());
    const auto sums = [&] { return motion_of(grain, body.sums(*grain.mesh).data(), 1); };
    const Motion<2> before = sums();
    const auto x = body.point_positions();
    const auto F = body.deformation_gradients();
    const auto surface = body.surface();
    body.settle(*grain.mesh);
    ASSERT_NE(body.grid().node_count(), nodes); // a new one
    ASSERT_TRUE(body.arrive());
    const Motion<2> after = sums();
    EXPECT_LE((after.position - before.position).norm(), 1e-14);
    EXPECT_LE((after.velocity - before.velocity).norm(), 1e-12 * before.velocity.norm());
    EXPECT_NEAR(after.angular_momentum[0] / before.angular_momentum[0], 1, 1e-11);
    EXPECT_NEAR(after.kinetic / before.kinetic, 1, 1e-11);
    for (size_t p = 0; p < x.size(); ++p) {
        ASSERT_LE((body.point_positions()[p] - x[p]).norm(), 1e-11);
        ASSERT_LE((body.deformation_gradients()[p] - F[p]).norm(), 1e-10);
    }
    for (size_t p = 0; p < surface.size(); ++p)
        ASSERT_LE((body.surface()[p] - surface[p]).norm(), 1e-11);
    body.settle(*grain.mesh); // is in shape now
    EXPECT_EQ(sums().kinetic, after.kinetic);
}

TEST(UpdatedForm, FallsAsSymplecticEulerSays)
{
    World world;
    world.add(make_grain(disc_mesh(60), neo_hookean(), updated()));
    world.gravity = Vec<2>(1.5, -9.81);
    constexpr double dt = 2e-7;
    constexpr int steps = 2000;
    for (int k = 0; k < steps; ++k)
        world.step(dt);
    const Motion<2>& motion = world.grains[0].motion;
    EXPECT_LE((motion.velocity - steps * dt * world.gravity).norm(), 1e-13);
    EXPECT_LE((motion.position - Vec<2>(0.3, -0.2) - dt * dt * steps * (steps + 1) / 2 * world.gravity).norm(), 1e-15);
}

/// Deformation gradients of a disc with a small velocity gradient, after these steps.
template <class AnyWorld> std::vector<Mat<2>> vibrated(AnyWorld& world, bool updated, double dt, int steps)
{
    GrainStart start;
    start.updated = updated;
    start.velocity_gradient = (Mat<2>() << 40, 5, -3, -40).finished();
    world.add(make_grain(disc_mesh(124), neo_hookean(), start));
    for (int k = 0; k < steps; ++k)
        world.step(dt);
    world.grains[0].pull();
    return world.grains[0].deformation_gradients();
}

/// Largest strain of the first, and largest difference.
std::pair<double, double> apart(const std::vector<Mat<2>>& total, const std::vector<Mat<2>>& moved)
{
    double strain = 0, apart = 0;
    for (size_t p = 0; p < total.size(); ++p) {
        strain = std::max(strain, (total[p] - Mat<2>::Identity()).norm());
        apart = std::max(apart, (moved[p] - total[p]).norm());
    }
    return { strain, apart };
}

// At small strains the two forms have the same grid, in the same place, and the same law: displacements agree to the strain.
TEST(UpdatedForm, IsTheTotalFormAtSmallStrains)
{
    const double dt = step_of(make_grain(disc_mesh(124), neo_hookean(), {}), 0.5);
    World worlds[2];
    const auto [strain, explicitly] = apart(vibrated(worlds[0], false, dt, 150), vibrated(worlds[1], true, dt, 150));
    std::printf("strain %.1e, forms apart by %.1e\n", strain, explicitly);
    EXPECT_GT(strain, 1e-4);
    EXPECT_LE(explicitly, 0.05 * strain);
    for (double theta : { 0.5, 1.0 }) {
        ImplicitWorld implicit[2];
        for (ImplicitWorld& world : implicit) {
            world.settings.theta = theta;
            world.settings.tolerance = 1e-6;
        }
        const auto [strain, implicitly]
            = apart(vibrated(implicit[0], false, 5 * dt, 30), vibrated(implicit[1], true, 5 * dt, 30));
        std::printf("implicit, theta %.1f: strain %.1e, forms apart by %.1e\n", theta, strain, implicitly);
        EXPECT_GT(strain, 1e-4);
        EXPECT_LE(implicitly, 0.05 * strain);
    }
}

// Free flight by implicit steps.
TEST(UpdatedForm, KeepsMomentumAndFallsByImplicitSteps)
{
    ImplicitWorld world;
    world.settings.theta = 0.5;
    world.settings.tolerance = 1e-8;
    world.gravity = Vec<2>(1.5, -9.81);
    const Mat<2> G = spin(4000) + (Mat<2>() << 2000, 500, -300, -1500).finished();
    world.add(make_grain(disc_mesh(124), neo_hookean(), updated(G, Vec<2>(3, -2))));
    world.step(1e-6);
    const Motion<2> before = world.grains[0].motion;
    constexpr int steps = 200;
    for (int k = 0; k < steps; ++k)
        world.step(1e-6);
    const Motion<2>& after = world.grains[0].motion;
    const Vec<2> gained = steps * 1e-6 * world.gravity;
    std::printf("velocity off by %.1e m/s, angular momentum by %.1e of itself\n",
                (after.velocity - before.velocity - gained).norm(),
                after.angular_momentum[0] / before.angular_momentum[0] - 1);
    EXPECT_LE((after.velocity - before.velocity - gained).norm(), 1e-7 * before.velocity.norm());
    EXPECT_NEAR(after.angular_momentum[0] / before.angular_momentum[0], 1, 1e-3);
}

// E = V W(F) and the stress at every point of a uniform F, as in the total form.
TEST(UpdatedForm, EnergyAndStressOfAUniformDeformationAreThoseOfTheTotalForm)
{
    const Mat<2> A = (Mat<2>() << 1.1, 0.2, -0.1, 0.85).finished();
    GrainStart start;
    Grain<2> total = make_grain(disc_mesh(124), neo_hookean(), start);
    for (int i = 0; i < total.mesh->master_count; ++i)
        Eigen::Map<Vec<2>>(&total.displacement[2 * i]) = (A - Mat<2>::Identity()) * total.mesh->node_position[i];
    total.refresh();
    start.updated = true;
    Grain<2> moved = make_grain(disc_mesh(124), neo_hookean(), start);
    moved.updated->place(*moved.mesh, A);
    moved.refresh();
    EXPECT_NEAR(moved.elastic_energy() / total.elastic_energy(), 1, 1e-11);
    EXPECT_NEAR(moved.min_stretch, total.min_stretch, 1e-12);
    const auto a = total.cauchy_stresses(), b = moved.cauchy_stresses();
    for (size_t p = 0; p < a.size(); ++p)
        ASSERT_LE((a[p] - b[p]).norm(), 1e-10 * a[p].norm());
    for (int p = 0; p < total.surface.count; ++p)
        ASSERT_LE((total.surface.x(p) - moved.surface.x(p)).norm(), 1e-15);
}

TEST(UpdatedForm, TakesForcesTorquesAndVelocities)
{
    World world;
    world.add(make_grain(disc_mesh(60), neo_hookean(), updated()));
    constexpr double dt = 1e-8, alpha = 3e9, w = 40;
    world.step(dt);
    Grain<2>& grain = world.grains[0];
    grain.acceleration = Vec<2>(1e7, -2e7);
    grain.spin_acceleration = spin(alpha);
    grain.add_velocity(Vec<2>(3, 4), spin(w));
    world.step(dt);
    EXPECT_LE((grain.motion.velocity - Vec<2>(3.1, 3.8)).norm(), 1e-10);
    EXPECT_NEAR(grain.motion.angular_momentum[0] / grain.motion.second_moment.trace(), w + dt * alpha, 1e-5 * w);
}

// A grain pressed between plates at a share of the estimated stable step, far over the paper's 1e-7 s, stays whole.
TEST(UpdatedForm, IsStableBelowTheEstimatedStep)
{
    World world;
    GrainStart start;
    start.updated = true;
    world.add(make_grain(disc_mesh(124), neo_hookean(), start));
    world.planes = { { 1, 1, -1e-3, 1 }, { 1, -1, 1e-3, -1 } };
    const double unit = unit_critical_step(world.grains[0]);
    while (world.planes[1].position > 0.7e-3) {
        if (world.steps % 20 == 0 && world.steps > 0) world.evaluate();
        world.step(0.8 * critical_step(world.grains[0], unit));
    }
    EXPECT_GT(world.grains[0].min_J, 0.8);
    const double stored = world.energy() + world.balance.contact_dissipation;
    std::printf("30 %% squeeze in %d steps: least J %.3f, energy off by %+.1e of the work\n", world.steps,
                world.grains[0].min_J, stored / world.balance.external_work - 1);
    EXPECT_NEAR(stored / world.balance.external_work, 1, 5e-3);
}

TEST(UpdatedForm, StopsAtWhatCannotGoOn)
{
    const auto failure = [](const auto& spoil) -> std::string {
        World world;
        world.add(make_grain(disc_mesh(60), neo_hookean(), updated()));
        world.step(1e-8);
        spoil(world.grains[0]);
        try {
            world.step(1e-8);
            world.step(1e-8);
        } catch (const SimulationError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(failure([](Grain<2>& grain) {
                  grain.updated->place(*grain.mesh, Vec<2>(1, -1).asDiagonal());
              }).find("turned inside out (J = -1)"),
              std::string::npos);
    EXPECT_NE(failure([](Grain<2>& grain) {
                  grain.add_velocity(Vec<2>(std::numeric_limits<double>::quiet_NaN(), 0), Mat<2>::Zero());
              }).find("no longer a finite number"),
              std::string::npos);
    EXPECT_NE(failure([](Grain<2>& grain) { grain.add_velocity(Vec<2>(1e6, 0), Mat<2>::Zero()); }).find("radii in one step"),
              std::string::npos);
}

} // namespace
