// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftGrain.hpp"

#include <map>
#include <mutex>

namespace yade {

YADE_PLUGIN((SoftGrain));

namespace {
    using Key = std::pair<std::vector<double>, std::vector<double>>; // resolution, vertices

    std::shared_ptr<const softgrain::Discretisation<2>> shared(const softgrain::Outline<2>& outline,
                                                               const softgrain::Resolution& resolution, Key key)
    {
        static std::map<Key, std::weak_ptr<const softgrain::Discretisation<2>>> known;
        static std::mutex guard;
        const std::lock_guard<std::mutex> lock(guard);
        auto& entry = known[key];
        auto mesh = entry.lock();
        if (!mesh) entry = mesh = std::make_shared<const softgrain::Discretisation<2>>(outline, resolution);
        return mesh;
    }
} // namespace

void SoftGrain::postLoad(SoftGrain&)
{
    mesh_.reset();
    equivalentRadius_ = NaN;
}

void SoftGrain::discretise()
{
    if (formulation != "total" && formulation != "updated")
        throw softgrain::UserError("SoftGrain: formulation = '" + formulation + "' is none; give 'total' or 'updated'.");
    updated_ = formulation == "updated";
    if (points < 16 || points > 100000)
        throw softgrain::UserError("SoftGrain: points = " + std::to_string(points) + " has to lie between 16 and 100000.");
    if (!(surfaceSpacing >= 0.1 && surfaceSpacing <= 4))
        throw softgrain::UserError("SoftGrain: surfaceSpacing = " + softgrain::shown(surfaceSpacing)
                                   + " has to lie between 0.1 and 4 cell widths.");
    if (!(nodeThreshold == 0 || (nodeThreshold >= 1e-4 && nodeThreshold <= 0.5)))
        throw softgrain::UserError("SoftGrain: nodeThreshold = " + softgrain::shown(nodeThreshold)
                                   + " has to lie between 0.0001 and 0.5, or be 0 to be chosen.");
    if (!gridOffset.allFinite())
        throw softgrain::UserError("SoftGrain: gridOffset has to be finite, in cell widths; 0 is usual.");
    softgrain::Resolution resolution;
    resolution.points = points;
    resolution.surface_spacing = surfaceSpacing;
    resolution.node_threshold = nodeThreshold;
    resolution.mean_dilatation = meanDilatation;
    resolution.offset = { gridOffset[0], gridOffset[1], 0 };
    Key key { { double(points), surfaceSpacing, nodeThreshold, double(meanDilatation), gridOffset[0], gridOffset[1] }, {} };
    if (vertices.empty()) {
        if (!(radius > 1e-12 && radius < 1e6))
            throw softgrain::UserError("SoftGrain: radius = " + softgrain::shown(radius)
                                       + " m has to be positive, from 1e-12 to 1e6.");
        equivalentRadius_ = radius;
        mesh_ = shared(softgrain::DiscOutline(), resolution, key);
    } else {
        std::vector<softgrain::Vec<2>> corners;
        for (const auto& vertex : vertices)
            corners.push_back(vertex.head<2>());
        const softgrain::PolygonOutline outline(corners);
        for (const auto& vertex : outline.vertices())
            for (double coordinate : { vertex[0], vertex[1] })
                key.second.push_back(std::round(coordinate * 1e9) / 1e9); // forms that differ by round-off are one
        equivalentRadius_ = outline.scale();
        mesh_ = shared(outline, resolution, key);
    }
}

Real SoftGrain::area() { return mesh()->moments.volume * equivalentRadius() * equivalentRadius(); }

} // namespace yade
