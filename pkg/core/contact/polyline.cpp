// SPDX-License-Identifier: GPL-2.0-or-later
#include "contact/polyline.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    /// Turned by -90 degrees: outward from a counter-clockwise boundary.
    Vec<2> outward(const Vec<2>& along) { return Vec<2>(along.y(), -along.x()); }

    /// The cubic over one segment.
    struct Segment {
        std::array<int, 4> vertex;              ///< the one before, the two ends, the one after
        std::array<double, 4> start {}, end {}; ///< weights of the vertices in the tangents at the ends
        Vec<2> x[4];
        Vec<2> a, b, c; ///< x(t) = x[1] + c t + b t^2 + a t^3

        Segment(const Surface<2>& polyline, int index)
        {
            const int n = polyline.count;
            const int next = index + 1 == n ? 0 : index + 1;
            vertex = { index == 0 ? n - 1 : index - 1, index, next, next + 1 == n ? 0 : next + 1 };
            for (int k = 0; k < 4; ++k)
                x[k] = polyline.x(vertex[k]);
            const bool sharp_start = polyline.corner[index], sharp_end = polyline.corner[next];
            start = sharp_start
                ? (sharp_end ? std::array<double, 4> { 0, -1, 1, 0 } : std::array<double, 4> { 0, -1.5, 2, -0.5 })
                : std::array<double, 4> { -0.5, 0, 0.5, 0 };
            end = sharp_end
                ? (sharp_start ? std::array<double, 4> { 0, -1, 1, 0 } : std::array<double, 4> { 0.5, -2, 1.5, 0 })
                : std::array<double, 4> { 0, -0.5, 0, 0.5 };
            Vec<2> last = Vec<2>::Zero();
            c = Vec<2>::Zero();
            for (int k = 0; k < 4; ++k) {
                c += start[k] * x[k];
                last += end[k] * x[k];
            }
            const Vec<2> chord = x[2] - x[1];
            b = 3 * chord - 2 * c - last;
            a = c + last - 2 * chord;
        }

        /// Where a foot is looked for first: that on the chord.
        double first(const Vec<2>& p) const
        {
            const Vec<2> chord = x[2] - x[1];
            return std::clamp((p - x[1]).dot(chord) / chord.squaredNorm(), 0.0, 1.0);
        }
        Vec<2> at(double t) const { return x[1] + t * (c + t * (b + t * a)); }
        Vec<2> tangent(double t) const { return c + t * (2 * b + t * 3 * a); }
        Vec<2> second(double t) const { return 2 * b + 6 * t * a; }
        /// A Newton step towards the foot of p, (p - x(t)) . x'(t) = 0.
        double step(const Vec<2>& p, double t) const
        {
            const Vec<2> apart = p - at(t), along = tangent(t);
            const double slope = along.squaredNorm() - apart.dot(second(t));
            // beyond the centre of curvature the foot is far away; the chord's slope brings it near
            return apart.dot(along) / std::max(slope, 0.2 * along.squaredNorm());
        }
        std::array<double, 4> weights(double t) const
        {
            const double h10 = t * (1 - t) * (1 - t), h11 = -t * t * (1 - t), h01 = t * t * (3 - 2 * t);
            std::array<double, 4> weight;
            for (int k = 0; k < 4; ++k)
                weight[k] = h10 * start[k] + h11 * end[k];
            weight[1] += 1 - h01;
            weight[2] += h01;
            return weight;
        }
        /// Change of the weights with t.
        std::array<double, 4> slope(double t) const
        {
            const double h10 = (1 - t) * (1 - 3 * t), h11 = t * (3 * t - 2), h01 = 6 * t * (1 - t);
            std::array<double, 4> slope;
            for (int k = 0; k < 4; ++k)
                slope[k] = h10 * start[k] + h11 * end[k];
            slope[1] -= h01;
            slope[2] += h01;
            return slope;
        }
    };

    /// Whether the chords of two segments cross each other.
    bool cross(const Surface<2>& polyline, int first, int second)
    {
        const int n = polyline.count;
        const Vec<2> a = polyline.x(first), b = polyline.x((first + 1) % n), c = polyline.x(second),
                     d = polyline.x((second + 1) % n);
        if ((c.cwiseMax(d).array() < a.cwiseMin(b).array()).any() || (c.cwiseMin(d).array() > a.cwiseMax(b).array()).any())
            return false;
        const auto side = [](const Vec<2>& from, const Vec<2>& to, const Vec<2>& x) {
            return (to.x() - from.x()) * (x.y() - from.y()) - (to.y() - from.y()) * (x.x() - from.x());
        };
        return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
    }

} // namespace

Bend bend_at(const Surface<2>& polyline, int segment, double t)
{
    const Segment here(polyline, segment);
    const Vec<2> along = here.tangent(t);
    const double length = along.norm();
    return { here.slope(t), length, outward(along).dot(here.second(t)) / length };
}

bool crosses_itself(const Surface<2>& polyline)
{
    const int n = polyline.count;
    for (int i = 0; i + 2 < n; ++i)
        for (int j = i + 2; j < n - (i == 0); ++j) // neighbours share a vertex
            if (cross(polyline, i, j)) return true;
    return false;
}

bool covers_itself(const Surface<2>& polyline, double depth)
{
    const int n = polyline.count;
    for (int p = 0; p < n; ++p) {
        if (cross(polyline, p, (p + 2) % n) || cross(polyline, p, (p + 3) % n)) return true;
        const Vec<2> x = polyline.x(p) - depth * outward(polyline.x((p + 1) % n) - polyline.x((p + n - 1) % n)).normalized();
        int winding = 0; // upward edges right of x, less downward ones
        for (int i = 0; i < n; ++i) {
            const Vec<2> a = polyline.x(i) - x, b = polyline.x((i + 1) % n) - x;
            if ((a.y() > 0) == (b.y() > 0)) continue;
            const double turn = a.x() * b.y() - a.y() * b.x();
            if (b.y() > 0 ? turn > 0 : turn < 0) winding += b.y() > 0 ? 1 : -1;
        }
        if (winding > 1) return true;
    }
    return false;
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

bool face_each_other(const Surface<2>& polyline, int vertex, int segment, const Vec<2>& place, const Vec<2>& normal,
                     double depth)
{
    const int n = polyline.count, along = (vertex - segment + n) % n;
    if (along <= 2 || along == n - 1) return false;
    const Vec<2> x = polyline.x(vertex), across = place - x;
    if (across.dot(normal) > depth) return false;
    for (const Vec<2>& edge : { Vec<2>(x - polyline.x((vertex + n - 1) % n)), Vec<2>(polyline.x((vertex + 1) % n) - x) }) {
        const Vec<2> own = outward(edge).normalized();
        if (own.dot(normal) < 0 && across.dot(own) > -depth) return true;
    }
    return false;
}

int faced_segment(const Surface<2>& polyline, int vertex, double depth)
{
    const Vec<2> x = polyline.x(vertex);
    int best = -1;
    double least = 1e300;
    for (int i = 0; i < polyline.count; ++i) {
        const Vec<2> start = polyline.x(i), chord = polyline.x(i + 1 == polyline.count ? 0 : i + 1) - start;
        const Vec<2> place = start + std::clamp((x - start).dot(chord) / chord.squaredNorm(), 0.0, 1.0) * chord;
        const double distance = (x - place).squaredNorm();
        if (distance >= least || !face_each_other(polyline, vertex, i, place, outward(chord).normalized(), depth)) continue;
        least = distance;
        best = i;
    }
    return best;
}

Projection project(const Surface<2>& polyline, const Vec<2>& x, int segment)
{
    constexpr int most_steps = 20;
    constexpr double tolerance = 1e-5; // of the last step: the place is off by its square
    const int n = polyline.count;
    int last_move = 0;
    for (int walked = 0; walked <= n; ++walked) {
        const Segment here(polyline, segment);
        double t = here.first(x);
        int move = 0;
        for (int k = 0; k < most_steps; ++k) {
            const double step = here.step(x, t);
            t += step;
            move = t < 0 ? -1 : t > 1 ? 1 : 0;
            t = std::clamp(t, 0.0, 1.0);
            // out of the segment for good when a step from its end leads out again
            if (move != 0 && (move > 0 ? here.step(x, t) > 0 : here.step(x, t) < 0)) break;
            move = 0;
            if (std::abs(step) < tolerance) break;
        }
        if (move == 0 || (move * last_move < 0 && !polyline.corner[move < 0 ? segment : (segment + 1) % n])) {
            const Vec<2> normal = outward(here.tangent(t)).normalized();
            return { segment, t, here.vertex, here.weights(t), normal, normal.dot(x - here.at(t)) };
        }
        if (move * last_move < 0) break; // between two segments: the vertex of a corner
        last_move = move;
        segment = (segment + move + n) % n;
    }
    const int vertex = last_move < 0 ? (segment + 1) % n : segment;
    const Segment before(polyline, (vertex + n - 1) % n), after(polyline, vertex);
    const Vec<2> normal = outward(before.tangent(1).normalized() + after.tangent(0).normalized()).normalized();
    return { vertex, 0, after.vertex, { 0, 1, 0, 0 }, normal, normal.dot(x - after.x[1]) };
}

} // namespace softgrain
