// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "grid/discretisation.hpp"

namespace softgrain {

/// Where the stiffness of a grain has entries, masters only, slaves folded into them. Masters are put into rows along the
/// grain's longest side, so that the entries of a row lie in a narrow band: from its first column to the diagonal. All
/// grains of a discretisation share it. Blocks are Dim x Dim.
template <int Dim> struct StiffnessPattern {
    explicit StiffnessPattern(const Discretisation<Dim>& mesh);

    int rows;                ///< one a master
    std::vector<int> row_of; ///< of a master
    std::vector<int> master; ///< of a row
    std::vector<int> first;  ///< first column of each row
    std::vector<int> start;  ///< block of the first column; one more entry: the number of blocks
    int block_count() const { return start.back(); }
    int block(int row, int column) const { return start[row] + column - first[row]; }

    /// Rows that the points of a region follow, ascending, and the gradients of their shape functions, [point][row][Dim].
    struct Region {
        int rows, row, gradient; ///< how many; where they and their gradients begin
    };
    std::vector<Region> regions;
    std::vector<int> region_row;
    std::vector<double> region_gradient;
    static constexpr int row_limit = 64; ///< of a region, in the kernels
    int most_rows = 0;                   ///< of a region

    /// Interpolation at the surface: entries of point p from surface_start[p] on, rows ascending.
    struct Share {
        int row;
        double weight;
    };
    std::vector<Share> surface;
    std::vector<int> surface_start;
};

extern template struct StiffnessPattern<2>;

} // namespace softgrain
