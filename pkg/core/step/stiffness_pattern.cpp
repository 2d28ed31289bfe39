// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/stiffness_pattern.hpp"

#include "step/updated.hpp"

#include <numeric>

namespace softgrain {

template <int Dim> StiffnessPattern<Dim>::StiffnessPattern(const Discretisation<Dim>& mesh)
{
    constexpr int stencil = Discretisation<Dim>::stencil;
    const auto row_of = sort_rows(mesh.node_position, mesh.node_mass, mesh.master_count, mesh.cell_width);
    std::vector<std::vector<Share>> followed(mesh.node_count()); // what each node follows
    for (int i = 0; i < rows; ++i)
        followed[i].push_back({ row_of[i], 1 });
    mesh.each_link([&](int slave, int host, double weight) { followed[slave].push_back({ row_of[host], weight }); });

    for (const auto& region : mesh.regions) {
        Gradients gradients;
        for (int b = region.first_block, q = 0; b < region.first_block + region.block_count; ++b) {
            const auto& block = mesh.blocks[b];
            for (int p = block.first_point; p < block.first_point + block.point_count; ++p, ++q)
                for (int k = 0; k < stencil; ++k)
                    for (const Share& share : followed[block.node[k]]) {
                        const auto [entry, added] = gradients.try_emplace(share.row);
                        if (added) entry->second.fill(Vec<Dim>::Zero());
                        entry->second[q] += share.weight * mesh.gradient_at(block, p, k);
                    }
        }
        add_region(region, gradients);
    }
    carried.assign(mesh.point_position.size(), Mat<Dim>::Identity());
    count_blocks();
    for (int p = 0; p < mesh.surface_count(); ++p) {
        std::map<int, double> weights;
        for (int k = 0; k < stencil; ++k)
            for (const Share& share : followed[mesh.surface_stencil[p].node[k]])
                weights[share.row] += share.weight * mesh.surface_stencil[p].weight[k];
        add_surface_point(mesh.surface[p].position, weights);
    }
    surface_start.push_back(int(surface.size()));
}

// With the points' deformations F up to now and F_0 when the grid was laid, F_p + sum of u grad N F_0 = F_p + sum of u (F_0^T grad N).
template <int Dim>
StiffnessPattern<Dim>::StiffnessPattern(const Discretisation<Dim>& mesh, const UpdatedBody<Dim>& body)
    : carried(body.deformation_gradients())
{
    constexpr int points = power(2, Dim);
    const PointGrid<Dim>& grid = body.grid();
    const auto row_of = sort_rows(grid.node_position, grid.node_mass, grid.node_count(), mesh.cell_width);
    for (size_t r = 0; r < mesh.regions.size(); ++r) {
        Gradients gradients;
        for (int q = 0; q < points; ++q) {
            const size_t p = points * r + q;
            for (int k = grid.point_row[p]; k < grid.point_row[p + 1]; ++k) {
                const auto [entry, added] = gradients.try_emplace(row_of[grid.entry[k].node]);
                if (added) entry->second.fill(Vec<Dim>::Zero());
                entry->second[q] = body.carried()[p].transpose() * grid.entry[k].gradient;
            }
        }
        add_region(mesh.regions[r], gradients);
    }
    count_blocks();
    for (size_t s = 0; s < body.surface().size(); ++s) {
        std::map<int, double> weights;
        for (const auto& [node, weight] : grid.surface_row[s])
            weights[row_of[node]] = weight;
        add_surface_point(body.surface()[s], weights);
    }
    surface_start.push_back(int(surface.size()));
}

/// Masters along the longest side of the grain.
template <int Dim>
std::vector<int> StiffnessPattern<Dim>::sort_rows(const std::vector<Vec<Dim>>& nodes, const std::vector<double>& masses,
                                                  int masters, double cell_width)
{
    Vec<Dim> lo = nodes[0], hi = lo;
    for (const auto& x : nodes) {
        lo = lo.cwiseMin(x);
        hi = hi.cwiseMax(x);
    }
    int longest;
    (hi - lo).maxCoeff(&longest);
    rows = masters;
    master.resize(rows);
    std::iota(master.begin(), master.end(), 0);
    const auto column = [&](int i) { return std::lround((nodes[i][longest] - lo[longest]) / cell_width); };
    std::stable_sort(master.begin(), master.end(), [&](int i, int j) {
        if (column(i) != column(j)) return column(i) < column(j);
        return nodes[i].sum() < nodes[j].sum();
    });
    std::vector<int> row_of(rows);
    for (int r = 0; r < rows; ++r) {
        row_of[master[r]] = r;
        position.push_back(nodes[master[r]]);
        mass.push_back(masses[master[r]]);
    }
    first.resize(rows);
    std::iota(first.begin(), first.end(), 0);
    return row_of;
}

template <int Dim>
void StiffnessPattern<Dim>::add_region(const typename Discretisation<Dim>::Region& region, const Gradients& gradients)
{
    constexpr int points = power(2, Dim);
    regions.push_back({ int(gradients.size()), int(region_row.size()), int(region_gradient.size()),
                        points * int(regions.size()), region.volume, region.pointwise });
    most_rows = std::max(most_rows, int(gradients.size()));
    for (const auto& [row, gradient] : gradients) {
        region_row.push_back(row);
        first[row] = std::min(first[row], gradients.begin()->first);
    }
    for (int q = 0; q < points; ++q)
        for (const auto& [row, gradient] : gradients)
            region_gradient.insert(region_gradient.end(), gradient[q].data(), gradient[q].data() + Dim);
}

template <int Dim> void StiffnessPattern<Dim>::count_blocks()
{
    start.push_back(0);
    for (int r = 0; r < rows; ++r)
        start.push_back(start[r] + r - first[r] + 1);
}

template <int Dim> void StiffnessPattern<Dim>::add_surface_point(const Vec<Dim>& place, const std::map<int, double>& weights)
{
    surface_start.push_back(int(surface.size()));
    surface_position.push_back(place);
    for (const auto& [row, weight] : weights)
        surface.push_back({ row, weight });
}

template struct StiffnessPattern<2>;

} // namespace softgrain
