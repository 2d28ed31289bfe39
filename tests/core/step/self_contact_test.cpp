// SPDX-License-Identifier: GPL-2.0-or-later
// Grains with a concave outline that come to meet themselves.
#include "contact/polyline.hpp"
#include "support/implicit_world.hpp"
#include "support/shapes.hpp"
#include "support/world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// An upright U: thickness of its arms and its base, width and depth of the way between the arms.
Mesh u_mesh(double arm, double base, double way_between, double depth, int points)
{
    const double half = way_between / 2 + arm;
    return mesh_of(PolygonOutline({ { -half, -base },
                                    { half, -base },
                                    { half, depth },
                                    { way_between / 2, depth },
                                    { way_between / 2, 0 },
                                    { -way_between / 2, 0 },
                                    { -way_between / 2, depth },
                                    { -half, depth } }),
                   points);
}

/// Deepest point of the outline in itself, by winding numbers about points a little outside of it; [radius].
double self_overlap(const Surface<2>& surface)
{
    double deepest = 0;
    const int n = surface.count;
    for (int p = 0; p < n; ++p) {
        const Vec<2> along = surface.x((p + 1) % n) - surface.x((p + n - 1) % n);
        const Vec<2> out = Vec<2>(along.y(), -along.x()).normalized();
        for (double depth = 0.01; depth < 0.5; depth += 0.01) {
            const Vec<2> x = surface.x(p) + depth * surface.size * out;
            double angle = 0;
            for (int i = 0; i < n; ++i) {
                const Vec<2> a = surface.x(i) - x, b = surface.x((i + 1) % n) - x;
                angle += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
            }
            if (angle < 3 * M_PI) break; // inside once at most
            deepest = std::max(deepest, depth);
        }
    }
    return deepest;
}

TEST(SelfContact, ConcaveOutlinesAreKnown)
{
    for (const auto& [name, outline] : shapes()) {
        const bool concave = name == "flower" || name == "L" || name == "U";
        EXPECT_EQ(mesh_of(*outline, 124)->is_concave(), concave) << name;
    }
}

struct Found {
    double force = 0, overlap = 0, depth = 0, residual = 0; ///< largest of the run [N/m], [R], [R], [-]
};

// At this speed the arms bend through the way between them; friction acts along the face, between places a gap apart.
TEST(SelfContact, ArmsThatAreThrownAtEachOtherReboundAndKeepMomenta)
{
    for (double friction : { 0.0, 0.5 }) {
        World world;
        world.threads = 1;
        world.friction = friction;
        GrainStart start;
        start.velocity_gradient << -10e3, 0, 2e3, 0;
        Grain<2>& grain = world.add(make_grain(u_mesh(0.5, 0.5, 1, 2, 240), soft_neo_hookean(), start));
        const Motion<2> before = grain.motion;
        const double energy = world.energy(), dt = step_of(grain, 0.4);
        double force = 0, overlap = 0, residual = 0;
        for (int k = 0; k < 1200; ++k) {
            world.step(dt);
            residual = std::max(residual, world.problem.residual());
            double sum = 0;
            for (const auto& contact : world.problem.contacts)
                sum += contact.impulse.norm() / dt;
            force = std::max(force, sum);
            if (k % 20 == 0) overlap = std::max(overlap, self_overlap(grain.surface));
        }
        const double drift = (world.energy() + world.lost()) / energy - 1, spin = before.angular_momentum[0],
                     turned = grain.motion.angular_momentum[0] / spin - 1;
        std::printf(
            "friction %.1f: largest force %.0f N/m, penetration %.1e R, overlap %.2f R, residual %.1e, energy %+.1e, "
            "angular momentum %+.1e\n",
            friction, force, -world.deepest / grain.radius, overlap, residual, drift, turned);
        EXPECT_GT(force, 100);
        EXPECT_LT(overlap, 0.02);
        EXPECT_LT(residual, 1e-5);
        EXPECT_LT(std::abs(drift), 0.01);
        EXPECT_LT((grain.motion.velocity - before.velocity).norm(), 1e-12);
        EXPECT_LT(std::abs(turned), friction > 0 ? 1e-2 : 1e-5);
    }
}

constexpr double speed = 1; // of planes [m/s]

template <class AWorld> void put_between_planes(AWorld& world)
{
    world.add(make_grain(u_mesh(0.75, 1, 0.5, 1, 400), soft_neo_hookean()));
    const auto& surface = world.grains[0].surface;
    world.planes = { { 0, 1, surface.min.x(), speed },
                     { 0, -1, surface.max.x(), -speed },
                     { 1, 1, surface.min.y(), 0 },
                     { 1, -1, surface.max.y() + 0.05 * surface.size, 0 } };
}

/// Mean force of the planes when the arms have been pressed onto each other and further [N/m].
template <class AWorld> double press(AWorld& world, double dt)
{
    put_between_planes(world);
    const Grain<2>& grain = world.grains[0];
    const double end = 0.4 * grain.radius / speed;
    double sum = 0, overlap = 0;
    int count = 0;
    while (world.time < end - dt / 2) {
        world.step(dt);
        overlap = std::max(overlap, self_overlap(grain.surface));
        if (world.time < 0.38 * grain.radius / speed) continue;
        sum += (world.plane_force[0] - world.plane_force[1]).norm() / 2;
        ++count;
    }
    std::printf("force %.1f N/m, overlap %.2f R\n", sum / count, overlap);
    EXPECT_LT(overlap, 0.02);
    return sum / count;
}

TEST(SelfContact, ArmsPressedOnEachOtherCarryTheSamePressureWithEveryScheme)
{
    ImplicitWorld slow, implicit;
    World explicit_;
    explicit_.threads = 1;
    slow.settings.quasistatic = true;
    const double force = press(slow, 1e-5);
    EXPECT_NEAR(press(implicit, 1e-5) / force, 1, 0.02);
    EXPECT_NEAR(press(explicit_, 2e-7) / force, 1, 0.02);
    std::printf("%d and %d iterations\n", slow.iterations, implicit.iterations);
}

} // namespace
