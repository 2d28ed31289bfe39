// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/surface.hpp"

#include <array>

namespace softgrain {

/// Where a point stands against the outline that a closed polyline samples.
struct Projection {
    int segment;                  ///< from vertex `segment` to the next one
    double t;                     ///< place on the segment, 0 to 1
    std::array<int, 4> vertex;    ///< that the foot follows, and
    std::array<double, 4> weight; ///< their weights, sum 1
    Vec<2> normal;                ///< unit outward normal of the outline there
    double gap;                   ///< distance from the outline, negative inside [m]
};

/// Projects x on the outline through the vertices: over each segment a cubic with the tangents (x_{i+1} - x_{i-1}) / 2
/// at its ends (Catmull and Rom 1974); at a corner the tangent that makes it a parabola, between two corners a straight
/// line. It has a continuous normal but at corners, and lies within 9/384 R (angle step)^4 of a sampled circle.
///
/// The foot follows the vertices: foot = sum of weight x vertex. As the normal is the outline's, the gap changes by
/// n . (dx - sum of weight x d vertex) to first order, and a normal contact force makes no couple.
///
/// Starts on segment `segment` and walks to the foot: the nearest one from any near start, to the last digit. Where
/// there is none, at a convex corner, the vertex is the foot.
Projection project(const Surface<2>& polyline, const Vec<2>& x, int segment);

/// How an outline goes on at a place of a segment.
struct Bend {
    std::array<double, 4> slope; ///< change of the weights of the vertices with t
    double length;               ///< |dx/dt| [m]
    double second;               ///< d2x/dt2 along the outward normal [m]
};
Bend bend_at(const Surface<2>& polyline, int segment, double t);

/// Whether chords of a closed polyline cross each other: the boundary has folded over itself.
bool crosses_itself(const Surface<2>& polyline);

/// Whether parts of the inside of a closed polyline lie on each other: a vertex, moved inwards by `depth` [m], is inside twice,
/// or chords cross that have one or two others between them.
bool covers_itself(const Surface<2>& polyline, double depth);

/// A vertex and a place on another segment face each other across a gap, or have entered each other by no more than `depth`
/// [m]: neither is behind the other, and the segment does not follow the vertex.
bool face_each_other(const Surface<2>& polyline, int vertex, int segment, const Vec<2>& place, const Vec<2>& normal,
                     double depth);
/// The nearest segment that a vertex faces; -1: none.
int faced_segment(const Surface<2>& polyline, int vertex, double depth);

/// The segment nearest to x, by looking at all of them.
int nearest_segment(const Surface<2>& polyline, const Vec<2>& x);

} // namespace softgrain
