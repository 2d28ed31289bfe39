// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/support.hpp"
#include "support/finite_difference.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

Surface<2> circle(int count, double phase = 0)
{
    auto vertices = polar(count, [](double) { return 1.0; });
    for (auto& v : vertices)
        v = Vec<2>(std::cos(phase) * v.x() - std::sin(phase) * v.y(), std::sin(phase) * v.x() + std::cos(phase) * v.y());
    return surface_of(vertices);
}

Projection project_from_nearest(const Surface<2>& surface, const Vec<2>& x)
{
    return project(surface, x, nearest_segment(surface, x));
}

/// Largest error of the gap to the sampled circle of radius 1, at points |x| - 1 in [lo, hi].
double circle_error(int count, double lo, double hi, Random& random)
{
    const Surface<2> surface = circle(count, random.uniform(0, 7));
    double worst = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Vec<2> x = (1 + random.uniform(lo, hi)) * random.unit<2>();
        worst = std::max(worst, std::abs(project_from_nearest(surface, x).gap - (x.norm() - 1)));
    }
    return worst;
}

// Half-way between vertices of a circle, an angle theta apart, the cubic stands at R (9 cos(theta/2) - cos(3 theta/2)) / 8, that
// is 9/384 R theta^4 inside of it: order 4. (The chord alone is off by R theta^2 / 8.)
TEST(Projection, GapOfASampledCircleIsOfOrder4)
{
    Random random(1);
    std::vector<double> error;
    for (int count : { 16, 32, 64, 128 }) {
        error.push_back(circle_error(count, -1e-3, 1e-3, random));
        EXPECT_LE(error.back(), 9.0 / 384 * std::pow(2 * M_PI / count, 4) * 1.05) << count << " points";
    }
    for (size_t k = 1; k < error.size(); ++k)
        EXPECT_NEAR(std::log2(error[k - 1] / error[k]), 4, 0.1);
    std::printf("gap error of a circle of 16, 32, 64, 128 points: %.2e %.2e %.2e %.2e R\n", error[0], error[1], error[2],
                error[3]);
}

// At the vertices and half-way between them the cubic's tangent is that of the circle, by symmetry; between, it is off by
// the derivative of an error of order 4: order 3.
TEST(Projection, NormalOfASampledCircleIsRadialToOrder3)
{
    Random random(2);
    std::vector<double> error;
    for (int count : { 16, 32, 64 }) {
        const Surface<2> surface = circle(count);
        error.push_back(0);
        for (int trial = 0; trial < 4000; ++trial) {
            const Vec<2> x = (1 + random.uniform(-1e-3, 1e-3)) * random.unit<2>();
            error.back() = std::max(error.back(), (project_from_nearest(surface, x).normal - x.normalized()).norm());
        }
    }
    for (size_t k = 1; k < error.size(); ++k)
        EXPECT_NEAR(std::log2(error[k - 1] / error[k]), 3, 0.1);
}

/// Smooth shapes, sampled; the largest turn of the boundary at a vertex [rad].
struct Smooth {
    std::string name;
    Surface<2> surface;
    double turn;
};

std::vector<Smooth> smooth_shapes()
{
    std::vector<Smooth> all { { "circle", circle(30), 0 },
                              { "ellipse", surface_of(ellipse_vertices(60, 1.6, 1)), 0 },
                              { "flower", surface_of(polar(100, [](double t) { return 1 + 0.1 * std::cos(4 * t); })), 0 } };
    for (auto& shape : all) {
        const auto& s = shape.surface;
        for (int i = 0; i < s.count; ++i) {
            const Vec<2> in = s.x((i + 1) % s.count) - s.x(i), out = s.x((i + 2) % s.count) - s.x((i + 1) % s.count);
            shape.turn = std::max(shape.turn, std::abs(std::atan2(cross(in, out), in.dot(out))));
        }
    }
    return all;
}

// Distance to the outline, found by brute force on a fine sampling of it.
TEST(Projection, GapIsTheDistanceToTheSmoothedBoundary)
{
    Random random(3);
    for (const auto& shape : smooth_shapes()) {
        const auto curve = smoothed(shape.surface, 60);
        double worst = 0;
        for (int trial = 0; trial < 1500; ++trial) {
            const int p = random.integer(0, shape.surface.count - 1);
            const Vec<2> a = shape.surface.x(p), b = shape.surface.x((p + 1) % shape.surface.count);
            const Vec<2> x = a + random.uniform(0, 1) * (b - a) + random.vector<2>(0.02);
            const double gap = project_from_nearest(shape.surface, x).gap;
            worst = std::max(worst, std::abs(gap - brute_force_distance(curve, x)));
        }
        // the fine polyline itself strays by (turn / 60)^2 / 8 of a radius of curvature
        EXPECT_LE(worst, std::pow(shape.turn / 60, 2)) << shape.name << " " << shape.turn;
    }
}

// What the contact law acts on: as the point moves by dx and the vertices by dx_k, the gap changes by
// n . (dx - sum of weight_k dx_k).
TEST(Projection, GapChangesAsPointAndVerticesMoveAlongTheNormal)
{
    Random random(8);
    for (const auto& shape : smooth_shapes()) {
        int checked = 0;
        for (int trial = 0; trial < 300; ++trial) {
            const Vec<2> x = Vec<2>(shape.surface.x(random.integer(0, shape.surface.count - 1))) + random.vector<2>(0.05);
            const Projection at = project_from_nearest(shape.surface, x);
            if (at.t < 0.01 || at.t > 0.99) continue; // the curvature jumps at the vertices
            ++checked;
            std::vector<double> place { x.x(), x.y() };
            for (int vertex : at.vertex)
                place.insert(place.end(), { shape.surface.x(vertex).x(), shape.surface.x(vertex).y() });
            const auto slope = central_gradient(
                [&](const std::vector<double>& moved) {
                    Surface<2> surface = shape.surface;
                    for (int k = 0; k < 4; ++k)
                        for (int d = 0; d < 2; ++d)
                            surface.position[2 * at.vertex[k] + d] = moved[2 + 2 * k + d];
                    return project(surface, Vec<2>(moved[0], moved[1]), at.segment).gap;
                },
                place, 1e-4);
            for (int d = 0; d < 2; ++d) {
                ASSERT_NEAR(slope[d], at.normal[d], 1e-7) << shape.name;
                for (int k = 0; k < 4; ++k)
                    ASSERT_NEAR(slope[2 + 2 * k + d], -at.weight[k] * at.normal[d], 1e-7) << shape.name;
            }
        }
        EXPECT_GT(checked, 100);
    }
}

// A normal contact force makes no couple when foot, point and normal are in line: everywhere but between two segments,
// where the vertex is the foot.
TEST(Projection, FootPointAndNormalAreInLine)
{
    Random random(4);
    int checked = 0;
    for (const double distance : { 1e-3, 2e-2 })
        for (const auto& shape : smooth_shapes())
            for (int trial = 0; trial < 2000; ++trial) {
                const int p = random.integer(0, shape.surface.count - 1);
                const Vec<2> x = Vec<2>(shape.surface.x(p)) + random.vector<2>(distance);
                const Projection at = project_from_nearest(shape.surface, x);
                ASSERT_GE(at.t, 0);
                ASSERT_LE(at.t, 1);
                ASSERT_NEAR(at.normal.norm(), 1, 1e-15);
                ASSERT_NEAR(at.weight[0] + at.weight[1] + at.weight[2] + at.weight[3], 1, 1e-15);
                const Vec<2> foot = foot_of(shape.surface, at);
                ASSERT_NEAR(at.normal.dot(x - foot), at.gap, 1e-15);
                if (at.t == 0 || at.t == 1) continue;
                ++checked;
                ASSERT_NEAR(cross(x - foot, at.normal), 0, 1e-10) << shape.name; // the square of the last step of project()
            }
    EXPECT_GT(checked, 8000);
}

TEST(Projection, NormalAndGapAreContinuousAlongTheBoundary)
{
    for (const auto& shape : smooth_shapes()) {
        // along a curve at a small distance, in steps of 1/200 of a segment
        const auto curve = smoothed(shape.surface, 200);
        Projection before {};
        for (size_t i = 0; i < curve.size(); ++i) {
            const Vec<2> along = (curve[(i + 1) % curve.size()] - curve[i]).normalized();
            const Vec<2> x = curve[i] + 0.003 * Vec<2>(along.y(), -along.x());
            const Projection at = project_from_nearest(shape.surface, x);
            if (i > 0) {
                // turn / 200 is the way of the normal in a mean step
                ASSERT_LE((at.normal - before.normal).norm(), 3 * shape.turn / 200) << shape.name << " " << i;
                ASSERT_NEAR(at.gap, 0.003, 1e-6) << shape.name << " " << i;
            }
            before = at;
        }
    }
}

TEST(Projection, ComesOutTheSameFromEveryNearStart)
{
    Random random(5);
    for (const auto& shape : smooth_shapes())
        for (int trial = 0; trial < 500; ++trial) {
            const Vec<2> x = Vec<2>(shape.surface.x(random.integer(0, shape.surface.count - 1))) + random.vector<2>(0.02);
            const int nearest = nearest_segment(shape.surface, x), n = shape.surface.count;
            const Projection at = project(shape.surface, x, nearest);
            for (int off = -4; off <= 4; ++off) {
                const Projection again = project(shape.surface, x, (nearest + off + n) % n);
                // to the last digit; at the vertex between two segments either may have the foot
                if (again.segment == at.segment) {
                    ASSERT_EQ(again.t, at.t) << shape.name << " from " << off;
                    ASSERT_EQ(again.gap, at.gap) << shape.name << " from " << off;
                }
                ASSERT_NEAR(again.gap, at.gap, 1e-13) << shape.name << " from " << off;
                ASSERT_LE((again.normal - at.normal).norm(), 1e-7) << shape.name << " from " << off;
            }
        }
}

// Straight faces have straight normals: near a polygon with sharp corners the gap is the distance to its faces; beyond
// a corner it is taken along the bisector of the normals, and is no more than the distance.
void expect_distances(const std::string& name, const std::vector<Vec<2>>& vertices, double spacing)
{
    Random random(6);
    const Surface<2> surface = surface_of(PolygonOutline(vertices), spacing);
    const auto curve = smoothed(surface, 1);
    int faces = 0, corners = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        const int p = random.integer(0, surface.count - 1);
        const Vec<2> x = Vec<2>(surface.x(p)) + random.vector<2>(0.1);
        const double distance = brute_force_distance(curve, x);
        if (distance < -0.02) continue; // deep inside a corner it is another face's turn
        const Projection at = project_from_nearest(surface, x);
        const Vec<2> foot = foot_of(surface, at);
        if (std::abs(cross((x - foot).normalized(), at.normal)) > 1e-9) {
            ++corners;
            ASSERT_TRUE(surface.corner[at.segment]) << name;
            ASSERT_EQ(at.t, 0) << name;
            ASSERT_LE(at.gap, distance + 1e-13) << name;
            ASSERT_GT(at.gap, 0) << name;
            ASSERT_NEAR((x - foot).norm(), distance, 1e-13) << name;
        } else if (distance > 0) {
            ++faces;
            ASSERT_NEAR(at.gap, distance, 1e-13) << name << " at " << x.transpose();
        } else {
            ++faces;
            // inside: the distance to a face near by, if not to the nearest one
            ASSERT_LE(at.gap, distance + 1e-13) << name << " at " << x.transpose();
            ASSERT_GE(at.gap, -0.2) << name << " at " << x.transpose();
        }
    }
    EXPECT_GT(faces, 1000) << name;
    EXPECT_GT(corners, 20) << name;
}

TEST(Projection, PolygonWithCornersHasStraightFaces)
{
    for (double spacing : { 0.2, 10.0 }) {
        expect_distances("rectangle", rectangle_vertices(2, 1), spacing);
        expect_distances("hexagon", polar(6, [](double) { return 1.0; }), spacing);
    }
}

// At a corner of less than 90 degrees a point outside of one face stands inside of the other face's line, and its foot
// there lies on that face: the nearer face counts.
TEST(Projection, PolygonWithAcuteCornersHasStraightFacesToo)
{
    for (double spacing : { 0.2, 10.0 })
        expect_distances("triangle", { { 0, 0 }, { 2, 0.1 }, { 0.6, 1.5 } }, spacing);
}

TEST(CrossesItself, IsToldOfFoldedBoundariesAlone)
{
    EXPECT_FALSE(crosses_itself(circle(24)));
    EXPECT_FALSE(crosses_itself(surface_of({ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 1, 0.5 }, { 0, 2 } }))); // a dent
    EXPECT_TRUE(crosses_itself(surface_of({ { 0, 0 }, { 2, 0 }, { 2, 2 }, { 1, -0.5 }, { 0, 2 } })));
    EXPECT_TRUE(crosses_itself(surface_of({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } })));
}

TEST(NearestSegment, IsTheNearest)
{
    Random random(7);
    const Surface<2> surface = surface_of(ellipse_vertices(37, 2, 1));
    const auto distance = [&](const Vec<2>& x, int segment) {
        double least = 1e300; // by a thousand samples: good to a thousandth of the chord
        const Vec<2> a = surface.x(segment), b = surface.x((segment + 1) % surface.count);
        for (int k = 0; k <= 1000; ++k)
            least = std::min(least, (a + k / 1000.0 * (b - a) - x).norm());
        return least;
    };
    for (int trial = 0; trial < 100; ++trial) {
        const Vec<2> x = random.vector<2>(3);
        const double found = distance(x, nearest_segment(surface, x));
        for (int i = 0; i < surface.count; ++i)
            ASSERT_GE(distance(x, i), found - 1e-3 * (surface.x(1) - surface.x(0)).norm());
    }
}

} // namespace
