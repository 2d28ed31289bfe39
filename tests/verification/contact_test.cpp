// SPDX-License-Identifier: GPL-2.0-or-later
// Contact of soft grains against closed forms: Hertz's line contact, rebound from a wall, grains at rest under gravity.
#include "reference.hpp"
#include "support/shapes.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// A disc pressed on a rigid plane in plane strain by P per metre of thickness (Johnson 1985, eqs. 4.43 and 5.57), with the
/// approach of the middle of the disc, loaded by P on the other side too:
///     a^2 = 4 P R / (pi E*),   approach = P / (pi E*) [2 ln(4 R / a) - 1],   E* = E / (1 - nu^2).
struct LineContact {
    double radius, modulus; ///< [m], E* [Pa]

    double half_width(double force) const { return std::sqrt(4 * force * radius / (M_PI * modulus)); }
    double approach(double force) const
    {
        return force / (M_PI * modulus) * (2 * std::log(4 * radius / half_width(force)) - 1);
    }
    double force(double approach_) const
    {
        if (approach_ <= 0) return 0;
        double lo = 0, hi = modulus * approach_;
        for (int k = 0; k < 60; ++k)
            (approach((lo + hi) / 2) < approach_ ? lo : hi) = (lo + hi) / 2;
        return lo;
    }
};

/// E / (1 - nu^2) = 4 mu (lambda + mu) / (lambda + 2 mu).
double plane_strain_modulus(const Material& material)
{
    const double lambda = material.parameters[0], mu = material.parameters[1];
    return 4 * mu * (lambda + mu) / (lambda + 2 * mu);
}

constexpr double radius = 1e-3, density = 1000; // [m], [kg/m3]

/// A slow squeeze to 3 %, from where the contact is two cells wide by Hertz.
struct Indentation {
    double force = 0, half_width = 0;      ///< rms deviations from Hertz, relative
    double worst = 0, finite_elements = 0; ///< largest deviation of the force; rms of that from finite elements
    int windows = 0;
};

Indentation indent(const Material& material, int points, const Table* table)
{
    const LineContact hertz { radius, plane_strain_modulus(material) };
    const double speed = 3e-4 * std::sqrt(material.parameters[1] / density); // of each plate; the disc vibrates 100 times
    World world;
    const Grain<2>& grain = world.add(make_grain(disc_mesh(points), material, {}, radius, density));
    world.planes = { { 1, 1, -radius, speed }, { 1, -1, radius, -speed } };
    const double dt = step_of(grain, 0.6), window = 1e-3;
    const auto squeeze = [&] { return 1 - world.planes[1].position / radius; };
    Indentation result;
    for (double end = window; end < 0.03 + window / 2; end += window) {
        double force = 0, place = 0, second = 0;
        int count = 0;
        for (double before = squeeze(); before < end; before = squeeze(), ++count) {
            world.step(dt);
            for (const auto& contact : world.problem.contacts) {
                force += std::abs(contact.impulse.y()) / dt / 2;
                second += std::abs(contact.impulse.y()) / dt / 2 * std::pow(grain.surface.x(contact.point).x(), 2);
            }
            place += (before + squeeze()) / 2;
        }
        const double mean = force / count, s = place / count, expected = hertz.force(s * radius);
        if (hertz.half_width(expected) < grain.mesh->cell_width * radius) continue;
        // the pressure of Hertz is half an ellipse, of second moment a^2 / 4
        const double width = 2 * std::sqrt(second / force);
        result.force += std::pow(mean / expected - 1, 2);
        result.half_width += std::pow(width / hertz.half_width(mean) - 1, 2);
        result.worst = std::max(result.worst, std::abs(mean / expected - 1));
        if (table) result.finite_elements += std::pow(mean / table->at("squeeze", s, "F_N_per_m") - 1, 2);
        ++result.windows;
    }
    for (double* sum : { &result.force, &result.half_width, &result.finite_elements })
        *sum = std::sqrt(*sum / result.windows);
    return result;
}

// Hertz's theory is one of small strains and of a half-plane under the contact: finite elements of the nearly incompressible
// disc deviate from it by up to 0.7 % at a squeeze of 3 %.
TEST(Hertz, ADiscBetweenPlatesHasTheForceAndWidthOfALineContact)
{
    const Table table("A_plates_NH.csv");
    for (const auto& [name, material] :
         { std::pair("nu = 0.25", soft_neo_hookean()), std::pair("nu = 0.49", neo_hookean()) })
        for (int points : { 1200, 2400, 4800 }) {
            const bool tabulated = material.parameters == neo_hookean().parameters;
            const Indentation found = indent(material, points, tabulated ? &table : nullptr);
            std::printf(
                "%s, %d points, %d windows of 0.1 %% squeeze: force rms %.2f %%, worst %.2f %%; half-width rms %.1f %%",
                name, points, found.windows, 100 * found.force, 100 * found.worst, 100 * found.half_width);
            if (tabulated) std::printf("; force against finite elements rms %.2f %%", 100 * found.finite_elements);
            std::printf("\n");
            EXPECT_GE(found.windows, 10);
            EXPECT_LE(found.force, 0.01) << name;
            EXPECT_LE(found.worst, 0.015) << name;
            EXPECT_LE(found.half_width, points < 2400 ? 0.1 : 0.04) << name; // of two to four points at 1200
            EXPECT_LE(found.finite_elements, 0.006) << name;
        }
}

struct Bounce {
    double restitution, dissipated, vibration; ///< of the centre; shares of the energy at the start
    double momentum = 0, residual = 0;         ///< relative
    double duration, deepest;                  ///< [R / c], approach of the centre [R]
};

/// Discs fly at `speed` [c, that of long waves] each, one against a wall or two against each other.
Bounce bounce(int discs, int points, double ratio)
{
    const Material material = soft_neo_hookean();
    const double c = std::sqrt(plane_strain_modulus(material) / density), speed = ratio * c;
    World world;
    for (int side : { 1, -1 }) {
        if (side < 0 && discs == 1) break;
        GrainStart start;
        start.centre = Vec<2>(0, (1 + ratio) * side * radius);
        start.velocity = Vec<2>(0, -side * speed);
        world.add(make_grain(disc_mesh(points), material, start, radius, density));
    }
    if (discs == 1) world.planes = { { 1, 1, 0, 0 } };
    const Grain<2>& grain = world.grains[0];
    const double dt = step_of(grain, 0.5), before = grain.motion.velocity.y();
    world.step(dt);
    const double first = world.energy();
    double impulse = 0, begin = 0, end = 0;
    Bounce result {};
    while (world.time < 15 * radius / c) {
        world.step(dt);
        double now = 0;
        for (const auto& contact : world.problem.contacts)
            now += std::abs(contact.impulse.y());
        impulse += now;
        if (now > 0 && begin == 0) begin = world.time - dt;
        if (now > 0) end = world.time;
        result.deepest = std::max(result.deepest, 1 - grain.motion.position.y() / radius);
        result.residual
            = std::max(result.residual, std::abs((world.energy() + world.balance.contact_dissipation) / first - 1));
    }
    EXPECT_EQ(world.problem.contacts.size(), 0u) << "apart again";
    result.restitution = grain.motion.velocity.y() / speed;
    result.momentum = impulse / (grain.mass() * (grain.motion.velocity.y() - before)) - 1;
    result.dissipated = world.balance.contact_dissipation / first;
    result.vibration = 1 - result.dissipated - std::pow(result.restitution, 2);
    result.duration = (end - begin) * c / radius;
    return result;
}

// Without friction the wall's impulse is the change of momentum, and the energy of the centre, of the vibration and of the
// surface points that were stopped is that of the start. By symmetry two discs meet as each meets a wall. Slow elastic discs
// keep little vibration (Gerl and Zippelius 1999).
TEST(Rebound, OfADiscFromAWallIsThatOfTwoDiscs)
{
    std::vector<double> finest;
    for (double speed : { 0.01, 0.03, 0.1 }) {
        double dissipated = 1;
        for (int points : { 276, 1200, 4800 }) {
            const Bounce wall = bounce(1, points, speed), pair = bounce(2, points, speed);
            for (const auto& [name, b] : { std::pair("wall", wall), std::pair("disc", pair) }) {
                std::printf("%s at %.2f c, %d points: restitution %.4f, vibration %.4f, dissipated %.4f, momentum %.1e, "
                            "energy %.1e, "
                            "%.3f R / c in touch, approach %.4f R\n",
                            name, speed, points, b.restitution, b.vibration, b.dissipated, b.momentum, b.residual,
                            b.duration, b.deepest);
                EXPECT_LE(std::abs(b.momentum), 1e-13);
                EXPECT_LE(b.residual, 0.01 * speed); // finite strain, see doc/theory.md, section 7
                EXPECT_GT(b.vibration, 0);
            }
            EXPECT_LT(wall.dissipated, 0.6 * dissipated) << "of order 3/4 at least in the cell width";
            dissipated = wall.dissipated;
            if (points == 276) continue;
            EXPECT_NEAR(pair.restitution, wall.restitution, points == 1200 ? 2e-3 : 1e-3);
            EXPECT_NEAR(pair.deepest / wall.deepest, 1, 2e-3);
            if (points == 4800) finest.push_back(wall.restitution);
        }
    }
    EXPECT_GE(finest[0], 0.97);
    EXPECT_GE(finest[1], 0.97);
    EXPECT_GE(finest[2], 0.93);
    EXPECT_LT(finest[2], finest[1]);
}

constexpr double gravity = 9.81; // [m/s2]

struct Rest {
    std::vector<double> plane, pair; ///< means: normal forces of planes, of pairs i < j [N/m]
    double kinetic[2] = { 0, 0 };    ///< means of the halves of the window [J/m]
    double fall = 0;                 ///< largest fall of a centre in the window [R]
    double tangent = 0;              ///< mean of the slopes, over the vertical, from the first two centres to the last one
    double deepest = 0;              ///< [R]
};

/// Gravity comes in 15 units of time and stays to 100; the time from 20 on counts.
Rest settle(World& world, double unit)
{
    double dt = 1e300;
    for (const auto& grain : world.grains)
        dt = std::min(dt, step_of(grain, 0.5));
    const size_t count = world.grains.size();
    Rest result;
    result.plane.assign(world.planes.size(), 0);
    result.pair.assign(count * count, 0);
    std::vector<double> height(count);
    constexpr double ramp = 15, begin = 20, end = 100;
    int steps = 0, halves[2] = { 0, 0 };
    while (world.time < end * unit) {
        const double t = std::min(1.0, world.time / unit / ramp);
        world.gravity = Vec<2>(0, -gravity * t * t * t * (10 + t * (6 * t - 15)));
        world.step(dt);
        if (world.time < begin * unit) {
            for (size_t g = 0; g < count; ++g)
                height[g] = world.grains[g].motion.position.y();
            continue;
        }
        for (size_t w = 0; w < world.planes.size(); ++w)
            result.plane[w] += std::abs(world.plane_force[w][world.planes[w].axis]);
        for (const auto& contact : world.problem.contacts)
            if (contact.other >= 0)
                result.pair[size_t(std::min(contact.body, contact.other)) * count
                            + size_t(std::max(contact.body, contact.other))]
                    += std::abs(contact.impulse.y()) / dt;
        const int half = world.time > (begin + end) / 2 * unit;
        ++halves[half];
        for (size_t g = 0; g < count; ++g) {
            result.kinetic[half] += world.grains[g].motion.kinetic;
            result.fall = std::max(result.fall, (height[g] - world.grains[g].motion.position.y()) / radius);
        }
        for (int side : { 0, 1 }) {
            const Vec<2> line = world.grains.back().motion.position - world.grains[side].motion.position;
            result.tangent += std::abs(line.x()) / line.y() / 2;
        }
        result.deepest = std::max(result.deepest, -world.deepest / radius);
        ++steps;
    }
    for (int half : { 0, 1 })
        result.kinetic[half] /= halves[half];
    result.tangent /= steps;
    for (auto* forces : { &result.plane, &result.pair })
        for (double& force : *forces)
            force /= steps;
    return result;
}

void print(const char* name, const Rest& rest, double weight)
{
    std::printf("%s: kinetic energy %.2e, then %.2e of weight x R; centres fall by %.1e R; deepest %.1e R\n", name,
                rest.kinetic[0] / weight / radius, rest.kinetic[1] / weight / radius, rest.fall, rest.deepest);
}

// Four blocks, each smaller than the one below: each contact carries the weight above it. The elastic vibration that the load
// leaves goes on without growing when the solver is exact; its tolerance feeds energy in.
TEST(Stack, OfBlocksCarriesTheWeightAboveEachContact)
{
    const double modulus = 300 * density * gravity * radius;
    const auto mesh = mesh_of(PolygonOutline(rectangle_vertices(1, 1)), 64);
    for (double tolerance : { 1e-3, 1e-6, 1e-10 }) {
        World world;
        world.friction = 0.5;
        world.solver.tolerance = tolerance;
        double top = 0, weight = 0;
        for (int k = 0; k < 4; ++k) {
            GrainStart start;
            const double size = (1 - 0.15 * k) * radius, half = std::sqrt(M_PI) / 2 * size;
            start.centre = Vec<2>(0, top + half);
            top += 2 * half;
            weight += world.add(make_grain(mesh, { "Neo-Hookean", { modulus, modulus } }, start, size, density)).mass()
                * gravity;
        }
        world.planes = { { 1, 1, 0, 0 } };
        const Rest rest = settle(world, std::sqrt(radius / gravity));
        std::vector<double> error { rest.plane[0] / weight - 1 };
        double above = weight;
        for (int k = 0; k < 3; ++k) {
            above -= world.grains[k].mass() * gravity;
            error.push_back(rest.pair[4 * k + k + 1] / above - 1);
        }
        std::printf("solver to %.0e: forces over the weight above less 1: floor %.1e, blocks %.1e, %.1e, %.1e\n", tolerance,
                    error[0], error[1], error[2], error[3]);
        print("four blocks", rest, weight);
        for (double e : error)
            EXPECT_LE(std::abs(e), tolerance > 1e-6 ? 1e-5 : 1e-7); // momentum that oscillates, over the window
        EXPECT_LE(rest.fall, 1e-5);
        EXPECT_LE(rest.deepest, 5e-3 * tolerance);
        if (tolerance < 1e-6)
            EXPECT_LE(rest.kinetic[1], 1.01 * rest.kinetic[0]);
        else
            EXPECT_LE(rest.kinetic[1] / weight / radius, 1e-3 * tolerance);
    }
}

// A disc of weight W on two that stand 2.2 R apart between walls, no friction: with phi the angle of the lines of centres to the
// vertical, each of the two carries W / 2, each wall W tan(phi) / 2 and the floor 3 W. The discs are compressed by some 2 % of R,
// so that phi is that of the centres as they stand; it oscillates, as nothing damps it.
TEST(Stack, OfThreeDiscsHasTheForcesOfStatics)
{
    const double modulus = 100 * density * gravity * radius;
    World world;
    world.solver.tolerance = 1e-10;
    const auto mesh = disc_mesh(1200);
    for (const Vec<2>& centre : { Vec<2>(-1.1, 1), Vec<2>(1.1, 1), Vec<2>(0, 1 + 2 * std::sqrt(1 - 0.55 * 0.55)) }) {
        GrainStart start;
        start.centre = radius * centre;
        world.add(make_grain(mesh, { "Neo-Hookean", { modulus, modulus } }, start, radius, density));
    }
    world.planes = { { 1, 1, 0, 0 }, { 0, 1, -2.1 * radius, 0 }, { 0, -1, 2.1 * radius, 0 } };
    const double weight = world.grains[0].mass() * gravity;
    const Rest rest = settle(world, std::sqrt(radius / gravity));
    const double floor = rest.plane[0] / (3 * weight) - 1,
                 wall = (rest.plane[1] + rest.plane[2]) / (weight * rest.tangent) - 1;
    const double left = rest.pair[2] / (weight / 2) - 1, right = rest.pair[5] / (weight / 2) - 1;
    std::printf("three discs, tan(phi) %.4f (%.4f rigid): forces over those of statics less 1: floor %.1e, walls %.1e, "
                "discs %.1e and %.1e\n",
                rest.tangent, 0.55 / std::sqrt(1 - 0.55 * 0.55), floor, wall, left, right);
    EXPECT_LE(std::abs(floor), 1e-3);
    EXPECT_LE(std::abs(wall), 0.01);
    EXPECT_LE(std::abs(left), 0.01);
    EXPECT_LE(std::abs(right), 0.01);
    EXPECT_LE(rest.fall, 0.01); // oscillation about the mean
    print("three discs", rest, 3 * weight);
    EXPECT_LE(rest.kinetic[1], 1.25 * rest.kinetic[0]); // slow modes beat
    EXPECT_LE(rest.deepest, 1e-6);
}

} // namespace
