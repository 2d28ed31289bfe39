// SPDX-License-Identifier: GPL-2.0-or-later
// A grain's material points, background grid and surface, all in the reference configuration and in units of
// the grain's radius (of the equal-volume disc for other shapes). Grains of one shape and resolution share it.
#pragma once

#include "grain/outline.hpp"
#include "grid/surface_operator.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace softgrain {

/// How a grain is discretised. Defaults: the accuracy study of doc/theory.md.
struct Resolution {
    int points = 276;             ///< material points wished for; the nearest layout is taken
    double surface_spacing = 1.0; ///< largest distance of surface points [cell widths]
    double node_threshold
        = 0; ///< nodes with less mass follow their neighbours [mass of the heaviest node]; 0: threshold() chooses
    double merge_threshold = 0.35;   ///< cells filled less join a neighbour [volume of a cell]
    bool mean_dilatation = true;     ///< cure of volumetric locking: cells have one volume change, not each point its own
    std::array<double, 3> offset {}; ///< shift of the grid under the grain [cell widths]

    /// Light nodes soften narrow contacts, as they should be, but let the surface wrinkle: that of a coarse grain under any
    /// squeeze, that of a fine one, which has more places for it, under a large one.
    double threshold() const
    {
        if (node_threshold > 0) return node_threshold;
        return points < 1000 ? std::clamp(3.0 / points, 0.03, 0.05) : 0.035;
    }
};

template <int Dim> class Discretisation : public SurfaceOperator<Dim> {
public:
    static constexpr int stencil = power(3, Dim);

    Discretisation(const Outline<Dim>& outline, const Resolution& resolution);

    double cell_width;     ///< h [radius]
    double node_threshold; ///< of the Resolution

    // Nodes: masters first, then slaves, which extrapolate masters linearly (so rigid motions and uniform
    // strains are exact) and hand their forces and masses to them.
    int master_count;
    std::vector<Vec<Dim>> node_position;
    std::vector<double> node_mass; ///< lumped, masters only; sums to `moments.volume` (unit density)
    std::vector<double> inverse_mass;
    std::vector<double> mean_gradient; ///< [master][Dim], mean over the grain of the shape functions' gradients
    struct Link {
        int master;
        double weight;
    };
    std::vector<Link> links;    ///< of all slaves, one slave after the other
    std::vector<int> slave_row; ///< first link of each slave, and the number of links
    int node_count() const { return int(node_position.size()); }
    /// Calls visit(slave, master, weight) for every link.
    template <class Visit> void each_link(const Visit& visit) const
    {
        for (int s = 0; s + 1 < int(slave_row.size()); ++s)
            for (int k = slave_row[s]; k < slave_row[s + 1]; ++k)
                visit(master_count + s, links[k].master, links[k].weight);
    }

    // Material points, ordered by region and by block. A block's points share their nodes. A region is the
    // set of points that share one volume change (mean dilatation).
    std::vector<Vec<Dim>> point_position;
    std::vector<double> point_volume;
    std::vector<double> shape;    ///< [point][stencil], shape functions
    std::vector<double> gradient; ///< of the shape functions, blocks of [stencil][point][Dim] [1 / radius]
    struct Block {
        int first_point, point_count;
        int gradient; ///< where the block's gradients begin; full cells share theirs
        std::array<std::int32_t, stencil> node;
    };
    std::vector<Block> blocks;
    struct Region {
        int first_block, block_count;
        double volume;
        bool full;        ///< a whole cell, its points the 2-point Gauss rule
        double pointwise; ///< share of the volumetric stiffness that acts on each point's own volume change
    };
    std::vector<Region> regions;
    int point_count() const { return int(point_position.size()); }

    // Surface points.
    std::vector<BoundaryPoint<Dim>> surface;
    struct SurfaceStencil {
        std::array<std::int32_t, stencil> node;
        std::array<double, stencil> weight;
    };
    std::vector<SurfaceStencil> surface_stencil;
    int surface_count() const { return int(surface.size()); }
    /// The undeformed boundary turns inwards somewhere, so that it may come to meet itself.
    bool is_concave() const;

    Moments<Dim> moments; ///< of the material points; equal to the outline's to round-off

    /// Gradient of a stencil's shape function at a block's point [1 / radius].
    Eigen::Map<const Vec<Dim>> gradient_at(const Block& block, int point, int k) const
    {
        return Eigen::Map<const Vec<Dim>>(
            &gradient[block.gradient + size_t(k * block.point_count + point - block.first_point) * Dim]);
    }
    /// Number of material points with this many cells across the grain's longest side.
    static int points_with(const Outline<Dim>& outline, const Resolution& resolution, double cells_across);

    /// Node values interpolated at a surface point; `field` is [node][Dim].
    Vec<Dim> at_surface(int point, const double* field) const;

private:
    struct Cells;
    void place_points(const Cells& cells, bool mean_dilatation);
    void place_surface(const Outline<Dim>& outline, const Cells& cells, double spacing);
    void bind_slaves(double threshold);
    void average_gradients();
    void build_delassus();
};

extern template class Discretisation<2>;

} // namespace softgrain
