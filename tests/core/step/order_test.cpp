// SPDX-License-Identifier: GPL-2.0-or-later
#include "support/world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// Node displacements of a vibrating, turning grain at a fixed time.
Eigen::VectorXd displacements(int steps, double time)
{
    World world;
    GrainStart start;
    start.velocity_gradient = spin(2000) + (Mat<2>() << 8000, 0, 1000, -8000).finished();
    world.add(make_grain(disc_mesh(60), neo_hookean(), start));
    for (int k = 0; k < steps; ++k)
        world.step(time / steps);
    world.release();
    const auto& u = world.grains[0].displacement;
    return Eigen::Map<const Eigen::VectorXd>(u.data(), long(u.size()));
}

// Symplectic Euler with velocities half a step behind is the leapfrog scheme: displacements are of order 2 (Hairer, Lubich,
// Wanner 2006, I.1.4). The start is undeformed: no force, so v(-dt/2) = v(0) + O(dt^2) and no first-order error enters.
TEST(SymplecticEuler, HasDisplacementsOfOrder2)
{
    constexpr double time = 3e-5; // half a period of the first mode; the critical step is some 1e-6
    std::vector<Eigen::VectorXd> u;
    for (int steps : { 100, 200, 400, 800 })
        u.push_back(displacements(steps, time));
    for (int k = 0; k < 2; ++k) {
        const double order = std::log2((u[k] - u[k + 1]).norm() / (u[k + 1] - u[k + 2]).norm());
        EXPECT_NEAR(order, 2, 0.1);
        std::printf("order in time %.3f, change %.1e\n", order, (u[k] - u[k + 1]).norm() / u[k].norm());
    }
}

} // namespace
