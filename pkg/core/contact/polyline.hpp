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

/// Projects x on the outline, a parabola over each segment that rises from its ends with the slopes -+`rise`. The
/// normal n(t) is that of the parabola and the foot (1 - t) a + t b lies on it under the point, so that the gap
/// changes by n . dx as the point moves, and a normal contact force makes no couple. A sampled circle of radius R
/// keeps its radius to R (angle step)^4 / 128. Between two segments, at a corner, the vertex is the foot.
///
/// Walks from segment `hint` to the segment that holds the foot: the nearest one from any near start.
Projection project(const Surface<2>& polyline, const Vec<2>& x, int hint);

/// Lets the rises follow the shape: each moves by `share` of its distance to the present value, the mean turn of
/// the polyline at the segment's ends. Following slowly, they do not take part in vibrations of the surface, and the
/// gap changes as the foot and the point move: the contact law acts on just that.
void follow_shape(Surface<2>& polyline, double share);

/// The segment nearest to x, by looking at all of them.
int nearest_segment(const Surface<2>& polyline, const Vec<2>& x);

} // namespace softgrain
