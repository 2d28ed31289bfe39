// SPDX-License-Identifier: GPL-2.0-or-later
// Walls that press with a wanted force, against springs that stiffen without bound.
#include "step/wall_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace softgrain;

namespace {

TEST(Piston, IsDrivenByTheWantedForceAndADragThatEatsItAtItsSpeed)
{
    const Piston piston { 0.02, 0.5, 30, 0 };
    const double dt = 1e-7;
    EXPECT_DOUBLE_EQ(piston.kicked(0, dt), 30 * dt / 0.02);
    EXPECT_DOUBLE_EQ(piston.kicked(0.5, dt), 0.5);
    EXPECT_DOUBLE_EQ(piston.kicked(0.7, dt), 0.5) << "thrown, it is caught";
    EXPECT_DOUBLE_EQ(piston.drag(-0.5), -30);
}

// What presses it away at a share s of its speed has to bear 1 / (1 - drag) of the wanted force.
TEST(Piston, GivesWaySlowlyUnderLittleMoreThanTheWantedForce)
{
    for (const auto& [share, excess] : { std::pair { 0.05, 0.006 }, { 0.1, 0.012 }, { 0.2, 0.03 }, { 0.4, 0.15 } }) {
        const Piston piston { 0.02, 0.5, 30, 30 * (1 + excess) };
        const double net = piston.borne + piston.drag(-share * piston.speed) - piston.wanted; // outwards
        EXPECT_GT(net, 0) << "it would move faster, so the true excess is smaller: " << share;
    }
}

TEST(Piston, DoesNotRunFasterHoweverLongStepsAre)
{
    for (double dt : { 1e-7, 1e-4, 1.0, 1e5 }) {
        const Piston piston { 0.02, 0.5, 30, 0 };
        double v = 0;
        for (int step = 0; step < 2000; ++step) {
            const double before = v;
            v = piston.kicked(v, dt);
            EXPECT_GE(v, before);
            EXPECT_LE(v, 0.5);
        }
        if (dt >= 1e-4) {
            EXPECT_NEAR(v, 0.5, 1e-6);
        }
    }
}

// A wall at rest on grains that take every kick away again bears the wanted force to the last digit.
TEST(Piston, AtRestItPressesWithTheWantedForce)
{
    for (double dt : { 1e-8, 1e-5, 1e-2 })
        for (double borne : { 0.0, 30.0, 500.0 }) {
            const Piston piston { 0.02, 0.5, 30, borne };
            EXPECT_NEAR(piston.inertia(dt) * piston.kicked(0, dt) / dt, 30, 1e-12);
        }
}

TEST(Piston, StandsWhereNothingIsWantedAndNothingBorne) { EXPECT_EQ((Piston { 1, 1, 0, 0 }).kicked(0.3, 1e-6), 0); }

TEST(Piston, LosesEnergyWhereNothingIsWanted)
{
    for (double dt : { 1e-6, 1e-2, 10.0 })
        for (double v : { -2.0, 3.0 }) {
            const double after = (Piston { 1, 1, 0, 5 }).kicked(v, dt);
            EXPECT_LT(std::abs(after), std::min(std::abs(v), 1.0));
            EXPECT_GT(after * v, 0) << "and does not turn round";
        }
}

// Force over way: none up to a gap, then a power with a stiffness of any size that grows by exp(way / scale).
struct Spring {
    double gap, stiffness, power, scale;
    double force(double way) const
    {
        const double pressed = way - gap;
        return pressed > 0 ? stiffness * std::pow(pressed, power) * std::exp(pressed / scale) : 0;
    }
};

TEST(Servo, FindsTheForceOfStiffeningSprings)
{
    for (double stiffness : { 1e2, 1e4, 1e6, 1e8 })
        for (double power : { 1.0, 1.5, 3.0 })
            for (double scale : { 0.5, 0.02 })
                for (double gap : { 0.0, 0.0137, 0.3 }) {
                    const Spring spring { gap, stiffness, power, scale };
                    const double most = 0.01, wanted = 50;
                    Servo servo;
                    double at = 0, way = 0, error = 1;
                    int step = 0;
                    const int approach = int(gap / most) + int(std::pow(wanted / stiffness, 1 / power) / most);
                    while (error > 1e-6 && step < approach + 60) {
                        way = servo.next(wanted, spring.force(at), way, most);
                        ASSERT_LE(std::abs(way), most);
                        at += way;
                        error = std::abs(spring.force(at) / wanted - 1);
                        ++step;
                    }
                    EXPECT_LT(error, 1e-6) << stiffness << " " << power << " " << scale << " " << gap;
                }
}

TEST(Servo, FollowsAWantedForceThatChanges)
{
    const Spring spring { 0.05, 1e5, 1.5, 0.1 };
    Servo servo;
    double at = 0, way = 0;
    for (double wanted : { 10.0, 1e4, 100.0, 0.0 }) {
        for (int step = 0; step < 80; ++step)
            at += way = servo.next(wanted, spring.force(at), way, 0.01);
        EXPECT_NEAR(spring.force(at), wanted, 1e-6 * 1e4);
    }
}

TEST(Servo, StandsWhereTheForceIsRight)
{
    Servo servo;
    servo.next(5, 3, 1, 1);
    EXPECT_EQ(servo.next(5, 5, 1, 1), 0);
}

} // namespace
