// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/polyline.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }
    /// Turned by -90 degrees: outward from a counter-clockwise boundary.
    Vec<2> outward(const Vec<2>& along) { return Vec<2>(along.y(), -along.x()); }

    /// One segment with the parabola over it.
    struct Segment {
        Vec<2> start, chord;
        Vec<2> normal_start, normal_end; ///< of the parabola, as long as the chord or so
        double rise;

        Segment(const Surface<2>& polyline, int index)
            : start(polyline.x(index))
            , chord(polyline.x(index + 1 == polyline.count ? 0 : index + 1) - start)
            , normal_start(outward(chord) - polyline.rise[index] * chord)
            , normal_end(outward(chord) + polyline.rise[index] * chord)
            , rise(polyline.rise[index])
        {
        }

        /// Root t of cross(x - start - t chord, n(t)) = 0, n linear between the end normals: of the two, the one that
        /// stays when the segment is straight.
        double foot(const Vec<2>& x) const
        {
            const Vec<2> q = x - start, turn = normal_end - normal_start;
            const double a = cross(q, normal_start), b = cross(q, turn) - cross(chord, normal_start), c = -cross(chord, turn);
            const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
            return -2 * a / (b + std::copysign(root, b));
        }
        Vec<2> normal(double t) const { return ((1 - t) * normal_start + t * normal_end).normalized(); }
        double gap(const Vec<2>& x, double t, const Vec<2>& n) const
        {
            return n.dot(x - start - t * chord) - rise * chord.norm() * t * (1 - t);
        }
    };

} // namespace

void follow_shape(Surface<2>& polyline, double share)
{
    const int n = polyline.count;
    // tangent of half the turn at a vertex, from the edges before and after it
    const auto half_turn = [&](int i) {
        if (polyline.corner[i]) return 0.0;
        const Vec<2> before = polyline.x(i) - polyline.x(i == 0 ? n - 1 : i - 1), after = polyline.x(i + 1 == n ? 0 : i + 1) - polyline.x(i);
        return cross(before, after) / ((before.squaredNorm() + after.squaredNorm()) / 2 + before.dot(after));
    };
    const double first = half_turn(0);
    double start = first;
    for (int i = 0; i < n; ++i) {
        const double end = i + 1 == n ? first : half_turn(i + 1);
        polyline.rise[i] += share * ((start + end) / 2 - polyline.rise[i]);
        start = end;
    }
}

int nearest_segment(const Surface<2>& polyline, const Vec<2>& x)
{
    int best = 0;
    double least = 1e300;
    for (int i = 0; i < polyline.count; ++i) {
        const Vec<2> start = polyline.x(i), chord = polyline.x(i + 1 == polyline.count ? 0 : i + 1) - start;
        const double t = std::clamp((x - start).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
        const double distance = (x - start - t * chord).squaredNorm();
        if (distance < least) {
            least = distance;
            best = i;
        }
    }
    return best;
}

Projection project(const Surface<2>& polyline, const Vec<2>& x, int hint)
{
    const int n = polyline.count;
    int segment = hint, last_move = 0;
    for (int walked = 0; walked <= n; ++walked) {
        const Segment here(polyline, segment);
        const double t = here.foot(x);
        const int move = t < 0 ? -1 : t > 1 ? 1 : 0;
        if (move == 0) {
            const Vec<2> normal = here.normal(t);
            return { segment, t, normal, here.gap(x, t, normal) };
        }
        if (move * last_move < 0) break; // between two segments: the vertex of a corner
        last_move = move;
        segment = (segment + move + n) % n;
    }
    const int vertex = last_move < 0 ? (segment + 1) % n : segment;
    const Segment before(polyline, (vertex + n - 1) % n), after(polyline, vertex);
    const Vec<2> normal = outward(before.chord.normalized() + after.chord.normalized()).normalized();
    return { vertex, 0, normal, normal.dot(x - after.start) };
}

} // namespace softgrain
