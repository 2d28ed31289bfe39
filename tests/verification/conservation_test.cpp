// SPDX-License-Identifier: GPL-2.0-or-later
// Long runs and impacts: what is conserved, and what impacts of elastic grains turn kinetic energy into.
#include "support/shapes.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

// A million steps of a grain that spins, moves and vibrates: angular momentum to a random walk of round-off, and an energy that
// oscillates but has no drift, as is known of symplectic schemes over exponentially long times (Hairer, Lubich and Wanner 2003).
TEST(Conservation, SpinsForAMillionSteps)
{
    World world;
    GrainStart start;
    start.velocity = Vec<2>(0.3, -0.2);
    start.velocity_gradient
        = spin(8000) + (Mat<2>() << 2000, 0, 0, -2000).finished(); // centrifugal strain of 5 %, and a vibration
    world.add(make_grain(disc_mesh(30), neo_hookean(), start));
    const double dt = step_of(world.grains[0], 0.6);
    world.step(dt);
    const Sums before(world);
    const double spin_before = world.grains[0].motion.angular_momentum[0], first = world.energy();
    constexpr int steps = 1000000, parts = 10;
    double worst = 0, mean[parts] {};
    for (int k = 0; k < steps; ++k) {
        world.step(dt);
        if (k % 100 != 99) continue;
        const double change = world.energy() / first - 1;
        worst = std::max(worst, std::abs(change));
        mean[k / (steps / parts)] += change / (steps / parts / 100);
    }
    const Sums after(world);
    const double momentum = (after.momentum - before.momentum).norm() / before.size;
    const double angular = world.grains[0].motion.angular_momentum[0] / spin_before - 1;
    // drift: line of least squares through the means of the ten parts, over the whole run
    double slope = 0, spread = 0;
    for (int p = 0; p < parts; ++p) {
        slope += (p - 4.5) * mean[p];
        spread += (p - 4.5) * (p - 4.5);
    }
    const double drift = slope / spread * parts;
    std::printf(
        "%d points, %d steps, %.0f turns: momentum %.1e, angular momentum %.1e, energy within %.1e, its drift %.1e\n",
        world.grains[0].mesh->point_count(), steps, 8000 * world.time / (2 * M_PI), momentum, angular, worst, drift);
    const double round_off = 4 * std::sqrt(double(steps)) * 0x1p-53 * 100; // random walk of 100 roundings a step
    EXPECT_LE(momentum, round_off);
    EXPECT_LE(std::abs(angular), round_off);
    EXPECT_LE(worst, 1e-3);
    EXPECT_LE(std::abs(drift), 0.05 * worst);
}

struct Impact {
    double momentum = 0, angular = 0, residual = 0;        ///< over m |v|, m |v| R and the energy; largest of the run
    double least_kinetic = 1, most_elastic = 0;            ///< shares of the energy, at closest approach
    double restitution = 0, vibration = 0, dissipated = 0; ///< of centres; shares of the energy at the end
    double touching = 0;                                   ///< [s]
};

/// Two discs of R = 0.2 m, E = 1000 Pa, nu = 0.3, rho = 1000 kg/m3 approach along a diagonal, (0.1, 0.1) m/s each (Sulsky, Chen
/// and Schreyer 1994).
Impact collide(int points, double share)
{
    const double E = 1000, nu = 0.3, speed = 0.1;
    const Material material { "Neo-Hookean", { E * nu / ((1 + nu) * (1 - 2 * nu)), E / (2 * (1 + nu)) } };
    World world;
    for (int side : { -1, 1 }) {
        GrainStart start;
        start.centre = Vec<2>(0.5 + 0.3 * side, 0.5 + 0.3 * side);
        start.velocity = Vec<2>(-side * speed, -side * speed);
        world.add(make_grain(disc_mesh(points), material, start, 0.2, 1000));
    }
    const Vec<2> along = Vec<2>(1, 1).normalized();
    const auto approach = [&] { return (world.grains[0].motion.velocity - world.grains[1].motion.velocity).dot(along); };
    const double dt = step_of(world.grains[0], share);
    Impact result;
    const Sums before(world);
    const double closing = approach(), first = world.grains[0].motion.kinetic + world.grains[1].motion.kinetic;
    while (world.time < 4) {
        world.step(dt);
        const double total = world.energy(), lost = world.lost();
        const double kinetic = (world.grains[0].motion.kinetic + world.grains[1].motion.kinetic) / first;
        const Sums now(world);
        result.momentum = std::max(result.momentum, (now.momentum - before.momentum).norm() / before.size);
        result.angular = std::max(result.angular, std::abs(now.angular - before.angular) / (before.size * 0.2));
        result.residual = std::max(result.residual, std::abs((total + lost) / first - 1));
        result.least_kinetic = std::min(result.least_kinetic, kinetic);
        result.most_elastic = std::max(result.most_elastic, total / first - kinetic);
        result.dissipated = lost / first;
        for (const auto& contact : world.problem.contacts)
            if (contact.impulse.norm() > 0) {
                result.touching += dt;
                break;
            }
    }
    EXPECT_EQ(world.problem.contacts.size(), 0u) << "apart again";
    result.restitution = -approach() / closing;
    result.vibration = 1 - result.dissipated - result.restitution * result.restitution;
    return result;
}

// Momenta to round-off. Kinetic energy goes into elastic energy and most of it comes back; what stays is vibration. Surface
// points stop where they meet, so that the mass that goes with them loses its energy: that is of the order of the cell width.
// The residual of the balance is of order 2 in the step (finite strain, see doc/theory.md, section 7).
TEST(Conservation, TwoElasticDiscsCollide)
{
    const auto print = [](const char* what, const Impact& i) {
        std::printf("%s: momentum %.1e, angular momentum %.1e, energy residual %.1e; at closest kinetic %.4f, elastic %.4f; "
                    "in touch "
                    "%.2f s; restitution %.4f, vibration %.4f, dissipated by contacts %.4f\n",
                    what, i.momentum, i.angular, i.residual, i.least_kinetic, i.most_elastic, i.touching, i.restitution,
                    i.vibration, i.dissipated);
        EXPECT_LE(i.momentum, 1e-14); // of 500 to 1500 steps
        EXPECT_LE(i.angular, 1e-12);
    };
    std::vector<Impact> impacts;
    std::vector<double> width;
    for (int points : { 124, 276, 600, 1200 }) {
        impacts.push_back(collide(points, 0.5));
        width.push_back(disc_mesh(points)->cell_width);
        print((std::to_string(points) + " points").c_str(), impacts.back());
        EXPECT_GE(impacts.back().dissipated, 0);
    }
    const double order = std::log(impacts[0].dissipated / impacts[3].dissipated) / std::log(width[0] / width[3]);
    std::printf("dissipation by contacts is of order %.2f in the cell width\n", order);
    EXPECT_NEAR(order, 1, 0.3);
    for (size_t k = 1; k < impacts.size(); ++k)
        EXPECT_GT(impacts[k].restitution, impacts[k - 1].restitution);
    const Impact small = collide(276, 0.125);
    print("276 points, a quarter of the step", small);
    EXPECT_LE(small.residual, impacts[1].residual / 8);
}

// A bar that meets a rigid wall end on at v (Goldsmith 1960, on longitudinal impact of rods): the wall feels rho c v H from the
// meeting until the wave is back after 2 L / c, and the bar leaves at v. c is the speed of long waves in plane strain. Lateral
// inertia, of order H / L, lengthens the fronts and keeps some energy back.
TEST(Conservation, AnElasticBarReboundsFromAWall)
{
    constexpr double length = 1e-2, height = 1e-3, density = 1000;
    const Material material = soft_neo_hookean();
    const double lambda = material.parameters[0], mu = material.parameters[1];
    const double c = std::sqrt(4 * mu * (lambda + mu) / (lambda + 2 * mu) / density), speed = 1e-3 * c,
                 passage = 2 * length / c;
    const double mass = density * length * height, wave_force = density * c * speed * height;
    double before = 0;
    for (int across : { 4, 8 }) {
        const auto mesh = mesh_of(PolygonOutline(rectangle_vertices(length, height)), 40 * across * across);
        World world;
        GrainStart start;
        start.centre = Vec<2>(length / 2 + 0.1 * speed * passage, 0);
        start.velocity = Vec<2>(-speed, 0);
        world.add(make_grain(mesh, material, start, std::sqrt(length * height / M_PI), density));
        world.planes = { { 0, 1, 0, 0 } };
        const double dt = step_of(world.grains[0], 0.5);
        double impulse = 0, first = 0, last = 0, plateau = 0, plateau_time = 0; // force in the middle of the contact
        while (world.time < 2 * passage) {
            world.step(dt);
            const double force = -world.plane_force[0].x();
            impulse += dt * force;
            if (force > 0 && first == 0) first = world.time;
            if (force > 0) last = world.time;
            if (first > 0 && world.time > first + 0.1 * passage && world.time < first + 0.9 * passage) {
                plateau += dt * force;
                plateau_time += dt;
            }
        }
        const double restitution = world.grains[0].motion.velocity.x() / speed;
        std::printf(
            "%d points: force %.4f of rho c v H, in touch %.4f of 2 L / c, restitution %.4f, dissipated by contacts %.1e\n",
            mesh->point_count(), plateau / plateau_time / wave_force, (last - first) / passage, restitution,
            world.balance.contact_dissipation / (mass * speed * speed / 2));
        EXPECT_NEAR(plateau / plateau_time / wave_force, 1, 0.01);
        EXPECT_NEAR((last - first) / passage, 1, 0.05); // half of H / L
        EXPECT_NEAR(impulse / (mass * speed), 1 + restitution, 1e-12);
        EXPECT_GE(restitution, 0.93);
        EXPECT_GT(restitution, before);
        before = restitution;
    }
}

} // namespace
