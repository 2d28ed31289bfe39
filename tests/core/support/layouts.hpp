// SPDX-License-Identifier: GPL-2.0-or-later
// Discretisations of every shape at many resolutions and random grid offsets.
#pragma once

#include "grid/discretisation.hpp"
#include "support/random.hpp"
#include "support/shapes.hpp"

namespace softgrain::testing_support {

struct Layout {
    std::string name;
    std::shared_ptr<const Outline<2>> outline;
    Resolution resolution;
    std::shared_ptr<const Discretisation<2>> mesh;
};

inline Layout layout_of(const NamedShape& shape, const Resolution& resolution)
{
    return { shape.name + ", " + std::to_string(resolution.points) + " points, offset "
                 + std::to_string(resolution.offset[0]) + " " + std::to_string(resolution.offset[1]),
             shape.outline, resolution, std::make_shared<Discretisation<2>>(*shape.outline, resolution) };
}

inline std::vector<Layout> layouts(Random& random, const std::vector<int>& points, int offsets)
{
    std::vector<Layout> all;
    for (const auto& shape : shapes())
        for (int count : points)
            for (int k = 0; k < offsets; ++k) {
                Resolution resolution;
                resolution.points = count;
                if (k > 0) resolution.offset = { random.uniform(-1, 1), random.uniform(-1, 1), 0 };
                all.push_back(layout_of(shape, resolution));
            }
    // one row of cells, each put together from 0.7 and 0.3 of a cell: as full as a cell that is none
    Resolution row;
    row.points = 16;
    row.offset = { 0, 0.3, 0 };
    all.push_back(layout_of({ "row", std::make_shared<PolygonOutline>(rectangle_vertices(4, 1)) }, row));
    return all;
}

} // namespace softgrain::testing_support
