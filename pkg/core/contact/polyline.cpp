// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/polyline.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }
    /// Turned by -90 degrees: outward from a counter-clockwise boundary.
    Vec<2> outward(const Vec<2>& along) { return Vec<2>(along.y(), -along.x()); }

    struct Segment {
        Vec<2> start, chord;
        Vec<2> tangent_start, tangent_end; ///< of the smoothed boundary, as long as the chord or so

        Segment(const Surface<2>& polyline, int index)
        {
            const int n = polyline.count;
            const int before = index == 0 ? n - 1 : index - 1, end = index + 1 == n ? 0 : index + 1,
                      after = end + 1 == n ? 0 : end + 1;
            start = polyline.x(index);
            chord = polyline.x(end) - start;
            tangent_start = polyline.corner[index] ? chord : Vec<2>((polyline.x(end) - polyline.x(before)) / 2);
            tangent_end = polyline.corner[end] ? chord : Vec<2>((polyline.x(after) - start) / 2);
        }

        /// Root t of cross(x - start - t chord, n(t)) = 0, n linear between the end normals; Newton from the
        /// chord's own projection (the equation is quadratic with a small second-order term).
        double foot(const Vec<2>& x) const
        {
            const Vec<2> q = x - start, n0 = outward(tangent_start), turn = outward(tangent_end) - n0;
            const double a = cross(q, n0), b = cross(q, turn) - cross(chord, n0), c = -cross(chord, turn);
            double t = q.dot(chord) / chord.squaredNorm();
            for (int i = 0; i < 2; ++i) {
                const double slope = b + 2 * c * t;
                if (slope == 0) break;
                t -= (a + t * (b + c * t)) / slope;
            }
            return t;
        }

        /// Height of the smoothed boundary over the chord, outwards: the cubic with the end tangents.
        double bulge(double t) const
        {
            const double rise_start = cross(chord, tangent_start) / chord.dot(tangent_start),
                         rise_end = cross(chord, tangent_end) / chord.dot(tangent_end);
            return -chord.norm() * t * (1 - t) * (rise_start * (1 - t) - rise_end * t);
        }
    };

} // namespace

int nearest_vertex(const Surface<2>& polyline, const Vec<2>& x)
{
    int best = 0;
    double least = (polyline.x(0) - x).squaredNorm();
    for (int i = 1; i < polyline.count; ++i) {
        const double distance = (polyline.x(i) - x).squaredNorm();
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
            const Vec<2> normal = outward((1 - t) * here.tangent_start + t * here.tangent_end).normalized();
            return { segment, t, normal, normal.dot(x - here.start - t * here.chord) - here.bulge(t) };
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
