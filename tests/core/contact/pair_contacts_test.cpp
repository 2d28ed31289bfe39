// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/support.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <map>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

struct Key {
    bool on_second;
    int point;
    bool operator<(const Key& other) const { return std::tie(on_second, point) < std::tie(other.on_second, other.point); }
};

/// Projections from every start, those next to the nearest of their feet: one where the boundary is smooth, one for
/// each face inside of a corner.
std::vector<Projection> projections(const Surface<2>& surface, const Vec<2>& x)
{
    std::vector<Projection> all;
    double least = 1e300;
    Vec<2> nearest = Vec<2>::Zero();
    for (int start = 0; start < surface.count; ++start) {
        all.push_back(project(surface, x, start));
        const Vec<2> foot = foot_of(surface, all.back());
        if ((x - foot).norm() >= least) continue;
        least = (x - foot).norm();
        nearest = foot;
    }
    std::vector<Projection> near;
    for (const auto& at : all)
        if ((foot_of(surface, at) - nearest).norm() < 0.1 * surface.size) near.push_back(at);
    return near;
}

/// All points of either body against the other boundary; those of the larger one may enter a little.
std::map<Key, std::vector<Projection>> brute_force(const Surface<2>& first, const Surface<2>& second)
{
    const bool second_smaller = second.size < first.size;
    std::map<Key, std::vector<Projection>> found;
    for (bool on_second : { false, true }) {
        const Surface<2>&mine = on_second ? second : first, &other = on_second ? first : second;
        for (int p = 0; p < mine.count; ++p)
            for (Projection at : projections(other, mine.x(p))) {
                if (on_second != second_smaller) at.gap += allowance(mine, p, other);
                found[{ on_second, p }].push_back(at);
            }
    }
    return found;
}

/// Of a disc of that radius about (0, y), points at odd multiples of half their angle from the lowest place.
Surface<2> coarse_disc(double radius, double y)
{
    std::vector<Vec<2>> vertices;
    for (int k = 0; k < 14; ++k) {
        const double angle = -M_PI / 2 + (k + 0.5) * 2 * M_PI / 14;
        vertices.push_back({ radius * std::cos(angle), y + radius * std::sin(angle) });
    }
    return surface_of(vertices);
}

/// A strip of a tenth of its way as thickness, wound up one and a half times with twice as much room between.
std::vector<Vec<2>> spiral()
{
    std::vector<Vec<2>> vertices;
    const auto along = [&](double angle, double out) {
        const double radius = 0.6 + 0.3 * angle / (2 * M_PI) + out;
        vertices.push_back(radius * Vec<2>(std::cos(angle), std::sin(angle)));
    };
    for (int k = 0; k <= 60; ++k)
        along(k * M_PI / 20, 0.1);
    for (int k = 60; k >= 0; --k)
        along(k * M_PI / 20, 0);
    return vertices;
}

/// Times that a closed polyline goes around x.
int winding(const Surface<2>& surface, const Vec<2>& x)
{
    double angle = 0;
    for (int i = 0; i < surface.count; ++i) {
        const Vec<2> a = surface.x(i) - x, b = surface.x((i + 1) % surface.count) - x;
        angle += std::atan2(cross(a, b), a.dot(b));
    }
    return int(std::lround(angle / (2 * M_PI)));
}

// Points of one side of a thin wall stand off the other side by its thickness, through the material: these are no contacts.
TEST(PairContacts, OfAGrainWithItselfLieAcrossTheOpen)
{
    auto shapes = polygons();
    shapes.push_back({ "spiral", spiral() });
    for (const auto& [name, vertices] : shapes) {
        const PolygonOutline outline(vertices);
        const Surface<2> surface = surface_of(outline, 0.07);
        PairContacts<2> pair;
        pair.look(surface, surface, 0.8);
        for (const auto& contact : pair.points) {
            Vec<2> foot = Vec<2>::Zero();
            for (int k = 0; k < 4; ++k)
                foot += contact.weight[k] * surface.x(contact.vertex[k]);
            const Vec<2> x = surface.x(contact.point);
            EXPECT_GT(contact.gap, 0) << name;
            EXPECT_EQ(contact.on_second, contact.point < contact.face) << name;
            for (double share : { 0.1, 0.5, 0.9 })
                EXPECT_EQ(winding(surface, x + share * (foot - x)), 0) << name << ", point " << contact.point;
        }
        std::printf("%s: %d contact points\n", name.c_str(), int(pair.points.size()));
        EXPECT_EQ(pair.points.empty(), name != "U" && name != "spiral") << name;
    }
}

// A U whose arms have come together by a little more than the way between them, and by more than a quarter of the points' distance.
TEST(PairContacts, OfAGrainWithItselfLetPassLittle)
{
    for (const auto& [depth, deep] : { std::pair(0.003, false), std::pair(0.3, true) }) {
        const PolygonOutline u(polygons()[6].second);
        Surface<2> surface = surface_of(u, 0.1);
        EXPECT_FALSE(is_folded(surface, false));
        const double inner = 0.5 / u.scale();
        for (int p = 0; p < surface.count; ++p) {
            const double x = surface.x(p).x(), up = std::max(0.0, surface.x(p).y() + 0.2); // arms bend inwards
            surface.position[2 * p] -= (x > 0 ? 1 : -1) * (inner + depth) * std::min(1.0, 2 * up);
        }
        EXPECT_TRUE(is_folded(surface, false));
        EXPECT_EQ(is_folded(surface, true), deep);
    }
}

// Between its lowest points the disc reaches down to -1, its points to -cos(pi / 14) = -0.975.
TEST(PairContacts, SeeTheOutlineThatReachesOutOfTheBoxOfItsPoints)
{
    const auto large = coarse_disc(1, 0), small = coarse_disc(0.05, -1.03);
    PairContacts<2> pair;
    pair.update(large, small, 1e-9);
    ASSERT_FALSE(pair.points.empty());
    EXPECT_LT(pair.points[0].gap, 0);
}

/// Returns the number of contacts that there have to be.
int compare(const PairContacts<2>& pair, const Surface<2>& first, const Surface<2>& second, double dt)
{
    const bool second_smaller = second.size < first.size;
    const double near = reach(second_smaller ? second : first, (second_smaller ? first : second).speed, dt);
    auto contact = pair.points.begin();
    int count = 0;
    for (const auto& [key, all] : brute_force(first, second)) {
        const bool there
            = contact != pair.points.end() && contact->on_second == key.on_second && contact->point == key.point;
        const bool must = std::all_of(all.begin(), all.end(), [&](const Projection& at) { return at.gap < near; });
        const bool may = std::any_of(all.begin(), all.end(), [&](const Projection& at) { return at.gap < near; });
        count += must;
        if (must) {
            EXPECT_TRUE(there) << "point " << key.point << " with gap " << all[0].gap << " within reach " << near;
        }
        if (!there) continue;
        EXPECT_TRUE(may) << "point " << key.point << " with gap " << all[0].gap << " beyond reach " << near;
        const auto same = std::find_if(all.begin(), all.end(), [&](const Projection& at) {
            return std::abs(at.gap - contact->gap) < 1e-13 && (at.normal - contact->normal).norm() < 1e-7;
        });
        EXPECT_NE(same, all.end()) << "gap " << contact->gap << " against " << all[0].gap;
        // the face's vertices and weights give the foot
        const Surface<2>& other = key.on_second ? first : second;
        if (same != all.end()) {
            const Projection named { 0, 0, contact->vertex, contact->weight, {}, 0 };
            EXPECT_LE((foot_of(other, *same) - foot_of(other, named)).norm(), 1e-7);
        }
        EXPECT_EQ(contact->face, contact->vertex[1]);
        ++contact;
    }
    EXPECT_EQ(contact, pair.points.end()) << "a contact twice, out of order or on a point that makes none";
    return count;
}

/// Two bodies tumble about each other, mostly in touch. Lists kept over the steps have to give what a fresh look at
/// everything gives. Speeds are kept at a constant bound, or jump to a small part of it and back from time to time.
void tumble(Surface<2> first, Surface<2> second, double step, bool jumps, unsigned seed)
{
    Random random(seed);
    const double dt = 1e-3;
    PairContacts<2> pair;
    move(second, Vec<2>(first.max.x() - second.min.x() + 0.1, 0.2), 0, dt);
    int touches = 0, only_near = 0, apart = 0;
    double factor = 1;
    Vec<2> drift = Vec<2>::Zero();
    for (int k = 0; k < 4000; ++k) {
        if (k % 50 == 0) {
            factor = jumps && random.integer(0, 1) ? 0.02 : 1;
            const Vec<2> apart = (second.min + second.max - first.min - first.max) / 2;
            drift = (pair.points.empty() ? Vec<2>(apart.normalized()) : random.unit<2>()) * 0.5;
        }
        for (const auto& contact : pair.points) // apart again when deep
            if (contact.gap < -0.01) drift = (contact.on_second ? -0.5 : 0.5) * contact.normal;
        for (Surface<2>* body : { &first, &second }) {
            const double travel = body->travel;
            const Vec<2> shift = (body == &first ? 1 : -1) * drift + random.vector<2>(0.2);
            move(*body, factor * step * shift, factor * step * random.uniform(-0.2, 0.2), dt);
            if (jumps) continue;
            ASSERT_LE(body->speed * dt, 1.5 * step);
            body->speed = 1.5 * step / dt;
            body->travel = travel + 1.5 * step;
        }
        if (pair.apart(first, second, dt))
            ++apart;
        else
            pair.update(first, second, dt);
        const int contacts = compare(pair, first, second, dt);
        if (::testing::Test::HasFailure()) FAIL() << "in step " << k;
        touches += contacts > 0;
        only_near += contacts == 0 && pair.near();
    }
    EXPECT_GT(touches, 200);
    EXPECT_GT(only_near, 50);
    EXPECT_GT(apart, 50);
}

const DiscOutline disc;

TEST(PairContacts, ListsGiveWhatBruteForceGivesForDiscs)
{
    tumble(surface_of(disc, 0.2), surface_of(disc, 0.15, 0.7), 4e-3, false, 1);
    tumble(surface_of(disc, 0.2, 0.5), surface_of(disc, 0.3, 2), 4e-3, false, 2);
}

TEST(PairContacts, ListsGiveWhatBruteForceGivesForEllipses)
{
    const PolygonOutline ellipse(ellipse_vertices(60, 1.5, 1));
    tumble(surface_of(ellipse, 0.2), surface_of(ellipse, 0.2, 0.8), 4e-3, false, 3);
}

TEST(PairContacts, ListsGiveWhatBruteForceGivesWithCorners)
{
    const PolygonOutline hexagon(polar(6, [](double) { return 1.0; }));
    tumble(surface_of(disc, 0.2, 0.8), surface_of(hexagon, 0.2), 4e-3, false, 4);
    tumble(surface_of(hexagon, 0.2), surface_of(hexagon, 0.15, 0.7), 4e-3, false, 5);
}

// The reach grows with the speed: a list made when the bodies were slow must not be used when they are fast.
TEST(PairContacts, ListsHoldWhenSpeedsJump) { tumble(surface_of(disc, 0.2), surface_of(disc, 0.15, 0.7), 2e-2, true, 6); }

/// Two discs, the second to the right of the first, with a gap between their boundaries.
struct Facing {
    Surface<2> first = surface_of(polar(33, [](double) { return 1.0; })),
               second = surface_of(polar(44, [](double) { return 0.7; }));
    PairContacts<2> pair;
    explicit Facing(double gap) { move(second, Vec<2>(1.7 + gap, 0), 0, 1); }
    void rest() { first.speed = second.speed = first.travel = second.travel = 0; }
};

TEST(PairContacts, StartAtTheReachAndAreGoneBeyond)
{
    for (double gap : { 2e-4, -1e-3, 0.05, 3.0 }) {
        Facing facing(gap);
        facing.rest();
        const double near = reach(facing.second, 0, 1e-3);
        EXPECT_DOUBLE_EQ(near, 1e-4 * 0.7);
        facing.pair.update(facing.first, facing.second, 1e-3);
        EXPECT_EQ(facing.pair.points.empty(), gap > near) << gap;
        EXPECT_EQ(facing.pair.near(), gap < 1) << gap;
    }
}

TEST(PairContacts, ReachTakesInWhatBothBodiesCloseInAStep)
{
    Facing facing(0.03);
    facing.rest();
    facing.first.speed = 10; // 0.01 in a step of 1e-3, and as much again for safety
    facing.pair.update(facing.first, facing.second, 1e-3);
    EXPECT_TRUE(facing.pair.points.empty());
    facing.second.speed = 10;
    PairContacts<2> fresh;
    fresh.update(facing.first, facing.second, 1e-3);
    EXPECT_FALSE(fresh.points.empty());
}

TEST(PairContacts, DoNotDependOnWhichBodyComesFirst)
{
    Facing facing(-5e-3);
    facing.rest();
    PairContacts<2> swapped;
    facing.pair.update(facing.first, facing.second, 1e-3);
    swapped.update(facing.second, facing.first, 1e-3);
    ASSERT_EQ(facing.pair.points.size(), swapped.points.size());
    ASSERT_FALSE(swapped.points.empty());
    for (size_t k = 0; k < swapped.points.size(); ++k) {
        const auto &a = facing.pair.points[k], &b = swapped.points[k];
        EXPECT_EQ(a.point, b.point);
        EXPECT_NE(a.on_second, b.on_second);
        EXPECT_EQ(a.gap, b.gap);
        EXPECT_EQ(a.normal, b.normal);
        EXPECT_TRUE(a.on_second) << "points are on the smaller body";
        EXPECT_GT(a.normal.x(), 0.9) << "from the face to the point";
    }
}

TEST(PairContacts, CarryForcesToTheSamePoints)
{
    Facing facing(-2e-2);
    facing.rest();
    facing.pair.update(facing.first, facing.second, 1e-3);
    std::map<int, Vec<2>> force;
    for (auto& contact : facing.pair.points) {
        EXPECT_EQ(contact.force, (Vec<2>::Zero()));
        contact.force = force[contact.point] = Vec<2>(contact.point + 1, -2);
    }
    ASSERT_GE(force.size(), 2u);
    move(facing.second, Vec<2>(-3e-2, 0), 0.02, 1e-3);
    facing.pair.update(facing.first, facing.second, 1e-3);
    int kept = 0, fresh = 0;
    for (const auto& contact : facing.pair.points) {
        const auto old = force.find(contact.point);
        EXPECT_EQ(contact.force, old == force.end() ? Vec<2>(Vec<2>::Zero()) : old->second);
        (old == force.end() ? fresh : kept)++;
    }
    EXPECT_EQ(kept, int(force.size()));
    EXPECT_GT(fresh, 0);
}

TEST(PairContacts, FindTheCornerOfALargerBodyBetweenTheSmallerOnesPoints)
{
    const PolygonOutline square(rectangle_vertices(1, 1));
    constexpr int count = 16; // the diagonal passes through points of the disc; turned by half an angle, between them
    Surface<2> large = surface_of(square, 0.2, 2), small = surface_of(polar(count, [](double) { return 0.6; }));
    const Vec<2> tip = 2 * Vec<2>(square.bounds().max);
    move(small, tip + 0.599 * Vec<2>(1, 1).normalized(), M_PI / count, 1);
    for (Surface<2>* s : { &large, &small })
        s->speed = s->travel = 0;
    PairContacts<2> pair;
    pair.update(small, large, 1e-3);
    ASSERT_EQ(pair.points.size(), 1u);
    const auto& contact = pair.points[0];
    EXPECT_TRUE(contact.on_second);
    EXPECT_LE((large.x(contact.point) - tip).norm(), 1e-12);
    EXPECT_NEAR(contact.gap, -1e-3, 0.6 * std::pow(2 * M_PI / count, 4) * 9 / 384 * 1.05); // see GapOfASampledCircle
    EXPECT_LE((contact.normal + Vec<2>(1, 1).normalized()).norm(), 1e-9);
}

// Between two points of the smaller disc a point of the larger one enters, but by no more than the allowance: the gap counts
// from there.
TEST(PairContacts, LetPointsOfTheLargerBodyEnterOnlySoFar)
{
    for (double depth : { 0.02, 0.04 }) {
        Facing facing(-depth);
        move(facing.second, Vec<2>(0, 0), M_PI / 44, 1);
        facing.rest();
        facing.pair.update(facing.first, facing.second, 1e-3);
        const double allowed = allowance(facing.first, 0, facing.second);
        EXPECT_NEAR(allowed, 0.7 * 2 * M_PI / 44 / 4, 1e-3);
        const auto found = std::find_if(facing.pair.points.begin(), facing.pair.points.end(),
                                        [](const auto& c) { return !c.on_second && c.point == 0; });
        ASSERT_EQ(found != facing.pair.points.end(), depth > allowed);
        if (depth < allowed) continue;
        EXPECT_NEAR(found->gap, allowed - depth, 1e-4);
        EXPECT_LE((found->normal - Vec<2>(-1, 0)).norm(), 1e-3);
    }
}

// Points of a soft grain meet the faces of a rigid body, whichever is larger.
TEST(PairContacts, ShowTheFacesOfRigidBodies)
{
    for (double size : { 0.3, 3.0 }) {
        Surface<2> plate = surface_of(PolygonOutline(rectangle_vertices(4, 1)), 10, size),
                   ball = surface_of(polar(64, [](double) { return 1.0; }));
        plate.mobility = 0;
        move(ball, Vec<2>(0, plate.max.y() + 0.999), 0, 1);
        ball.speed = ball.travel = 0;
        PairContacts<2> one, two;
        one.update(ball, plate, 1e-3);
        two.update(plate, ball, 1e-3);
        ASSERT_EQ(one.points.size(), 1u) << size;
        ASSERT_EQ(two.points.size(), 1u) << size;
        EXPECT_FALSE(one.points[0].on_second);
        EXPECT_TRUE(two.points[0].on_second);
        EXPECT_NEAR(one.points[0].gap, -1e-3, 1e-13);
        EXPECT_LE((one.points[0].normal - Vec<2>(0, 1)).norm(), 1e-13);
    }
}

// A disc that comes near a face of a wedge, next to its sharp tip, is not inside of the wedge.
TEST(PairContacts, SeeTheNearerFaceAtAnAcuteCorner)
{
    const PolygonOutline wedge({ { 0, 0 }, { 3, 0 }, { 3, 1 } });
    const Surface<2> surface = surface_of(wedge, 0.15);
    const Vec<2> tip = wedge.vertices()[0];
    for (int other : { 1, 2 }) {
        const Vec<2> along = (wedge.vertices()[other] - tip).normalized();
        const Vec<2> out = (other == 1 ? 1 : -1) * Vec<2>(along.y(), -along.x());
        for (double place = 0.01; place < 0.3; place += 0.01) {
            Surface<2> ball = surface_of(disc, 2 * M_PI / 64, 0.3);
            move(ball, tip + place * along + (0.3 + 2e-3) * out, 0, 1);
            ball.speed = ball.travel = 0;
            PairContacts<2> pair;
            pair.update(ball, surface, 1e-3);
            for (const auto& contact : pair.points)
                EXPECT_GE(contact.gap, 0) << "disc 0.002 off the face to vertex " << other << ", " << place
                                          << " from the tip";
        }
    }
}

} // namespace
