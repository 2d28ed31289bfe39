// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain/outline.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"
#include "support/triangulation.hpp"

#include <gtest/gtest.h>

#include <limits>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double round_off = 1e-13;

Box<2> around(double size) { return { Vec<2>(-size, -size), Vec<2>(size, size) }; }

TEST(PolygonOutline, IsCentredWithTheAreaOfTheUnitDisc)
{
    for (const auto& [name, vertices] : polygons()) {
        const PolygonOutline outline(vertices);
        EXPECT_NEAR(outline.moments().volume, M_PI, round_off) << name;
        EXPECT_LE(outline.moments().first.norm(), round_off) << name;
    }
}

TEST(PolygonOutline, KeepsTheScaleAndThePlaceOfTheGivenPolygon)
{
    for (const auto& [name, vertices] : polygons()) {
        const PolygonOutline outline(vertices);
        const Moments<2> given = oracle_moments(vertices, around(100));
        EXPECT_NEAR(outline.scale(), std::sqrt(given.volume / M_PI), round_off) << name;
        EXPECT_LE((outline.centroid() - given.centroid()).norm(), round_off) << name;
        for (size_t i = 0; i < vertices.size(); ++i)
            EXPECT_LE((outline.centroid() + outline.scale() * outline.vertices()[i] - vertices[i]).norm(), round_off)
                << name;
    }
}

// A rectangle a x b has covariances a^2/12, b^2/12.
TEST(PolygonOutline, RectangleHasItsClosedForm)
{
    const PolygonOutline outline(rectangle_vertices(3, 0.5));
    const double scale = std::sqrt(1.5 / M_PI);
    EXPECT_NEAR(outline.scale(), scale, round_off);
    EXPECT_LE((outline.centroid() - Vec<2>(1.5, 0.25)).norm(), round_off);
    EXPECT_NEAR(outline.moments().covariance()(0, 0), 9.0 / 12 / scale / scale, round_off);
    EXPECT_NEAR(outline.moments().covariance()(1, 1), 0.25 / 12 / scale / scale, round_off);
    EXPECT_NEAR(outline.moments().covariance()(0, 1), 0, round_off);
}

TEST(PolygonOutline, TurnsClockwiseVerticesRound)
{
    for (auto [name, vertices] : polygons()) {
        const PolygonOutline as_given(vertices);
        std::reverse(vertices.begin(), vertices.end());
        const PolygonOutline reversed(vertices);
        EXPECT_LE(difference(as_given.moments(), reversed.moments()), round_off) << name;
    }
}

TEST(PolygonOutline, FarFromTheOriginLosesNoDigitsButTheCoordinates)
{
    for (auto [name, vertices] : polygons()) {
        const Moments<2> near = PolygonOutline(vertices).moments();
        for (auto& vertex : vertices)
            vertex += Vec<2>(1e6, -3e6);
        // coordinates of 3e6 are rounded to 2e-10
        EXPECT_LE(difference(PolygonOutline(vertices).moments(), near), 1e-8) << name;
    }
}

TEST(PolygonOutline, PartsInBoxesAgreeWithTrianglesCutToTheBox)
{
    Random random(1);
    for (const auto& [name, vertices] : polygons()) {
        const PolygonOutline outline(vertices);
        const double size = outline.bounds().max.norm() + outline.bounds().min.norm();
        EXPECT_LE(difference(outline.moments(), oracle_moments(outline.vertices(), around(size))), round_off) << name;
        for (int trial = 0; trial < 200; ++trial) {
            const Vec<2> a = random.vector<2>(size / 2), b = random.vector<2>(size / 2);
            const Box<2> box { a.cwiseMin(b), a.cwiseMax(b) };
            EXPECT_LE(difference(outline.moments(box), oracle_moments(outline.vertices(), box)), round_off) << name;
        }
    }
}

TEST(PolygonOutline, BoxesThroughVerticesAndEdgesAgreeToo)
{
    for (const auto& [name, vertices] : polygons()) {
        const PolygonOutline outline(vertices);
        for (const auto& a : outline.vertices())
            for (const auto& b : outline.vertices()) {
                const Box<2> box { a.cwiseMin(b), a.cwiseMax(b) };
                if ((box.max - box.min).minCoeff() == 0) continue;
                EXPECT_LE(difference(outline.moments(box), oracle_moments(outline.vertices(), box)), round_off) << name;
            }
    }
}

TEST(PolygonOutline, TilingAddsUpToTheWhole)
{
    Random random(2);
    for (const auto& [name, vertices] : polygons()) {
        const PolygonOutline outline(vertices);
        const Box<2> bounds = outline.bounds();
        for (int across : { 1, 2, 7, 20 }) {
            const Vec<2> step = (bounds.max - bounds.min) / across, shift = random.vector<2>(0.5).cwiseProduct(step);
            Moments<2> sum;
            for (int i = -1; i <= across; ++i)
                for (int j = -1; j <= across; ++j) {
                    const Vec<2> corner = bounds.min + shift + Vec<2>(i, j).cwiseProduct(step);
                    sum += outline.moments({ corner, bounds.min + shift + Vec<2>(i + 1, j + 1).cwiseProduct(step) });
                }
            EXPECT_LE(difference(sum, outline.moments()), round_off) << name << " " << across;
        }
    }
}

TEST(PolygonOutline, BoundsHoldTheVerticesTightly)
{
    for (const auto& [name, vertices] : polygons()) {
        const PolygonOutline outline(vertices);
        Vec<2> lo = outline.vertices()[0], hi = lo;
        for (const auto& v : outline.vertices()) {
            lo = lo.cwiseMin(v);
            hi = hi.cwiseMax(v);
        }
        EXPECT_EQ(outline.bounds().min, lo) << name;
        EXPECT_EQ(outline.bounds().max, hi) << name;
    }
}

TEST(PolygonOutline, SamplesItsEdgesFromVertexToVertex)
{
    for (const auto& [name, vertices] : polygons())
        for (double spacing : { 5.0, 0.3, 0.07 }) {
            const PolygonOutline outline(vertices);
            const auto points = outline.sample(spacing);
            double weights = 0, length = 0, perimeter = 0;
            for (size_t i = 0; i < points.size(); ++i) {
                const double apart = (points[(i + 1) % points.size()].position - points[i].position).norm();
                const double before = (points[(i + points.size() - 1) % points.size()].position - points[i].position).norm();
                EXPECT_GT(apart, 0) << name;
                EXPECT_LE(apart, spacing * (1 + 1e-9)) << name;
                EXPECT_NEAR(points[i].weight, (apart + before) / 2, round_off) << name;
                weights += points[i].weight;
                length += apart;
            }
            size_t at = 0; // vertices are among the points, in order
            for (size_t i = 0; i < outline.vertices().size(); ++i) {
                perimeter += (outline.vertices()[(i + 1) % outline.vertices().size()] - outline.vertices()[i]).norm();
                while (at < points.size() && points[at].position != outline.vertices()[i])
                    ++at;
            }
            EXPECT_LT(at, points.size()) << name;
            EXPECT_NEAR(length, perimeter, round_off * 10) << name;
            EXPECT_NEAR(weights, perimeter, round_off * 10) << name;
        }
}

TEST(PolygonOutline, MarksSharpConvexCornersOnly)
{
    const auto corners = [](const std::vector<Vec<2>>& vertices) {
        int count = 0;
        for (const auto& point : PolygonOutline(vertices).sample(0.2))
            count += point.corner;
        return count;
    };
    EXPECT_EQ(corners(rectangle_vertices(2, 1)), 4);
    EXPECT_EQ(corners(polar(6, [](double) { return 1.0; })), 6);  // turns of 60 degrees
    EXPECT_EQ(corners(polar(24, [](double) { return 1.0; })), 0); // turns of 15 degrees: a smooth curve
    EXPECT_EQ(corners({ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }), 5); // one re-entrant corner
}

/// The message of the UserError, or "" when the outline is taken.
std::string objection(const std::vector<Vec<2>>& vertices)
{
    try {
        PolygonOutline outline(vertices);
    } catch (const UserError& error) {
        return error.what();
    }
    return "";
}

/// One sentence that holds the words.
void expect_sentence(const std::string& message, const std::vector<std::string>& words)
{
    ASSERT_FALSE(message.empty()) << "the outline was taken";
    EXPECT_EQ(message.back(), '.') << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    for (const auto& word : words)
        EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is missing in: " << message;
}

TEST(PolygonOutlineErrors, NameTheNumberOfVertices)
{
    expect_sentence(objection({}), { "0 vertices", "at least 3" });
    expect_sentence(objection({ { 0, 0 }, { 1, 0 } }), { "2 vertices", "at least 3" });
}

TEST(PolygonOutlineErrors, NameTheVertexThatIsNotFinite)
{
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    expect_sentence(objection({ { 0, 0 }, { 1, nan }, { 0, 1 } }), { "vertex 1", "not finite" });
    expect_sentence(objection({ { 0, 0 }, { 1, 0 }, { -inf, 1 } }), { "vertex 2", "not finite" });
}

TEST(PolygonOutlineErrors, NameTheEdgesThatCross)
{
    expect_sentence(objection({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }), { "vertices 0 and 2", "cross", "order" });
    // a pentagram
    std::vector<Vec<2>> star;
    for (int i = 0; i < 5; ++i)
        star.push_back(Vec<2>(std::cos(4 * M_PI * i / 5), std::sin(4 * M_PI * i / 5)));
    expect_sentence(objection(star), { "cross" });
}

TEST(PolygonOutlineErrors, SayThatThereIsNoArea)
{
    expect_sentence(objection({ { 0, 0 }, { 1, 1 }, { 2, 2 } }), { "no area" });
    expect_sentence(objection({ { 1, 1 }, { 1, 1 }, { 1, 1 } }), { "no area" });
}

// A polygon that touches or repeats itself is not simple: its boundary has no inside and outside there.
TEST(PolygonOutlineErrors, RefuseVerticesThatRepeat)
{
    EXPECT_NE(objection({ { 0, 0 }, { 1, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } }), "") << "one vertex after the other";
    EXPECT_NE(objection({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } }), "") << "the first given again as the last";
}

TEST(PolygonOutlineErrors, RefuseEdgesThatCrossAtAVertex)
{
    EXPECT_NE(objection({ { 0, 0 }, { 2, 2 }, { 3, 0 }, { 1, 1 }, { 0, 2 } }), "");
}

TEST(PolygonOutlineErrors, LetSimplePolygonsPass)
{
    for (const auto& [name, vertices] : polygons())
        EXPECT_EQ(objection(vertices), "") << name;
}

} // namespace
