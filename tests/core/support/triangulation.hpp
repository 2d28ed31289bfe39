// SPDX-License-Identifier: GPL-2.0-or-later
// Moments of polygons the slow way: cut into triangles by clipping ears (Meisters 1975), triangles cut to a box,
// each piece integrated by the rule of its edges' midpoints, which is exact for quadratics.
#pragma once

#include "grain/outline.hpp"

namespace softgrain::testing_support {

using Polygon = std::vector<Vec<2>>;

inline double turn_of(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c)
{
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

inline std::vector<Polygon> triangulate(Polygon polygon)
{
    std::vector<Polygon> triangles;
    while (polygon.size() > 3) {
        const size_t n = polygon.size();
        size_t ear = n;
        for (size_t i = 0; i < n && ear == n; ++i) {
            const Vec<2>&a = polygon[(i + n - 1) % n], &b = polygon[i], &c = polygon[(i + 1) % n];
            if (turn_of(a, b, c) <= 0) continue;
            bool empty = true;
            for (size_t k = 0; k < n; ++k) {
                if (k == i || k == (i + 1) % n || k == (i + n - 1) % n) continue;
                const Vec<2>& p = polygon[k];
                if (turn_of(a, b, p) >= 0 && turn_of(b, c, p) >= 0 && turn_of(c, a, p) >= 0) empty = false;
            }
            if (empty) ear = i;
        }
        if (ear == n) throw std::logic_error("the polygon has no ear");
        triangles.push_back({ polygon[(ear + n - 1) % n], polygon[ear], polygon[(ear + 1) % n] });
        polygon.erase(polygon.begin() + long(ear));
    }
    triangles.push_back(polygon);
    return triangles;
}

/// Part of a convex polygon with x . normal <= bound.
inline Polygon half(const Polygon& polygon, const Vec<2>& normal, double bound)
{
    Polygon kept;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double da = a.dot(normal) - bound, db = b.dot(normal) - bound;
        if (da <= 0) kept.push_back(a);
        if (da * db < 0) kept.push_back(a + da / (da - db) * (b - a));
    }
    return kept;
}

inline Moments<2> oracle_moments(const Polygon& polygon, const Box<2>& box)
{
    Moments<2> sum;
    for (Polygon part : triangulate(polygon)) {
        for (int axis = 0; axis < 2; ++axis) {
            part = half(part, Vec<2>::Unit(axis), box.max[axis]);
            part = half(part, -Vec<2>::Unit(axis), -box.min[axis]);
        }
        for (size_t k = 1; k + 1 < part.size(); ++k) {
            const double area = turn_of(part[0], part[k], part[k + 1]) / 2;
            for (const Vec<2>& x : { Vec<2>((part[0] + part[k]) / 2), Vec<2>((part[k] + part[k + 1]) / 2),
                                     Vec<2>((part[k + 1] + part[0]) / 2) })
                sum += { area / 3, area / 3 * x, area / 3 * x * x.transpose() };
        }
    }
    return sum;
}

/// Largest difference of any entry.
inline double difference(const Moments<2>& a, const Moments<2>& b)
{
    return std::max({ std::abs(a.volume - b.volume), (a.first - b.first).cwiseAbs().maxCoeff(),
                      (a.second - b.second).cwiseAbs().maxCoeff() });
}

} // namespace softgrain::testing_support
