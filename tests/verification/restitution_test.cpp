// SPDX-License-Identifier: GPL-2.0-or-later
// What Newton's law of impact at surface points means for grains that rebound by their elasticity.
#include "support/shapes.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

struct Rebound {
    double restitution, dissipated, residual; ///< of the centre; shares of the energy at the start
};

/// A disc thrown at a wall at this share of the speed of long waves.
Rebound rebound(int points, std::optional<NewtonImpact<2>> impact, double share)
{
    const Material material { "Neo-Hookean", { 1e6, 1e6 } };
    const double radius = 1e-3, density = 1000, c = std::sqrt(3e6 / density), speed = share * c;
    World world;
    const Grain<2>& grain = world.add(
        make_grain(disc_mesh(points), material, { Vec<2>(0, (1 + share) * radius), 0, Vec<2>(0, -speed) }, radius, density));
    world.planes = { { 1, 1, 0, 0 } };
    world.impact = impact;
    const double dt = step_of(grain, 0.25);
    world.step(dt);
    const double before = world.energy();
    while (grain.motion.position.y() < 1.1 * radius || grain.motion.velocity.y() < 0)
        world.step(dt);
    return { grain.motion.velocity.y() / speed, world.lost() / before, (world.energy() + world.lost()) / before - 1 };
}

// Points of little mass are what rebounds, not the grain: it presses on and they strike again, until they stay in touch. The
// grain's restitution is that of its waves for any e (the plain law: no e), and the more so the lighter the points are.
TEST(Restitution, OfPointsIsNotThatOfGrains)
{
    for (double share : { 0.01, 0.1 }) {
        for (int points : { 276, 1200, 4800 }) {
            const Rebound plain = rebound(points, {}, share);
            double apart = 0;
            for (double e : { 0.0, 0.5, 1.0 }) {
                const Rebound r = rebound(points, NewtonImpact<2> { e, e }, share);
                std::printf(
                    "%d points at %.2f c, e = %.1f: the grain's restitution %.4f (%.4f by the plain law), dissipated "
                    "%.1e (%.1e), energy residual %.1e\n",
                    points, share, e, r.restitution, plain.restitution, r.dissipated, plain.dissipated, r.residual);
                EXPECT_GE(r.dissipated, -1e-6); // outlines turn within a step
                EXPECT_LE(std::abs(r.residual), 0.02 * share);
                apart = std::max(apart, std::abs(r.restitution - plain.restitution));
            }
            EXPECT_LE(apart, points < 1000 ? 0.02 : 0.01);
        }
    }
}

/// A block on a wall, on which gravity comes within ten times the period of its waves and stays: where it stands then, and the
/// energy of its motion over the work of gravity along its radius.
struct Rest {
    double height, kinetic;
};

Rest rest(std::optional<NewtonImpact<2>> impact)
{
    const double radius = 1, density = 1000, modulus = 1e6, c = std::sqrt(3 * modulus / density), gravity = 10;
    World world;
    const Grain<2>& grain = world.add(make_grain(mesh_of(PolygonOutline(rectangle_vertices(1, 1)), 256),
                                                 { "Neo-Hookean", { modulus, modulus } },
                                                 { Vec<2>(0, std::sqrt(M_PI) / 2 * radius) }, radius, density));
    world.planes = { { 1, 1, 0, 0 } };
    world.friction = 0.3;
    world.impact = impact;
    const double dt = step_of(grain, 0.5), ramp = 40 * radius / c;
    while (world.time < 3 * ramp) {
        const double t = std::min(1.0, world.time / ramp);
        world.gravity.y() = -gravity * t * t * (3 - 2 * t);
        world.step(dt);
    }
    return { grain.motion.position.y() / radius, grain.motion.kinetic / (grain.mass() * gravity * radius) };
}

// What lasts is no impact: a block that gravity presses on a wall stays where it is, as by the plain law.
TEST(Restitution, DoesNotKickWhatIsAtRest)
{
    const Rest plain = rest({}), elastic = rest(NewtonImpact<2> { 1, 1 });
    std::printf("kinetic energy %.1e m g R with e = 1, %.1e by the plain law; heights differ by %.1e R\n", elastic.kinetic,
                plain.kinetic, elastic.height - plain.height);
    EXPECT_LE(elastic.kinetic, 1e-7);
    EXPECT_LE(std::abs(elastic.height - plain.height), 1e-12);
}

} // namespace
