// SPDX-License-Identifier: GPL-2.0-or-later
#include "grain/outline.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    using Polygon = std::vector<Vec<2>>;

    double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

    /// Green's theorem, edge by edge, on triangles with the origin.
    Moments<2> polygon_moments(const Polygon& polygon)
    {
        Moments<2> sum;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double area = cross(a, b) / 2;
            sum.volume += area;
            sum.first += area / 3 * (a + b);
            sum.second += area / 12 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
        }
        return sum;
    }

    /// Part of the polygon where sign * (x[axis] - bound) <= 0 (Sutherland and Hodgman 1974). A concave polygon
    /// may come back joined by edges traced twice, which add nothing to the integrals.
    Polygon clip(const Polygon& polygon, int axis, double bound, double sign)
    {
        Polygon kept;
        for (size_t i = 0; i < polygon.size(); ++i) {
            const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double da = sign * (a[axis] - bound), db = sign * (b[axis] - bound);
            if (da <= 0) kept.push_back(a);
            if ((da < 0 && db > 0) || (da > 0 && db < 0)) kept.push_back(a + da / (da - db) * (b - a));
        }
        return kept;
    }

    /// The edges ab and cd have a point in common.
    bool edges_meet(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d)
    {
        for (int axis = 0; axis < 2; ++axis)
            if (std::max(a[axis], b[axis]) < std::min(c[axis], d[axis])
                || std::max(c[axis], d[axis]) < std::min(a[axis], b[axis]))
                return false;
        const double abc = cross(b - a, c - a), abd = cross(b - a, d - a);
        const double cda = cross(d - c, a - c), cdb = cross(d - c, b - c);
        return abc * abd <= 0 && cda * cdb <= 0;
    }

} // namespace

PolygonOutline::PolygonOutline(Polygon vertices)
    : vertices_(std::move(vertices))
{
    const size_t count = vertices_.size();
    if (count < 3)
        throw UserError("soft grain outline: " + std::to_string(count)
                        + " vertices do not enclose an area; give at least 3.");
    for (size_t i = 0; i < count; ++i)
        if (!vertices_[i].allFinite())
            throw UserError("soft grain outline: vertex " + std::to_string(i)
                            + " is not finite; give finite coordinates in metres.");
    const Vec<2> near = vertices_[0]; // moments about a vertex lose no digits far from the origin
    for (auto& vertex : vertices_)
        vertex -= near;
    Moments<2> whole = polygon_moments(vertices_);
    double extent = 0;
    for (const auto& vertex : vertices_)
        extent = std::max(extent, vertex.norm());
    const bool with_area = std::abs(whole.volume) > 1e-9 * extent * extent;
    for (size_t i = 0; i < count; ++i)
        if (with_area && vertices_[i] == vertices_[(i + 1) % count])
            throw UserError("soft grain outline: vertices " + std::to_string(i) + " and " + std::to_string((i + 1) % count)
                            + " are the same; give each corner once.");
    for (size_t i = 0; i < count; ++i)
        for (size_t j = i + 2; j < count; ++j)
            if ((j + 1) % count != i && edges_meet(vertices_[i], vertices_[i + 1], vertices_[j], vertices_[(j + 1) % count]))
                throw UserError("soft grain outline: the edges from vertices " + std::to_string(i) + " and "
                                + std::to_string(j) + " cross or touch; list the vertices in order around the grain.");
    if (!with_area) throw UserError("soft grain outline: the vertices enclose no area; list the corners of a polygon.");
    if (whole.volume < 0) std::reverse(vertices_.begin(), vertices_.end());
    centroid_ = whole.centroid() + near;
    scale_ = std::sqrt(std::abs(whole.volume) / M_PI);
    for (auto& vertex : vertices_)
        vertex = (vertex - whole.centroid()) / scale_;
}

Box<2> PolygonOutline::bounds() const
{
    Box<2> box { vertices_[0], vertices_[0] };
    for (const auto& vertex : vertices_) {
        box.min = box.min.cwiseMin(vertex);
        box.max = box.max.cwiseMax(vertex);
    }
    return box;
}

Moments<2> PolygonOutline::moments() const { return polygon_moments(vertices_); }

Moments<2> PolygonOutline::moments(const Box<2>& box) const
{
    Polygon part = vertices_;
    for (int axis = 0; axis < 2; ++axis) {
        part = clip(part, axis, box.min[axis], -1);
        part = clip(part, axis, box.max[axis], +1);
    }
    return polygon_moments(part);
}

std::vector<BoundaryPoint<2>> PolygonOutline::sample(double spacing) const
{
    const size_t count = vertices_.size();
    std::vector<BoundaryPoint<2>> points;
    std::vector<double> edge_spacing(count);
    std::vector<int> pieces(count);
    for (size_t i = 0; i < count; ++i) {
        const double length = (vertices_[(i + 1) % count] - vertices_[i]).norm();
        pieces[i] = std::max(1, int(std::ceil(length / spacing - 1e-9)));
        edge_spacing[i] = length / pieces[i];
    }
    constexpr double sharp = 0.5; // turn of the boundary above which a corner is a feature of its own [rad]
    for (size_t i = 0; i < count; ++i) {
        const size_t before = (i + count - 1) % count, after = (i + 1) % count;
        const Vec<2> in = vertices_[i] - vertices_[before], out = vertices_[after] - vertices_[i];
        const double turn = std::atan2(cross(in, out), in.dot(out));
        points.push_back({ vertices_[i], (edge_spacing[before] + edge_spacing[i]) / 2, turn > sharp });
        for (int k = 1; k < pieces[i]; ++k)
            points.push_back({ vertices_[i] + out * (double(k) / pieces[i]), edge_spacing[i], false });
    }
    return points;
}

} // namespace softgrain
