// SPDX-License-Identifier: GPL-2.0-or-later
// Adhesion: a block that is pulled off a wall, grains that stick, and the line contact of Dugdale's law.
#include "support/shapes.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double density = 1000; // [kg/m3]
const Material material { "Neo-Hookean", { 1e6, 1e6 } };

double smooth(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * t * (10 + t * (6 * t - 15)); }

/// A block on a wall below it, side 1 m.
struct Block : World {
    static constexpr double side = 1;
    Grain<2>& grain;
    double step_length;

    Block(const Adhesion<2>& law, double height = 0, double speed = 0)
        : grain(add(make_grain(mesh_of(PolygonOutline(rectangle_vertices(1, 1)), 256), material,
                               { Vec<2>(0, side / 2 + height), 0, Vec<2>(0, speed) }, side / std::sqrt(M_PI), density)))
        , step_length(step_of(grain, 0.5))
    {
        adhesion = law;
        planes = { { 1, 1, 0, 0 } };
    }
    double weight() const { return grain.mass() * gravity.y(); }
    /// Stored, and worked against adhesion and contacts [J/m].
    double total() { return energy() + pulled.contact_dissipation + lost() - balance.external_work; }
};

// Body forces that come slowly, w(t) = rate t, pull the block off when they reach tension x side; until then the wall bears them,
// and never more than that. The gap then opens by rate t^3 / 6 m. Under a tension of 1e-3 moduli the side shrinks by 4e-4.
TEST(Adhesion, ABlockComesOffAtTheTensionTimesItsSide)
{
    const Adhesion<2> law { 1e3, 1e-3 };
    Block block(law);
    const double whole = law.tension * Block::side, mass = block.grain.mass(),
                 rate = 0.12 * whole; // in 25 s, vibrations of 0.03 s
    double most = 0;
    do {
        block.gravity.y() = rate / mass * block.time;
        block.step(block.step_length);
        double bound = 0;
        for (const auto& contact : block.pulls.contacts)
            bound -= contact.impulse.y() / block.dt;
        ASSERT_LE(block.plane_force[0].y(), bound * (1 + 1e-14));
        most = std::max(most, block.plane_force[0].y());
    } while (!block.pulls.contacts.empty() && block.time < 30);
    const double expected = whole + rate * std::cbrt(6 * law.range * mass / rate);
    std::printf("largest pull on the wall %.6f of tension x side, weight as it comes off %.4f, %.4f expected\n",
                most / whole, block.weight() / whole, expected / whole);
    EXPECT_NEAR(most / whole, 1, 1e-3);
    EXPECT_NEAR(block.weight() / expected, 1, 2e-3);
}

// Thrown upwards from the wall, the block loses tension x range x side, to what the gap opens by in a step at the end.
TEST(Adhesion, SeparationTakesTheWorkOfAdhesion)
{
    for (double share : { 1.0, 0.5 }) {
        const Adhesion<2> law { 1e3, 1e-3 };
        Block block(law, 0, 0.1);
        block.step_length *= share;
        block.step(block.step_length);
        const double before = block.total();
        while (!block.pulls.contacts.empty())
            block.step(block.step_length);
        const double work = block.pulled.contact_dissipation, expected = law.tension * law.range * Block::side;
        const double way = 0.1 * block.step_length / law.range;
        std::printf("work of separation %.4f of tension x range x side, a step opens %.4f of the range; energy %.1e of it\n",
                    work / expected, way, (block.total() - before) / expected);
        EXPECT_NEAR(work / expected, 1, 2 * way);
        EXPECT_NEAR((block.total() - before) / expected, 0, 1e-3);
    }
}

// It comes down, is drawn to the wall, rebounds: reversible adhesion gives back on one way what it takes on the other, to a
// step's way, and irreversible adhesion lets go of it for good.
TEST(Adhesion, GivesBackWhatItTakesWhereItIsReversible)
{
    for (bool reversible : { true, false }) {
        const Adhesion<2> law { 2e2, 1e-3, reversible };
        Block block(law, 2e-3, -0.2);
        block.step(block.step_length);
        const double before = block.total(), whole = law.tension * law.range * Block::side;
        double least = 0;
        while (block.grain.surface.min.y() < 2e-3 || block.grain.motion.velocity.y() < 0) {
            block.step(block.step_length);
            least = std::min(least, block.pulled.contact_dissipation);
        }
        EXPECT_NEAR(least / whole, -1, 0.1) << "on the way in";
        EXPECT_NEAR(block.pulled.contact_dissipation / whole, 0, 0.1) << "and out";
        EXPECT_NEAR((block.total() - before) / before, 0, 2e-3);
        block.gravity.y() = -100; // and down again, until it rebounds
        const double gone = block.pulled.contact_dissipation;
        do
            block.step(block.step_length);
        while (block.grain.surface.min.y() > 1e-5 || block.grain.motion.velocity.y() < 0);
        EXPECT_NEAR((block.pulled.contact_dissipation - gone) / whole, reversible ? -1 : 0, 0.1);
    }
}

// Two grains that meet slowly stay together. Momentum is theirs all the while, and angular momentum; friction acts on the two in
// places a gap apart, which makes a couple (doc/theory.md, section 4).
TEST(Adhesion, GrainsStickAndKeepTheirMomenta)
{
    struct Case {
        double friction;
        bool updated; ///< the smaller grain, in the updated-Lagrangian form
    };
    for (const auto& [friction, updated] : { Case { 0, false }, Case { 0.3, false }, Case { 0, true } }) {
        World world;
        const double radius = 1e-3, speed = 0.02;
        world.add(make_grain(disc_mesh(276), material, { Vec<2>(-1.001e-3, 0.2e-3), 0, Vec<2>(speed, 0) }, radius, density));
        world.add(make_grain(disc_mesh(124, 0.3), material,
                             { Vec<2>(0.75e-3, 0), 0, Vec<2>(-speed, 0), Mat<2>::Zero(), updated }, 0.7 * radius, density));
        world.friction = friction;
        world.adhesion = Adhesion<2> { 1e5, 1e-5 };
        const double dt = step_of(world.grains[1], 0.5);
        world.step(dt);
        const Sums before(world);
        const double energy = world.energy();
        for (int k = 0; k < 20000; ++k)
            world.step(dt);
        const Sums after(world);
        const double work = world.pulled.contact_dissipation;
        const double momentum = (after.momentum - before.momentum).norm() / before.size,
                     angular = (after.angular - before.angular) / (before.size * radius),
                     residual = (world.energy() + world.lost() + work - energy) / -work;
        std::printf("friction %.1f%s: momentum %.1e, angular momentum %.1e; energy residual %.1e of the work of adhesion\n",
                    friction, updated ? ", updated form" : "", momentum, angular, residual);
        EXPECT_LE(momentum, 1e-12);
        EXPECT_LE(std::abs(angular), friction > 0 ? 1e-4 : 1e-11);
        EXPECT_LE(std::abs(residual), 0.01);
        EXPECT_FALSE(world.pulls.contacts.empty()) << "they have parted";
        EXPECT_LT(work, 0);
    }
}

/// A rigid plane on an elastic cylinder that Dugdale's tension holds up to a gap `range`, contact of half-width a, tension up to
/// c (Baney and Hui 1997; Johnson and Greenwood 2008):
///     P = pi E* a^2 / (4 R) - 2 tension sqrt(c^2 - a^2),
///     range = int_a^c [X / R + 2 tension / (pi E*) ln((C + X) / (C - X))] dx,    X^2 = x^2 - a^2, C^2 = c^2 - a^2.
/// Long-range tension leaves 2 tension sqrt(2 R range); short-range gives JKR, P = -3/4 (4 pi E* w^2 R)^(1/3), w = tension x
/// range (Barquins 1988; Chaudhury et al. 1996).
struct DugdaleCylinder {
    double radius, modulus, tension, range; ///< [m], E* [Pa], [Pa], [m]

    double gap_at_end(double a, double C) const
    {
        // with X = C sin: the logarithm is mild, dx = X dX / x
        constexpr int parts = 2000;
        double sum = 0;
        for (int k = 0; k < parts; ++k) {
            const double angle = M_PI / 2 * (k + 0.5) / parts, X = C * std::sin(angle);
            const double slope = X / radius + 2 * tension / (M_PI * modulus) * std::log((C + X) / (C - X));
            sum += slope * X / std::sqrt(X * X + a * a) * C * std::cos(angle);
        }
        return sum * M_PI / 2 / parts;
    }
    double load(double a) const
    {
        double lo = 0, hi = std::sqrt(2 * radius * range) + a;
        for (int k = 0; k < 50; ++k)
            (gap_at_end(a, (lo + hi) / 2) < range ? lo : hi) = (lo + hi) / 2;
        return M_PI * modulus * a * a / (4 * radius) - 2 * tension * lo;
    }
    double pull_off() const
    {
        double least = 0;
        for (double a = 0; a < 0.5 * radius; a += 5e-3 * radius)
            least = std::min(least, load(a));
        return -least;
    }
    double jkr() const { return 0.75 * std::cbrt(4 * M_PI * modulus * std::pow(tension * range, 2) * radius); }
    double rigid() const { return 2 * tension * std::sqrt(2 * radius * range); }
};

/// Weight at which a disc comes off a wall [N/m]: the last at which it touches the wall. Tension comes first, then the weight,
/// both slowly.
double pull_off_of_a_disc(int points, const DugdaleCylinder& c)
{
    World world;
    Grain<2>& grain = world.add(make_grain(disc_mesh(points), material, { Vec<2>(0, c.radius) }, c.radius, density));
    world.planes = { { 1, 1, 0, 0 } };
    world.adhesion = Adhesion<2> { 0, c.range };
    const double unit = c.radius / std::sqrt(1e6 / density), dt = step_of(grain, 0.6), begin = 60 * unit;
    const double rate = c.pull_off() / (1000 * unit) / grain.mass();
    double last = 0;
    do {
        world.adhesion->tension = c.tension * smooth(world.time / begin);
        world.gravity.y() = rate * std::max(0.0, world.time - begin);
        world.step(dt);
        for (const auto& contact : world.problem.contacts)
            if (contact.impulse.y() > 0) last = grain.mass() * world.gravity.y();
    } while (world.time < begin || (!world.pulls.contacts.empty() && world.time < 2000 * unit));
    return last;
}

// Between the limits, from tension that reaches beyond the contact to one that ends within it. The theory is one of half-planes
// and small strains.
TEST(Adhesion, ADiscComesOffAWallAsDugdalesCylinder)
{
    const double modulus = 8e6 / 3; // 4 mu (lambda + mu) / (lambda + 2 mu)
    struct Case {
        double tension, range, tolerance; ///< [E*], [R]
    };
    for (const auto& [tension, range, tolerance] :
         { Case { 0.02, 0.01, 0.04 }, Case { 0.1, 0.02, 0.04 }, Case { 0.2, 0.02, 0.06 } }) {
        const DugdaleCylinder cylinder { 1, modulus, tension * modulus, range };
        const double expected = cylinder.pull_off();
        for (int points : { 600, 2400 }) {
            const double found = pull_off_of_a_disc(points, cylinder);
            std::printf(
                "tension %.2f E*, range %.2f R, %d points: pull-off %.4f E* R, %.4f expected (%+.1f %%); JKR %.4f, rigid "
                "%.4f\n",
                tension, range, points, found / modulus, expected / modulus, 100 * (found / expected - 1),
                cylinder.jkr() / modulus, cylinder.rigid() / modulus);
            if (points == 2400) {
                EXPECT_NEAR(found / expected, 1, tolerance);
            }
        }
    }
}

} // namespace
