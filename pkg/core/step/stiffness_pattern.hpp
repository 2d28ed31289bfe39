// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/tensor.hpp"
#include "grid/discretisation.hpp"

#include <map>

namespace softgrain {

template <int Dim> class UpdatedBody;

/// The unknowns of a grain, and where its stiffness has entries: masters only, slaves folded into them. Masters are put into
/// rows along the grain's longest side, so that the entries of a row lie in a narrow band: from its first column to the
/// diagonal. Blocks are Dim x Dim. All lengths in radii.
template <int Dim> struct StiffnessPattern {
    /// Of all grains of a discretisation; displacements count from the undeformed grain.
    explicit StiffnessPattern(const Discretisation<Dim>& mesh);
    /// Of one grain in the updated-Lagrangian form; displacements count from its nodes as they are.
    StiffnessPattern(const Discretisation<Dim>& mesh, const UpdatedBody<Dim>& body);

    int rows;                       ///< one a master
    std::vector<int> master;        ///< of a row
    std::vector<Vec<Dim>> position; ///< of the nodes, by row
    std::vector<double> mass;       ///< the same, lumped, slaves folded
    std::vector<int> first;         ///< first column of each row
    std::vector<int> start;         ///< block of the first column; one more entry: the number of blocks
    int block_count() const { return start.back(); }
    int block(int row, int column) const { return start[row] + column - first[row]; }

    /// Rows that the points of a region follow, ascending, and the gradients of their shape functions, [point][row][Dim].
    struct Region {
        int rows, row, gradient;  ///< how many; where they and their gradients begin
        int carried;              ///< where its deformation gradients without displacement begin
        double volume, pointwise; ///< as in Discretisation::Region
    };
    std::vector<Region> regions;
    std::vector<int> region_row;
    std::vector<double> region_gradient;
    std::vector<Mat<Dim>> carried;       ///< deformation gradients without displacement, [point]
    static constexpr int row_limit = 64; ///< of a region, in the kernels
    int most_rows = 0;                   ///< of a region
    /// Deformation gradients at the points of a region; displacement: [row][Dim] of items like T.
    template <class T, class Field>
    SOFTGRAIN_INLINE void deform(const Region& region, const Field& displacement, Tensor<Dim, T>* F) const
    {
        constexpr int points = power(2, Dim);
        const double* slope = &region_gradient[region.gradient];
        for (int q = 0; q < points; ++q) {
            for (int i = 0; i < Dim; ++i)
                for (int j = 0; j < Dim; ++j)
                    F[q].at[i][j] = broadcast<T>(carried[region.carried + q](i, j));
            for (int a = 0; a < region.rows; ++a, slope += Dim)
                for (int i = 0; i < Dim; ++i)
                    for (int j = 0; j < Dim; ++j)
                        F[q].at[i][j] += slope[j] * displacement[Dim * region_row[region.row + a] + i];
        }
    }

    /// Interpolation at the surface: entries of point p from surface_start[p] on, rows ascending.
    struct Share {
        int row;
        double weight;
    };
    std::vector<Share> surface;
    std::vector<int> surface_start;
    std::vector<Vec<Dim>> surface_position; ///< without displacement
    int surface_count() const { return int(surface_position.size()); }

private:
    using Gradients = std::map<int, std::array<Vec<Dim>, power(2, Dim)>>; ///< of each row at each point of a region
    /// Puts the masters, the first of the nodes, into rows; the row of each.
    std::vector<int> sort_rows(const std::vector<Vec<Dim>>& nodes, const std::vector<double>& masses, int masters,
                               double cell_width);
    void add_region(const typename Discretisation<Dim>::Region& region, const Gradients& gradients);
    void add_surface_point(const Vec<Dim>& place, const std::map<int, double>& weights);
    void count_blocks();
};

extern template struct StiffnessPattern<2>;

} // namespace softgrain
