// SPDX-License-Identifier: GPL-2.0-or-later
// Boundaries as contact sees them, made by hand, and brute-force oracles.
#pragma once

#include "contact/narrow_phase.hpp"
#include "contact/polyline.hpp"
#include "support/shapes.hpp"

namespace softgrain::testing_support {

/// The boundary of a soft grain: a closed polyline, counter-clockwise, without corners.
inline Surface<2> surface_of(const std::vector<Vec<2>>& vertices)
{
    Surface<2> surface;
    surface.resize(int(vertices.size()));
    for (int i = 0; i < surface.count; ++i) {
        surface.position[2 * i] = vertices[i].x();
        surface.position[2 * i + 1] = vertices[i].y();
    }
    surface.bound();
    surface.size = 0.5 * (surface.max - surface.min).minCoeff();
    surface.mobility = 1;
    return surface;
}

/// A sampled outline, corners as the outline has them.
inline Surface<2> surface_of(const Outline<2>& outline, double spacing, double radius = 1)
{
    const auto points = outline.sample(spacing);
    std::vector<Vec<2>> vertices;
    for (const auto& point : points)
        vertices.push_back(radius * point.position);
    Surface<2> surface = surface_of(vertices);
    for (int i = 0; i < surface.count; ++i)
        surface.corner[i] = points[i].corner;
    surface.size = radius;
    return surface;
}

/// Moves a surface rigidly, as a step of the given length would.
inline void move(Surface<2>& surface, const Vec<2>& shift, double angle, double dt)
{
    const Vec<2> centre = (surface.min + surface.max) / 2;
    const Mat<2> Q = (Mat<2>() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
    double farthest = 0;
    for (int p = 0; p < surface.count; ++p) {
        const Vec<2> old = surface.x(p), fresh = centre + shift + Q * (old - centre);
        farthest = std::max(farthest, (fresh - old).norm());
        surface.position[2 * p] = fresh.x();
        surface.position[2 * p + 1] = fresh.y();
    }
    surface.bound();
    surface.speed = farthest / dt;
    surface.travel += farthest;
}

inline double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The outline through the vertices, finely: cubic over each segment, its tangents the mean of the chords at either end;
/// at a corner the tangent with which the third derivative vanishes.
inline std::vector<Vec<2>> smoothed(const Surface<2>& surface, int pieces)
{
    const int n = surface.count;
    const auto x = [&](int i) { return Vec<2>(surface.x((i + n) % n)); };
    const auto sharp = [&](int i) { return bool(surface.corner[(i + n) % n]); };
    std::vector<Vec<2>> curve;
    for (int i = 0; i < n; ++i) {
        const Vec<2> chord = x(i + 1) - x(i);
        Vec<2> start = (x(i + 1) - x(i - 1)) / 2, end = (x(i + 2) - x(i)) / 2;
        if (sharp(i) && sharp(i + 1))
            start = end = chord;
        else if (sharp(i))
            start = 2 * chord - end;
        else if (sharp(i + 1))
            end = 2 * chord - start;
        for (int k = 0; k < pieces; ++k) {
            const double t = double(k) / pieces;
            curve.push_back(x(i) + t * t * (3 - 2 * t) * chord + t * (1 - t) * (1 - t) * start - t * t * (1 - t) * end);
        }
    }
    return curve;
}

/// Where a projection says that its foot is.
inline Vec<2> foot_of(const Surface<2>& surface, const Projection& at)
{
    Vec<2> foot = Vec<2>::Zero();
    for (int k = 0; k < 4; ++k)
        foot += at.weight[k] * surface.x(at.vertex[k]);
    return foot;
}

/// Signed distance of x to a fine closed polyline: negative inside.
inline double brute_force_distance(const std::vector<Vec<2>>& curve, const Vec<2>& x)
{
    double nearest = 1e300, angle = 0;
    for (size_t i = 0; i < curve.size(); ++i) {
        const Vec<2> a = curve[i] - x, b = curve[(i + 1) % curve.size()] - x, chord = b - a;
        const double t = std::min(1.0, std::max(0.0, -a.dot(chord) / chord.squaredNorm()));
        nearest = std::min(nearest, (a + t * chord).norm());
        angle += std::atan2(cross(a, b), a.dot(b));
    }
    return angle > M_PI ? -nearest : nearest; // winding number
}

} // namespace softgrain::testing_support
