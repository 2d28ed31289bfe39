// SPDX-License-Identifier: GPL-2.0-or-later
// Contacts of rigid discs among each other.
#include "support/random.hpp"

#include "solver/matrix_form.hpp"
#include "solver/nlgs.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <deque>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

class Discs {
public:
    explicit Discs(double friction)
        : friction_(friction)
    {
    }
    Discs(const Discs&) = delete; // the problem points into it

    ContactProblem<2> problem;

    int add(const Vec<2>& centre, double radius, double mass, const Vec<2>& velocity = Vec<2>::Zero(), double spin = 0)
    {
        RigidBody<2>& body = bodies_.emplace_back();
        body.centre = centre;
        body.mobility.setZero();
        body.mobility.diagonal() << 1 / mass, 1 / mass, 2 / (mass * radius * radius);
        body.twist << velocity, spin;
        body.before = body.twist;
        radii_.push_back(radius);
        Surface<2>& surface = surfaces_.emplace_back();
        surface.rigid = &body;
        problem.bodies.push_back(&surface);
        return int(bodies_.size()) - 1;
    }
    /// Of two discs; or of one with a plane at rest through `place`, normal towards the disc.
    void touch(int first, int second, double gap_speed = 0)
    {
        const Vec<2> way = bodies_[size_t(first)].centre - bodies_[size_t(second)].centre, n = way.normalized();
        auto& contact = meet(first, bodies_[size_t(second)].centre + radii_[size_t(second)] * n, n, gap_speed);
        contact.other = second;
        contact.vertex = { problem.bodies[size_t(second)]->add(problem.bodies[size_t(first)]->x(contact.point)) };
        contact.weight = { 1 };
    }
    void touch_plane(int disc, const Vec<2>& n)
    {
        meet(disc, bodies_[size_t(disc)].centre - radii_[size_t(disc)] * n, n, 0);
    }

    Vec<3> momentum() const
    {
        Vec<3> sum = Vec<3>::Zero();
        for (const auto& body : bodies_) {
            const Vec<3> p = body.twist.cwiseQuotient(body.mobility.diagonal());
            sum += p;
            sum[2] += body.centre.x() * p.y() - body.centre.y() * p.x();
        }
        return sum;
    }
    const RigidBody<2>::Twist& twist(int disc) const { return bodies_[size_t(disc)].twist; }
    int solve(double tolerance) { return NonlinearGaussSeidel<2>(tolerance, 100000).solve(problem); }

private:
    Contact<2>& meet(int disc, const Vec<2>& place, const Vec<2>& n, double gap_speed)
    {
        Contact<2> contact {};
        contact.body = disc;
        contact.other = -1;
        contact.point = problem.bodies[size_t(disc)]->add(place);
        contact.normal = n;
        contact.offset = gap_speed * n;
        contact.drive = contact.impulse = Vec<2>::Zero();
        contact.friction = friction_;
        contact.law = &law_;
        problem.contacts.push_back(contact);
        return problem.contacts.back();
    }

    double friction_;
    SignoriniCoulomb<2> law_;
    std::deque<RigidBody<2>> bodies_;
    std::deque<Surface<2>> surfaces_;
    std::vector<double> radii_;
};

/// Discs on a square lattice that fly about, each in touch with its neighbours.
void fill(Discs& discs, int rows, Random& random)
{
    for (int i = 0; i < rows * rows; ++i)
        discs.add(Vec<2>(i % rows, i / rows), 0.5, random.log_uniform(0.1, 10), random.vector<2>(1), random.uniform(-1, 1));
    for (int i = 0; i < rows * rows; ++i) {
        if (i % rows > 0) discs.touch(i, i - 1, random.uniform(-0.1, 0.3));
        if (i >= rows) discs.touch(i, i - rows, random.uniform(-0.1, 0.3));
    }
}

TEST(RigidContacts, FulfilTheLawAndKeepMomentum)
{
    Random random(31);
    for (double friction : { 0.0, 0.3, 1.0 }) {
        Discs discs(friction);
        fill(discs, 6, random);
        const Vec<3> before = discs.momentum();
        const int sweeps = discs.solve(1e-12);
        EXPECT_LE(discs.problem.residual(), 1e-9) << "friction " << friction;
        EXPECT_LE((discs.momentum() - before).norm(), 1e-12 * before.norm());
        std::printf("friction %.1f: %d sweeps, residual %.1e\n", friction, sweeps, discs.problem.residual());
    }
}

// W r + q of the problem as it is written out for other solvers is the velocity that the bodies end with.
TEST(RigidContacts, AreThoseOfTheMatrixForm)
{
    Random random(32);
    Discs discs(0.5);
    fill(discs, 4, random);
    discs.solve(1e-10);
    const auto form = matrix_form(discs.problem);
    const Eigen::VectorXd u = form.W * form.r + form.q;
    EXPECT_LE((u - form.u).norm(), 1e-12 * form.q.norm());
}

// A light disc between a floor and a heavy one that falls on it: both stop.
TEST(RigidContacts, OfALightBodyUnderAHeavyOneAreBalancedTogether)
{
    for (double ratio : { 1.0, 1e3, 1e6 }) {
        Discs discs(0.3);
        const int light = discs.add(Vec<2>(0, 1), 1, 1, Vec<2>(0, -1)),
                  heavy = discs.add(Vec<2>(0, 3), 1, ratio, Vec<2>(0, -1));
        discs.touch_plane(light, Vec<2>(0, 1));
        discs.touch(heavy, light);
        const int sweeps = discs.solve(1e-9);
        std::printf("mass ratio %.0e: %d sweeps\n", ratio, sweeps);
        EXPECT_LE(discs.twist(heavy).norm(), 1e-6);
        EXPECT_LE(discs.twist(light).norm(), 1e-6);
        EXPECT_LE(sweeps, 100);
        EXPECT_NEAR(discs.problem.contacts[0].impulse.y() / (1 + ratio), 1, 1e-6);
    }
}

// A column of discs falls on a floor: what it gives has to travel up. Gauss-Seidel alone takes 13331 sweeps for these 40.
TEST(RigidContacts, OfADeepPileTakeFewSweeps)
{
    constexpr int count = 40;
    Discs discs(0.3);
    for (int i = 0; i < count; ++i) {
        discs.add(Vec<2>(0, 0.5 + i), 0.5, 1, Vec<2>(0, -1));
        if (i > 0) discs.touch(i, i - 1);
    }
    discs.touch_plane(0, Vec<2>(0, 1));
    const int sweeps = discs.solve(1e-6);
    EXPECT_LE(sweeps, 1000);
    EXPECT_NEAR(discs.problem.contacts.back().impulse.y() / count, 1, 1e-2);
    std::printf("%d discs: %d sweeps\n", count, sweeps);
}

} // namespace
