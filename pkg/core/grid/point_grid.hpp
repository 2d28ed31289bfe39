// SPDX-License-Identifier: GPL-2.0-or-later
// A background grid laid under material points where they stand now. Cells are fixed in space; nodes, their masses and the
// shape functions follow from the points.
#pragma once

#include "grid/surface_operator.hpp"

namespace softgrain {

template <int Dim> class PointGrid {
public:
    /// A node's shape function, slaves folded into their masters.
    struct Entry {
        int node;
        double weight;
        Vec<Dim> gradient; ///< [1 / length]
    };

    /// Cells of this width, one of them with its middle at the anchor. Nodes lighter than `threshold` times the heaviest
    /// extrapolate the others linearly, as in Discretisation. Throws SimulationError when points have scattered so that no
    /// linear function can be extrapolated from them.
    void lay(const std::vector<Vec<Dim>>& points, const std::vector<double>& masses, const std::vector<Vec<Dim>>& surface,
             const Vec<Dim>& anchor, double width, double threshold);

    int node_count() const { return int(node_position.size()); } ///< masters only
    std::vector<Vec<Dim>> node_position;
    std::vector<double> node_mass;                               ///< lumped, slaves folded
    std::vector<int> point_row;                                  ///< first entry of each point, and the number of entries
    std::vector<Entry> entry;                                    ///< of all points, one point after the other
    std::vector<typename SurfaceOperator<Dim>::Row> surface_row; ///< of each surface point
    SurfaceOperator<Dim> response;                               ///< of the surface

private:
    using Index = Eigen::Matrix<int, Dim, 1>;
    struct Window; ///< the cells in reach of the points
    void place_nodes(const Window& window, const std::vector<char>& master, std::vector<int>& number);
    void bind_slaves(const Window& window, const std::vector<int>& number, const std::vector<char>& touched);
    bool fold_masses(const std::vector<double>& mass, const std::vector<int>& number, double least,
                     std::vector<char>& master);

    // of the slaves, by place in the window
    std::vector<int> link_row_;
    std::vector<std::pair<int, double>> links_;
};

extern template class PointGrid<2>;

} // namespace softgrain
