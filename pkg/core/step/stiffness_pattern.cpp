// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/stiffness_pattern.hpp"

#include <map>
#include <numeric>

namespace softgrain {
namespace {

    /// Masters along the longest side of the grain.
    template <int Dim> std::vector<int> along_longest_side(const Discretisation<Dim>& mesh)
    {
        Vec<Dim> lo = mesh.node_position[0], hi = lo;
        for (const auto& x : mesh.node_position) {
            lo = lo.cwiseMin(x);
            hi = hi.cwiseMax(x);
        }
        int longest;
        (hi - lo).maxCoeff(&longest);
        std::vector<int> order(mesh.master_count);
        std::iota(order.begin(), order.end(), 0);
        const auto column
            = [&](int i) { return std::lround((mesh.node_position[i][longest] - lo[longest]) / mesh.cell_width); };
        std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
            if (column(i) != column(j)) return column(i) < column(j);
            return mesh.node_position[i].sum() < mesh.node_position[j].sum();
        });
        return order;
    }

} // namespace

template <int Dim>
StiffnessPattern<Dim>::StiffnessPattern(const Discretisation<Dim>& mesh)
    : rows(mesh.master_count)
    , row_of(rows)
    , master(along_longest_side(mesh))
    , first(rows)
{
    constexpr int stencil = Discretisation<Dim>::stencil, points = power(2, Dim);
    for (int r = 0; r < rows; ++r)
        row_of[master[r]] = r;
    std::vector<std::vector<Share>> followed(mesh.node_count()); // what each node follows
    for (int i = 0; i < rows; ++i)
        followed[i].push_back({ row_of[i], 1 });
    mesh.each_link([&](int slave, int host, double weight) { followed[slave].push_back({ row_of[host], weight }); });

    std::iota(first.begin(), first.end(), 0);
    for (const auto& region : mesh.regions) {
        std::map<int, std::array<Vec<Dim>, points>> gradients; // of each row at each point
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
        regions.push_back({ int(gradients.size()), int(region_row.size()), int(region_gradient.size()) });
        most_rows = std::max(most_rows, int(gradients.size()));
        for (const auto& [row, gradient] : gradients) {
            region_row.push_back(row);
            first[row] = std::min(first[row], gradients.begin()->first);
        }
        for (int q = 0; q < points; ++q)
            for (const auto& [row, gradient] : gradients)
                region_gradient.insert(region_gradient.end(), gradient[q].data(), gradient[q].data() + Dim);
    }
    start.push_back(0);
    for (int r = 0; r < rows; ++r)
        start.push_back(start[r] + r - first[r] + 1);

    for (int p = 0; p < mesh.surface_count(); ++p) {
        std::map<int, double> weights;
        for (int k = 0; k < stencil; ++k)
            for (const Share& share : followed[mesh.surface_stencil[p].node[k]])
                weights[share.row] += share.weight * mesh.surface_stencil[p].weight[k];
        surface_start.push_back(int(surface.size()));
        for (const auto& [row, weight] : weights)
            surface.push_back({ row, weight });
    }
    surface_start.push_back(int(surface.size()));
}

template struct StiffnessPattern<2>;

} // namespace softgrain
