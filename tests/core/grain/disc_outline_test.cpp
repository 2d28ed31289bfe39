// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain/outline.hpp"
#include "support/random.hpp"
#include "support/triangulation.hpp"

#include <array>
#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const DiscOutline disc;
// Sums of some hundred terms of order 1.
constexpr double round_off = 1e-13;

Moments<2> moments(double volume, double x, double y, double xx, double xy, double yy)
{
    return { volume, Vec<2>(x, y), (Mat<2>() << xx, xy, xy, yy).finished() };
}

/// The segment x > cos(angle) of the unit disc: with x = cos(t), dx = sin(t) dt,
///     A = t - sin(2t)/2, int x = 2/3 sin^3 t, int x^2 = t/4 - sin(4t)/16, int y^2 = t/4 - sin(2t)/6 + sin(4t)/48.
Moments<2> segment(double t)
{
    return moments(t - std::sin(2 * t) / 2, 2.0 / 3 * std::pow(std::sin(t), 3), 0, t / 4 - std::sin(4 * t) / 16, 0,
                   t / 4 - std::sin(2 * t) / 6 + std::sin(4 * t) / 48);
}

TEST(DiscOutline, WholeDiscHasItsClosedForm)
{
    const Moments<2> exact = moments(M_PI, 0, 0, M_PI / 4, 0, M_PI / 4);
    EXPECT_LE(difference(disc.moments(), exact), round_off);
    EXPECT_LE(difference(disc.moments({ Vec<2>(-1, -1), Vec<2>(1, 1) }), exact), round_off);
    EXPECT_LE(difference(disc.moments({ Vec<2>(-3, -2), Vec<2>(4, 5) }), exact), round_off);
}

TEST(DiscOutline, QuartersHaveTheirClosedForm)
{
    // A = pi/4, int x = 1/3, int x^2 = pi/16, int x y = 1/8
    for (double sx : { -1.0, 1.0 })
        for (double sy : { -1.0, 1.0 }) {
            const Vec<2> corner(sx * 1.5, sy * 1.5);
            const Box<2> box { corner.cwiseMin(Vec<2>::Zero()), corner.cwiseMax(Vec<2>::Zero()) };
            EXPECT_LE(difference(disc.moments(box), moments(M_PI / 4, sx / 3, sy / 3, M_PI / 16, sx * sy / 8, M_PI / 16)),
                      round_off);
        }
}

TEST(DiscOutline, SegmentsHaveTheirClosedFormOnEverySide)
{
    for (double t : { 1e-3, 0.1, 0.7, M_PI / 2, 2.0, 3.0 }) {
        const double cut = std::cos(t);
        const Moments<2> s = segment(t);
        EXPECT_LE(difference(disc.moments({ Vec<2>(cut, -1), Vec<2>(1, 1) }), s), round_off) << t;
        EXPECT_LE(difference(disc.moments({ Vec<2>(-1, -1), Vec<2>(-cut, 1) }),
                             moments(s.volume, -s.first.x(), 0, s.second(0, 0), 0, s.second(1, 1))),
                  round_off)
            << t;
        EXPECT_LE(difference(disc.moments({ Vec<2>(-1, cut), Vec<2>(1, 1) }),
                             moments(s.volume, 0, s.first.x(), s.second(1, 1), 0, s.second(0, 0))),
                  round_off)
            << t;
        EXPECT_LE(difference(disc.moments({ Vec<2>(-1, -1), Vec<2>(1, -cut) }),
                             moments(s.volume, 0, -s.first.x(), s.second(1, 1), 0, s.second(0, 0))),
                  round_off)
            << t;
    }
}

TEST(DiscOutline, BoxInsideIsWhole)
{
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        const Vec<2> a = random.vector<2>(0.7), b = random.vector<2>(0.7);
        const Box<2> box { a.cwiseMin(b), a.cwiseMax(b) };
        EXPECT_LE(difference(
                      disc.moments(box),
                      oracle_moments({ box.min, { box.max.x(), box.min.y() }, box.max, { box.min.x(), box.max.y() } }, box)),
                  round_off);
    }
}

TEST(DiscOutline, BoxOutsideIsEmpty)
{
    for (const Box<2>& box :
         { Box<2> { Vec<2>(1, -1), Vec<2>(2, 1) }, Box<2> { Vec<2>(0.8, 0.8), Vec<2>(1, 1) },
           Box<2> { Vec<2>(-0.5, 1.1), Vec<2>(0.5, 2) }, Box<2> { Vec<2>(-1, -1), Vec<2>(-0.75, -0.75) } })
        EXPECT_EQ(difference(disc.moments(box), {}), 0);
}

/// A polygon inscribed in the disc misses it by O(count^-2): an oracle without the code's case distinctions.
TEST(DiscOutline, AgreesWithAFinePolygonOnRandomBoxes)
{
    constexpr int count = 400;
    std::vector<Vec<2>> vertices;
    const double radius = std::sqrt(2 * M_PI / count / std::sin(2 * M_PI / count)); // of equal area
    for (int i = 0; i < count; ++i)
        vertices.push_back(radius * Vec<2>(std::cos(2 * M_PI * i / count), std::sin(2 * M_PI * i / count)));
    Random random(2);
    for (int trial = 0; trial < 20; ++trial) {
        const Vec<2> a = random.vector<2>(1.1), b = random.vector<2>(1.1);
        const Box<2> box { a.cwiseMin(b), a.cwiseMax(b) };
        // the polygon strays from the circle by at most (pi / count)^2 / 2, over the boundary's length
        EXPECT_LE(difference(disc.moments(box), oracle_moments(vertices, box)), 2 * M_PI * std::pow(M_PI / count, 2) / 2);
    }
}

TEST(DiscOutline, TilingAddsUpToTheWhole)
{
    Random random(3);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> cuts[2];
        for (auto& axis : cuts) {
            axis = { -1, 1 };
            for (int k = random.integer(0, 12); k > 0; --k)
                axis.push_back(random.uniform(-1, 1));
            std::sort(axis.begin(), axis.end());
        }
        Moments<2> sum;
        for (size_t i = 0; i + 1 < cuts[0].size(); ++i)
            for (size_t j = 0; j + 1 < cuts[1].size(); ++j)
                sum += disc.moments({ Vec<2>(cuts[0][i], cuts[1][j]), Vec<2>(cuts[0][i + 1], cuts[1][j + 1]) });
        EXPECT_LE(difference(sum, disc.moments()), round_off);
    }
}

TEST(DiscOutline, SamplesTheCircleEvenly)
{
    for (double spacing : { 3.0, 0.5, 0.17, 0.01, 2 * M_PI / 40 }) {
        const auto points = disc.sample(spacing);
        ASSERT_GE(points.size(), 8u);
        double length = 0;
        for (size_t i = 0; i < points.size(); ++i) {
            const Vec<2>&a = points[i].position, &b = points[(i + 1) % points.size()].position;
            EXPECT_NEAR(a.norm(), 1, 1e-15);
            EXPECT_LE((b - a).norm(), spacing);
            EXPECT_GT(turn_of(Vec<2>::Zero(), a, b), 0) << "counter-clockwise";
            EXPECT_FALSE(points[i].corner);
            length += points[i].weight;
        }
        EXPECT_NEAR(length, 2 * M_PI, 1e-13);
    }
    EXPECT_EQ(disc.sample(2 * M_PI / 41).size(), 41u) << "no more than the spacing asks for";
    EXPECT_EQ(disc.sample(2 * M_PI / 40).size(), 41u) << "an odd number";
}

// Seen along either axis from either side, the nearest point stands an eighth or three eighths of the distance beside the
// axis, and on the opposite side the other of the two.
TEST(DiscOutline, PlacesItsPointsBesideTheAxes)
{
    for (double spacing : { 0.5, 0.23, 0.2222, 0.1 }) {
        const auto points = disc.sample(spacing);
        std::array<double, 4> place;
        for (int side = 0; side < 4; ++side) {
            double nearest = 1;
            for (const auto& point : points) {
                const double angle = std::atan2(point.position.y(), point.position.x()) - side * M_PI / 2;
                nearest = std::min(nearest, std::abs(std::remainder(angle, 2 * M_PI)) * points.size() / (2 * M_PI));
            }
            place[side] = nearest;
            EXPECT_NEAR(std::abs(nearest - 0.25), 0.125, 1e-9) << points.size();
        }
        EXPECT_NEAR(place[0] + place[2], 0.5, 1e-9);
        EXPECT_NEAR(place[1] + place[3], 0.5, 1e-9);
    }
}

} // namespace
