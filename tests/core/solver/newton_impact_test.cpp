// SPDX-License-Identifier: GPL-2.0-or-later
#include "point_masses.hpp"
#include "random_problem.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const Vec<2> x = Vec<2>::UnitX(), y = Vec<2>::UnitY();

// u_n' = -e u_n, the velocity of the centre of mass stays: v1' = [m1 v1 + m2 v2 - e m2 (v1 - v2)] / (m1 + m2).
TEST(NewtonImpact, TwoMassesRebound)
{
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        const double m1 = random.log_uniform(1e-3, 1e3), m2 = random.log_uniform(1e-3, 1e3), e = random.uniform(0, 1);
        const double v1 = random.uniform(0, 1), v2 = random.uniform(-1, 0);
        PointMasses masses({ m1, m2 });
        masses.impact.normal = e;
        masses.v(0) = Vec<2>(v1, 0.3);
        masses.v(1) = Vec<2>(v2, -0.2);
        masses.begin();
        masses.touch(0, 1, -x, 0.9 * (v1 - v2));
        masses.solve();
        const double centre = (m1 * v1 + m2 * v2) / (m1 + m2), share = e * (v1 - v2) / (m1 + m2);
        EXPECT_NEAR(masses.v(0).x(), centre - share * m2, 1e-14);
        EXPECT_NEAR(masses.v(1).x(), centre + share * m1, 1e-14);
        EXPECT_EQ(masses.v(0).y(), 0.3) << "no friction";
        const double reduced = m1 * m2 / (m1 + m2);
        EXPECT_NEAR(dissipated(masses.problem), reduced * (1 - e * e) * std::pow(v1 - v2, 2) / 2, 1e-14 * reduced);
    }
}

// A gap that does not close within the step, a point that bore a force before, and one that comes from rest are no impacts.
TEST(NewtonImpact, LeavesWhatIsNoImpactAlone)
{
    struct Case {
        double before, free, gap_speed;
        bool pressed;
        double after;
    };
    for (const auto& [before, free, gap_speed, pressed, after] :
         { Case { -1, -1, 0.9, false, 0.5 }, Case { -1, -1, 1.1, false, -1 }, Case { -1, -1, 0.9, true, -0.9 },
           Case { 0, -2, 0, false, 0 }, Case { 1, -2, 0.5, false, -0.5 }, Case { -1, -3, -0.7, false, 0.7 } }) {
        PointMasses masses({ 2 });
        masses.impact.normal = 0.5;
        masses.v(0) = Vec<2>(0, before);
        masses.begin();
        masses.v(0) = Vec<2>(0, free); // by the forces of the step
        masses.touch(0, -1, y, gap_speed, pressed);
        masses.solve();
        EXPECT_NEAR(masses.v(0).y(), after, 1e-15) << before << " " << free << " " << gap_speed;
    }
}

// |r_t| <= mu r_n with the velocity u_t + e_t u_t^before to be stopped: u_t' = -e_t u_t where friction bears it, else
// u_t' = u_t - mu (1 + e_n) |u_n|.
TEST(NewtonImpact, TangentialRestitutionIsLimitedByFriction)
{
    const double en = 0.6, et = 0.4, vn = 2;
    for (double friction : { 0.0, 0.1, 0.5, 3.0 })
        for (double vt : { -1.0, 0.2, 3.0 }) {
            PointMasses masses({ 5 });
            masses.impact = { en, et };
            masses.friction = friction;
            masses.v(0) = Vec<2>(vt, -vn);
            masses.begin();
            masses.touch(0, -1, y, 0.1);
            masses.solve();
            const double most = friction * (1 + en) * vn, wished = (1 + et) * std::abs(vt);
            EXPECT_NEAR(masses.v(0).x(), vt - std::copysign(std::min(most, wished), vt), 1e-14);
            EXPECT_NEAR(masses.v(0).y(), en * vn, 1e-14);
            EXPECT_GE(dissipated(masses.problem), 0);
        }
}

/// Velocities of a row of equal masses after the first has come at speed 1, with gaps of `gap` steps' ways between them.
std::vector<double> cradle(int count, double e, double gap)
{
    PointMasses masses(std::vector<double>(size_t(count), 0.7));
    masses.impact.normal = e;
    masses.v(0) = x;
    std::vector<double> place;
    for (int i = 0; i < count; ++i)
        place.push_back(gap * i);
    for (int step = 0; step < 10 * count; ++step) {
        masses.begin();
        for (int i = 0; i + 1 < count; ++i)
            if (const double left = place[size_t(i) + 1] - place[size_t(i)]; left < 2) masses.touch(i, i + 1, -x, left);
        masses.solve();
        for (int i = 0; i < count; ++i)
            place[size_t(i)] += masses.v(i).x();
    }
    std::vector<double> all;
    for (int i = 0; i < count; ++i)
        all.push_back(masses.v(i).x());
    return all;
}

// Newton's cradle. With gaps impacts come one after the other: each hands on (1 + e) / 2 of its velocity, and with e = 1 the
// last flies off alone. In touch all impacts are one: Newton's law then says u' = -e u of the first contact and u' = 0 of the
// others (Moreau 1994), so that all but the first fly off together.
TEST(NewtonImpact, CradlePassesImpactsOnWhereTheyFollowEachOther)
{
    for (int count : { 3, 5 }) {
        const auto apart = cradle(count, 1, 1.3);
        for (int i = 0; i < count; ++i)
            EXPECT_NEAR(apart[size_t(i)], i == count - 1, 1e-12);
        EXPECT_NEAR(cradle(count, 0.8, 1.3).back(), std::pow(0.9, count - 1), 1e-12);
        const auto together = cradle(count, 1, 0);
        for (int i = 0; i < count; ++i)
            EXPECT_NEAR(together[size_t(i)], i == 0 ? 2.0 / count - 1 : 2.0 / count, 1e-11);
    }
}

/// The work that a random problem of three grains, a rigid body and planes takes in, over the energy exchanged. All of its
/// contacts close.
double dissipated_share(Random& random, double friction, const NewtonImpact<2>& impact)
{
    RandomProblem p(random, random.integer(1, 9), friction);
    for (auto& contact : p.problem.contacts) {
        const Vec<2> u = p.problem.relative(contact, &Surface<2>::velocity);
        if (u.dot(contact.normal) > 0) contact.normal *= -1;
        ContactPoint<2> point {};
        point.normal = contact.normal;
        contact.offset = impact.offset(point, Vec<2>::Zero(), u, u);
    }
    NonlinearGaussSeidel<2>(1e-12, 1000).solve(p.problem);
    double exchanged = 0;
    for (const auto& contact : p.problem.contacts)
        exchanged += contact.impulse.squaredNorm() / contact.inertia / 2;
    return dissipated(p.problem) / exchanged;
}

/// The same of a rigid rod that hits a heavy mass with one end: the impulse turns it, so that normal and tangential velocities of
/// the end depend on each other.
double dissipated_share_of_a_rod(Random& random, double friction, const NewtonImpact<2>& impact)
{
    PointMasses masses({ 1e9 });
    masses.friction = friction;
    masses.impact = impact;
    masses.begin();
    RigidBody<2> rod;
    const double angle = random.uniform(0.1, 1.4), half_length = 0.5, mass = 2;
    rod.centre = half_length * Vec<2>(std::cos(angle), std::sin(angle));
    rod.mobility = Vec<3>(1 / mass, 1 / mass, 3 / (mass * half_length * half_length)).asDiagonal();
    rod.twist << random.uniform(-1, 1), -1, random.uniform(-1, 1);
    rod.before = rod.twist;
    Surface<2> end;
    end.rigid = &rod;
    masses.problem.bodies.push_back(&end);
    const auto energy = [&] { return rod.twist.dot(rod.mobility.inverse() * rod.twist) / 2; };
    const double before = energy();
    if ((rod.lever(Vec<2>::Zero()) * rod.twist).y() >= 0) return 1; // it leaves
    masses.touch(1, 0, y);
    masses.solve();
    EXPECT_NEAR(before - energy(), dissipated(masses.problem), 1e-8 * before);
    return dissipated(masses.problem) / before;
}

// With u^a = (u' + e u) / (1 + e) the law says r . u^a <= 0, and u' = u + W r gives
//     dE = r . (u' + u) / 2 = r . u^a - (1 - e) / (1 + e) r . W r / 2 <= 0.
// Without friction r_n u_n^a = 0 contact by contact, and dE = - sum (1 - e) r_n |u_n| / 2. With friction and e_t < e_n a
// contact that reverses its slide can create energy, as Kane and Levinson 1985 noted of Newton's law.
TEST(NewtonImpact, NeverCreatesEnergyWithOneCoefficient)
{
    Random random(2);
    double worst = 1, worst_frictionless = 1, rod = 1, paradox = 1;
    for (int trial = 0; trial < 300; ++trial) {
        const double e = random.uniform(0, 1);
        worst = std::min(worst, dissipated_share(random, random.uniform(0, 1), { e, e }));
        worst_frictionless = std::min(worst_frictionless, dissipated_share(random, 0, { e, 0 }));
        rod = std::min(rod, dissipated_share_of_a_rod(random, random.uniform(0, 1), { e, e }));
        paradox = std::min(paradox, dissipated_share_of_a_rod(random, random.uniform(0, 1), { 1, 0 }));
    }
    std::printf(
        "least share of the energy that is dissipated: %.1e with e_t = e_n, %.1e without friction, %.1e of a rod; %+.2f of "
        "a rod with e_n = 1, e_t = 0\n",
        worst, worst_frictionless, rod, paradox);
    EXPECT_GE(worst, -1e-10);
    EXPECT_GE(worst_frictionless, -1e-10);
    EXPECT_GE(rod, -1e-8);
    EXPECT_LT(paradox, -0.01) << "energy is created, and counted";
}

} // namespace
