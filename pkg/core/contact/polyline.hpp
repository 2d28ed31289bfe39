// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/surface.hpp"

namespace softgrain {

/// Where a point stands against a closed polyline.
struct Projection {
    int segment;     ///< from vertex `segment` to the next one
    double t;        ///< place on the segment, 0 to 1
    Vec<2> normal;   ///< unit outward normal of the polyline there
    double gap;      ///< distance along the normal to the smoothed boundary, negative inside [m]
};

/// Projects x on the polyline along a normal field that is continuous from segment to segment: at a vertex the
/// normal is that of the chord of its neighbours (at a corner each segment keeps its own), in between it is
/// interpolated, so the foot (1 - t) a + t b, the point and the normal are in line and a normal contact force
/// makes no couple. The gap counts from the cubic through the vertices with those normals: a sampled circle of
/// radius R keeps its radius to R (angle step)^4 / 384.
///
/// Walks from segment `hint` to the segment that holds the foot: the nearest one from any near start.
Projection project(const Surface<2>& polyline, const Vec<2>& x, int hint);

/// The vertex nearest to x, by looking at all of them.
int nearest_vertex(const Surface<2>& polyline, const Vec<2>& x);

} // namespace softgrain
