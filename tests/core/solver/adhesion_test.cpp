// SPDX-License-Identifier: GPL-2.0-or-later
#include "point_masses.hpp"
#include "random_problem.hpp"

#include "solver/adhesion.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const Vec<2> y = Vec<2>::UnitY();

/// The contacts with these impulses of adhesion, along their normals.
ContactProblem<2> pulls_of(const ContactProblem<2>& problem, const std::vector<double>& impulses)
{
    ContactProblem<2> pulls = problem;
    for (size_t i = 0; i < impulses.size(); ++i)
        pulls.contacts[i].impulse = -impulses[i] * pulls.contacts[i].normal;
    return pulls;
}

TEST(Adhesion, KnownImpulsesGiveTheVelocitiesOfTheDenseOperators)
{
    Random random(1);
    for (int trial = 0; trial < 30; ++trial) {
        RandomProblem p(random, random.integer(1, 9), 0.3);
        for (auto& contact : p.problem.contacts)
            contact.impulse = random.vector<2>(1e-6);
        give(p.problem);
        const auto expected = p.velocities();
        for (size_t b = 0; b < expected.size(); ++b)
            for (size_t i = 0; i < expected[b].size(); ++i)
                ASSERT_NEAR(p.problem.bodies[b]->velocity[i], expected[b][i], 1e-13);
    }
}

TEST(Adhesion, KnownImpulsesMoveFreeRigidBodies)
{
    RigidBody<2> body {};
    body.centre = Vec<2>(1, 2);
    body.twist << 0.1, 0.2, 0.3;
    body.mobility = Vec<3>(2, 2, 5).asDiagonal();
    Surface<2> shown;
    shown.rigid = &body;
    ContactProblem<2> known;
    known.bodies = { &shown };
    const int point = shown.add(Vec<2>(4, 2));
    known.contacts.push_back({ 0, -1, point, 0, {}, {}, y, Vec<2>::Zero(), Vec<2>::Zero(), 0, nullptr, Vec<2>(0.5, -1) });
    give(known);
    EXPECT_LE((body.twist - Vec<3>(0.1 + 2 * 0.5, 0.2 - 2, 0.3 - 5 * 3)).norm(), 1e-14);
}

// The cone shifted by -c: r_n = max(-c, -q_n / W), and |r_t| <= mu (r_n + c).
TEST(Adhesion, IsSignorinisAndCoulombsLawWithTheConeShifted)
{
    Random random(2);
    int pulled = 0, slid = 0;
    for (int trial = 0; trial < 300; ++trial) {
        const double mass = random.log_uniform(0.1, 10), c = random.uniform(0, 3), friction = random.uniform(0, 1);
        const Vec<2> q = random.vector<2>(3);
        PointMasses masses({ mass });
        masses.friction = friction;
        masses.v(0) = q;
        masses.begin();
        masses.touch(0, -1, y);
        const auto pulls = pulls_of(masses.problem, { c });
        give(pulls);
        masses.solve();
        const Vec<2> r = masses.problem.contacts[0].impulse + pulls.contacts[0].impulse;
        const double rn = std::max(-c, -q.y() * mass), most = friction * (rn + c);
        EXPECT_NEAR(r.y(), rn, 1e-13);
        EXPECT_NEAR(r.x(), std::clamp(-q.x() * mass, -most, most), 1e-13);
        EXPECT_GE(r.y(), -c - 1e-15) << "tension is bounded";
        EXPECT_LE((masses.v(0) - q - r / mass).norm(), 1e-13);
        pulled += r.y() < 0 && r.y() > -c;
        slid += std::abs(r.x()) == most;
    }
    EXPECT_GT(pulled, 30);
    EXPECT_GT(slid, 30);
}

/// Contact points of the surface points of a body on a face below.
std::vector<ContactPoint<2>> points_on_a_face(const Surface<2>& surface, double height)
{
    std::vector<ContactPoint<2>> points;
    for (int p = 0; p < surface.count; ++p) {
        ContactPoint<2> point {};
        point.point = p;
        point.normal = y;
        point.gap = surface.x(p).y() - height;
        points.push_back(point);
    }
    return points;
}

Surface<2> square()
{
    Surface<2> surface;
    surface.resize(8);
    const double places[] = { 0, 0, 0.7, 0, 2, 0, 2, 0.9, 2, 2, 0.8, 2, 0, 2, 0, 1.1 };
    surface.position.assign(std::begin(places), std::end(places));
    return surface;
}

// A face of length 2 that its points share: what the sides turn away does not count, nor what is out of range.
TEST(Adhesion, PullsByTheTensionTimesTheLengthOfTheFace)
{
    const Surface<2> surface = square();
    const Adhesion<2> adhesion { 3, 0.1 };
    Bonds bonds;
    const auto impulses = adhesion.pulls(points_on_a_face(surface, -0.05), surface, false, 0.5, bonds);
    EXPECT_NEAR(impulses[0], 3 * 0.5 * 0.7 / 2, 1e-14);
    EXPECT_NEAR(impulses[1], 3 * 0.5 * 2.0 / 2, 1e-14);
    EXPECT_NEAR(impulses[2], 3 * 0.5 * 1.3 / 2, 1e-14);
    for (size_t p = 3; p < impulses.size(); ++p)
        EXPECT_EQ(impulses[p], 0);
    for (double impulse : adhesion.pulls(points_on_a_face(surface, -0.1), surface, false, 0.5, bonds))
        EXPECT_EQ(impulse, 0) << "out of range";
    for (double impulse : adhesion.pulls(points_on_a_face(surface, 0), surface, true, 0.5, bonds))
        EXPECT_EQ(impulse, 0) << "the points of the other body carry it";
}

// The length of a disc's boundary that faces a wall is the width of the disc; that nearer than the range is the width of the
// segment there, to the square of the points' distance, wherever the points stand.
TEST(Adhesion, WidthsOfADiscAddUpToThatWithinTheRange)
{
    const Grain<2> grain = make_grain(disc_mesh(1200), neo_hookean());
    const double R = grain.radius, angle = 2 * M_PI / grain.surface.count;
    for (double range : { 0.003 * R, 0.0123 * R, 0.1 * R, 10 * R }) {
        double sum = 0;
        for (const auto& point : points_on_a_face(grain.surface, -R))
            if (point.gap < range) sum += width_within<2>(range, point, grain.surface);
        const double depth = std::min(range, R), expected = 2 * std::sqrt(depth * (2 * R - depth));
        EXPECT_NEAR(sum / expected, 1, 0.2 * angle * angle * R / depth) << range / R;
    }
}

TEST(Adhesion, PartsForGoodWhereItIsIrreversible)
{
    const Surface<2> surface = square();
    for (bool reversible : { true, false }) {
        const Adhesion<2> adhesion { 3, 0.1, reversible };
        Bonds bonds;
        const auto held = [&](double height) {
            int count = 0;
            for (double impulse : adhesion.pulls(points_on_a_face(surface, height), surface, false, 1, bonds))
                count += impulse > 0;
            return count;
        };
        EXPECT_EQ(held(-0.2), 0);
        EXPECT_EQ(held(-0.09), 3);
        EXPECT_EQ(held(0), 3);
        EXPECT_EQ(held(-0.11), 0);
        EXPECT_EQ(held(-0.09), reversible ? 3 : 0);
        EXPECT_EQ(bonds.parted, reversible ? std::vector<int>() : (std::vector<int> { 0, 1, 2 }));
        EXPECT_TRUE(bonds.held.empty() || reversible);
    }
}

} // namespace
