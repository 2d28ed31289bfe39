// SPDX-License-Identifier: GPL-2.0-or-later
// Boundaries as contact sees them, made by hand, and brute-force oracles.
#pragma once

#include "contact/narrow_phase.hpp"
#include "contact/polyline.hpp"
#include "support/shapes.hpp"

namespace softgrain::testing_support {

/// A closed polyline, counter-clockwise; sharp: every vertex is a corner.
inline Surface<2> surface_of(const std::vector<Vec<2>>& vertices, bool sharp = false)
{
    Surface<2> surface;
    surface.resize(int(vertices.size()));
    for (int i = 0; i < surface.count; ++i) {
        surface.position[2 * i] = vertices[i].x();
        surface.position[2 * i + 1] = vertices[i].y();
        surface.corner[i] = sharp;
    }
    surface.bound();
    surface.size = 0.5 * (surface.max - surface.min).minCoeff();
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

/// The smoothed boundary, finely: on each segment the cubic through its ends with the slopes of the tangents there,
/// at a smooth vertex the chord of its neighbours, at a corner the segment itself.
inline std::vector<Vec<2>> smoothed(const Surface<2>& surface, int pieces)
{
    const int n = surface.count;
    std::vector<Vec<2>> curve;
    for (int i = 0; i < n; ++i) {
        const int before = (i + n - 1) % n, end = (i + 1) % n, after = (i + 2) % n;
        const Vec<2> chord = surface.x(end) - surface.x(i), along = chord.normalized(), out(along.y(), -along.x());
        const auto slope = [&](const Vec<2>& tangent) { return tangent.dot(out) / tangent.dot(along); };
        const double start_slope = surface.corner[i] ? 0 : slope(surface.x(end) - surface.x(before));
        const double end_slope = surface.corner[end] ? 0 : slope(surface.x(after) - surface.x(i));
        for (int k = 0; k < pieces; ++k) {
            // Hermite's cubic with end values 0
            const double t = double(k) / pieces, s = 1 - t;
            const double height = chord.norm() * (start_slope * t * s * s - end_slope * s * t * t);
            curve.push_back(surface.x(i) + t * chord + height * out);
        }
    }
    return curve;
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
