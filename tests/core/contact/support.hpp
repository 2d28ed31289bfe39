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
    follow_shape(surface, 1);
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
    follow_shape(surface, 1);
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

/// The smoothed boundary, finely: over each segment the parabola that leaves its ends with the slopes -+rise.
inline std::vector<Vec<2>> smoothed(const Surface<2>& surface, int pieces)
{
    std::vector<Vec<2>> curve;
    for (int i = 0; i < surface.count; ++i) {
        const Vec<2> chord = surface.x((i + 1) % surface.count) - surface.x(i);
        for (int k = 0; k < pieces; ++k) {
            const double t = double(k) / pieces;
            curve.push_back(surface.x(i) + t * chord + surface.rise[i] * t * (1 - t) * Vec<2>(chord.y(), -chord.x()));
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
