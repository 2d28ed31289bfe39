// SPDX-License-Identifier: GPL-2.0-or-later
// The measure that judges every solver: || r - P_K(r - u - mu |u_t| n) || / max(|q|, |r|, |u|).
#include "random_problem.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// Impulses changed by hand, velocities renewed to match.
double residual_with(RandomProblem& p, const std::function<void(std::vector<Contact<2>>&)>& change)
{
    const auto contacts = p.problem.contacts;
    change(p.problem.contacts);
    const auto velocities = p.velocities();
    for (size_t b = 0; b < velocities.size(); ++b)
        p.problem.bodies[b]->velocity = velocities[b];
    const double residual = p.problem.residual();
    p.problem.contacts = contacts;
    return residual;
}

TEST(Residual, IsZeroAtASolutionAndPositiveOffIt)
{
    Random random(1);
    for (double friction : { 0.0, 0.4 })
        for (int trial = 0; trial < 20; ++trial) {
            RandomProblem p(random, random.integer(2, 9), friction);
            NonlinearGaussSeidel<2> { 1e-12, 100000 }.solve(p.problem);
            EXPECT_LE(residual_with(p, [](auto&) {}), 1e-10);
            int closed = -1, open = -1;
            for (int i = 0; i < int(p.problem.contacts.size()); ++i)
                (p.problem.contacts[i].impulse.norm() > 0 ? closed : open) = i;
            const double size = p.impulses().norm();
            if (size == 0) continue;
            double inertia = 0;
            for (const auto& contact : p.problem.contacts)
                inertia += contact.inertia / double(p.problem.contacts.size());
            const Eigen::MatrixXd q = p.free_approach(), u = p.delassus() * p.impulses() + q;
            const double scale = std::max({ size, inertia * q.norm(), inertia * u.norm() });
            // an impulse too large, too small, sideways; one where there is none to be
            for (double share : { 1e-2, 1e-4 }) {
                const auto expect_seen = [&](int contact, const Vec<2>& change) {
                    const double residual = residual_with(p, [&](auto& all) { all[contact].impulse += change; });
                    // an impulse d makes a velocity d / (contact's own inertia, at most 9 times the mean of 9)
                    EXPECT_GT(residual, 0.5 * share * size / 9 / scale) << change.transpose();
                };
                const Vec<2> n = p.problem.contacts[closed].normal, t(-n.y(), n.x());
                expect_seen(closed, share * size * n);
                expect_seen(closed, -share * size * n);
                if (friction == 0) expect_seen(closed, share * size * t); // out of the cone
                if (open >= 0) expect_seen(open, share * size * p.problem.contacts[open].normal);
            }
        }
}

// A point that moves on a plane, no impulse yet: u = q, r = 0. Approach along the normal: P_K(-u) = -u, residual 1.
// Separation: 0. Sliding in touch without impulse: P_K(-u_t - mu |u_t| n) = 0, a solution.
TEST(Residual, HasItsValuesForOneContact)
{
    Random random(2);
    RandomProblem p(random, 1, 0.5);
    Contact<2>& c = p.problem.contacts[0];
    c.body = 0;
    c.other = -1;
    c.point = 3;
    c.normal = Vec<2>(0, 1);
    c.drive.setZero();
    c.offset.setZero();
    c.inertia = 2e-3;
    const auto residual = [&](const Vec<2>& u) {
        p.grains[0].surface.v(c.point) = u;
        c.free = u + c.offset - c.drive;
        return p.problem.residual();
    };
    EXPECT_NEAR(residual({ 0, -3 }), 1, 1e-15);
    EXPECT_NEAR(residual({ 0, 3 }), 0, 1e-15);
    EXPECT_NEAR(residual({ 3, 0 }), 0, 1e-15);
    // approach and slide at 45 degrees: target (-1, 1 - mu), projected on the cone |r_t| <= mu r_n from outside of it:
    // (r_n + mu |r_t|) / (1 + mu^2) = (0.5 + 0.5) / 1.25 = 0.8 along the normal, 0.4 sideways
    EXPECT_NEAR(residual({ 1, -1 }), std::hypot(0.8, 0.4) / std::sqrt(2.0), 1e-14);
    // a gap left open outweighs the approach; a drive counts as the plane's velocity
    c.offset = 4 * c.normal;
    EXPECT_NEAR(residual({ 0, -3 }), 0, 1e-15);
    c.offset.setZero();
    c.drive = Vec<2>(0, -4);
    EXPECT_NEAR(residual({ 0, -3 }), 0, 1e-15);
    // without friction the cone is the normal's half-line: separation is a solution, approach is none
    c.drive.setZero();
    c.friction = 0;
    EXPECT_NEAR(residual({ 0, 3 }), 0, 1e-15);
    EXPECT_NEAR(residual({ 0, -3 }), 1, 1e-15);
}

} // namespace
