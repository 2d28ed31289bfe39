// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/types.hpp"

#include <array>
#include <utility>
#include <vector>

namespace softgrain {

/// Surface points that a place on a face follows: in 2D the ends of its segment and one beyond each.
template <int Dim> constexpr int face_vertices = Dim == 2 ? 4 : 3;

/// Delassus operator of a grain's surface: velocity of surface point s due to a unit impulse on surface point `column`, per
/// unit density and radius^Dim; rows in CSR form, isotropic in space.
template <int Dim> struct SurfaceOperator {
    std::vector<int> delassus_row, delassus_column;
    std::vector<double> delassus_value;
    double delassus(int row, int column) const;
    /// The same for faces: the rows of all vertices that a face follows, on the columns that any of them has.
    struct FaceRows {
        std::vector<int> column;
        std::array<std::vector<double>, face_vertices<Dim>> value; ///< [vertex][column]
    };
    std::vector<FaceRows> face_rows; ///< [segment]

    /// What moves a surface point: masters and their weights, each master once.
    using Row = std::vector<std::pair<int, double>>;
    /// D = B M^-1 B^T, the rows of B one a surface point, masses of the masters [per unit density, radius^Dim].
    void build(const std::vector<Row>& rows, const std::vector<double>& node_mass);
};

extern template struct SurfaceOperator<2>;

} // namespace softgrain
