// SPDX-License-Identifier: GPL-2.0-or-later
// The shapes that tests go through: round, long, angular, concave.
#pragma once

#include "grain/outline.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace softgrain::testing_support {

inline std::vector<Vec<2>> polar(int count, const std::function<double(double)>& radius)
{
    std::vector<Vec<2>> vertices;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * M_PI * i / count;
        vertices.push_back(radius(angle) * Vec<2>(std::cos(angle), std::sin(angle)));
    }
    return vertices;
}

inline std::vector<Vec<2>> ellipse_vertices(int count, double a, double b)
{
    auto vertices = polar(count, [](double) { return 1.0; });
    for (auto& v : vertices)
        v = Vec<2>(a * v.x(), b * v.y());
    return vertices;
}

inline std::vector<Vec<2>> rectangle_vertices(double width, double height)
{
    return { { 0, 0 }, { width, 0 }, { width, height }, { 0, height } };
}

struct NamedShape {
    std::string name;
    std::shared_ptr<const Outline<2>> outline;
};

inline std::vector<std::pair<std::string, std::vector<Vec<2>>>> polygons()
{
    return { { "triangle", { { 0, 0 }, { 2, 0.1 }, { 0.6, 1.5 } } },
             { "hexagon", polar(6, [](double) { return 1.0; }) },
             { "rectangle", rectangle_vertices(2, 1) },
             { "ellipse", ellipse_vertices(40, 1.5, 1) },
             { "flower", polar(60, [](double t) { return 1 + 0.2 * std::cos(5 * t); }) },
             { "L", { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } } },
             { "U", { { 0, 0 }, { 3, 0 }, { 3, 2 }, { 2, 2 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } } } };
}

inline std::vector<NamedShape> shapes()
{
    std::vector<NamedShape> all { { "disc", std::make_shared<DiscOutline>() } };
    for (const auto& [name, vertices] : polygons())
        all.push_back({ name, std::make_shared<PolygonOutline>(vertices) });
    return all;
}

} // namespace softgrain::testing_support
