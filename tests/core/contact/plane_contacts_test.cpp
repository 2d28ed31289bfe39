// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/support.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const DiscOutline disc;

/// A disc of radius 1 somewhere, and a plane that cuts it `depth` deep.
struct Cut {
    Surface<2> grain = surface_of(disc, 0.1);
    int axis, side;
    double position;
    Cut(int axis_, int side_, double depth)
        : axis(axis_)
        , side(side_)
    {
        move(grain, Vec<2>(3.2, -1.7), 0.03, 1);
        grain.speed = grain.travel = 0;
        position = side > 0 ? grain.min[axis] + depth : grain.max[axis] - depth;
    }
};

TEST(PlaneContacts, AreThePointsBehindThePlaneAndWithinReach)
{
    for (int axis : { 0, 1 })
        for (int side : { -1, 1 })
            for (double depth : { 0.02, 0.3 })
                for (double plane_speed : { 0.0, 5.0 }) {
                    const Cut cut(axis, side, depth);
                    PlaneContacts<2> contacts;
                    contacts.update(cut.grain, axis, cut.position, side, plane_speed, 1e-3);
                    const double near = reach(cut.grain, plane_speed, 1e-3);
                    EXPECT_NEAR(near, 2e-3 * plane_speed + 1e-4, 1e-15);
                    size_t at = 0;
                    for (int p = 0; p < cut.grain.count; ++p) {
                        const double gap = side * (cut.grain.x(p)[axis] - cut.position);
                        if (gap >= near) continue;
                        ASSERT_LT(at, contacts.points.size());
                        EXPECT_EQ(contacts.points[at].point, p);
                        EXPECT_EQ(contacts.points[at].gap, gap);
                        EXPECT_EQ(contacts.points[at].normal, (Vec<2>(side * Vec<2>::Unit(axis))));
                        EXPECT_FALSE(contacts.points[at].on_second);
                        ++at;
                    }
                    EXPECT_EQ(at, contacts.points.size());
                    EXPECT_GE(at, 2u);
                    EXPECT_TRUE(contacts.near());
                }
}

TEST(PlaneContacts, AreNoneAwayFromThePlane)
{
    Cut cut(1, 1, -0.05);
    PlaneContacts<2> contacts;
    contacts.update(cut.grain, 1, cut.position, 1, 0, 1e-3);
    EXPECT_TRUE(contacts.points.empty());
    EXPECT_TRUE(contacts.near()) << "worth keeping";
    contacts.update(cut.grain, 1, cut.position - 0.2, 1, 0, 1e-3);
    EXPECT_TRUE(contacts.points.empty());
    EXPECT_FALSE(contacts.near());
}

TEST(PlaneContacts, CarryForcesToTheSamePoints)
{
    Cut cut(0, -1, 0.05);
    PlaneContacts<2> contacts;
    contacts.update(cut.grain, 0, cut.position, -1, 0, 1e-3);
    const auto before = contacts.points;
    for (auto& contact : contacts.points)
        contact.force = Vec<2>(-contact.point - 1, 0);
    contacts.update(cut.grain, 0, cut.position - 0.1, -1, 0, 1e-3);
    ASSERT_GT(contacts.points.size(), before.size());
    size_t kept = 0;
    for (const auto& contact : contacts.points) {
        const bool old = std::any_of(before.begin(), before.end(), [&](const auto& b) { return b.point == contact.point; });
        EXPECT_EQ(contact.force, old ? Vec<2>(-contact.point - 1, 0) : Vec<2>(0, 0));
        kept += old;
    }
    EXPECT_EQ(kept, before.size());
}

} // namespace
