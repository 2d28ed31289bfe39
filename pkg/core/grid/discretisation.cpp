// SPDX-License-Identifier: GPL-2.0-or-later
#include "grid/discretisation.hpp"

#include "grid/bspline.hpp"
#include "grid/extrapolation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace softgrain {

/// The cells of the background grid and how they join into regions.
template <int Dim> struct Discretisation<Dim>::Cells {
    using Index = Eigen::Matrix<int, Dim, 1>;

    double width;
    Vec<Dim> origin;
    Index size;
    std::vector<Moments<Dim>> region; ///< per cell: what the region hosted by this cell holds; none: volume 0
    std::vector<char> full;           ///< per cell: the region is just this cell, whole

    Cells(const Outline<Dim>& outline, const Resolution& resolution, double across)
    {
        const Box<Dim> bounds = outline.bounds();
        const Vec<Dim> extent = bounds.max - bounds.min;
        width = extent.maxCoeff() / across;
        for (int d = 0; d < Dim; ++d) {
            const int count = std::max(1, int(std::ceil(extent[d] / width - 1e-9)));
            const double shift = resolution.offset[d] - std::floor(resolution.offset[d]);
            size[d] = count + (shift > 0 ? 1 : 0);
            origin[d] = (bounds.min[d] + bounds.max[d] - count * width) / 2 - shift * width;
        }
        const double full_volume = std::pow(width, Dim);
        std::vector<Moments<Dim>> inside(size.prod());
        for (int c = 0; c < int(inside.size()); ++c) {
            const Vec<Dim> corner = origin + width * index(c).template cast<double>();
            const Moments<Dim> part = outline.moments(Box<Dim> { corner, corner + Vec<Dim>::Constant(width) });
            if (part.volume > 1e-14 * full_volume) inside[c] = part;
        }
        region = inside;
        for (int c = 0; c < int(inside.size()); ++c) {
            if (inside[c].volume == 0 || inside[c].volume >= resolution.merge_threshold * full_volume) continue;
            const int host = fullest_neighbour(inside, c);
            if (inside[host].volume < resolution.merge_threshold * full_volume) continue;
            region[host] += inside[c];
            region[c] = {};
        }
        for (int c = 0; c < int(inside.size()); ++c)
            full.push_back(std::abs(inside[c].volume / full_volume - 1) < 1e-12 && region[c].volume == inside[c].volume);
    }

    Index index(int cell) const
    {
        Index at;
        for (int d = 0; d < Dim; ++d) {
            at[d] = cell % size[d];
            cell /= size[d];
        }
        return at;
    }

    /// The cell itself if all its neighbours are empty. Neighbours across a face come before others.
    int fullest_neighbour(const std::vector<Moments<Dim>>& inside, int cell) const
    {
        int best = cell;
        double best_score = 0;
        for (int c = 0; c < int(inside.size()); ++c) {
            const Index apart = (index(c) - index(cell)).cwiseAbs();
            if (apart.maxCoeff() != 1) continue;
            const double score = inside[c].volume / apart.sum();
            if (score > best_score) {
                best = c;
                best_score = score;
            }
        }
        return best;
    }

    int region_count() const
    {
        return int(std::count_if(region.begin(), region.end(), [](const auto& r) { return r.volume > 0; }));
    }

    Index cell_of(const Vec<Dim>& x) const { return ((x - origin) / width).array().floor().template cast<int>(); }
    /// A node stands in the middle of each cell (Greville abscissa of the quadratic B-spline).
    Vec<Dim> node_position(const Index& cell) const
    {
        return origin + width * (cell.template cast<double>() + Vec<Dim>::Constant(0.5));
    }
};

template <int Dim>
int Discretisation<Dim>::points_with(const Outline<Dim>& outline, const Resolution& resolution, double cells_across)
{
    return power(2, Dim) * Cells(outline, resolution, cells_across).region_count();
}

namespace {

    template <int Dim> int cells_for(const Outline<Dim>& outline, const Resolution& resolution)
    {
        int best = 0, best_miss = 0;
        for (int cells = 1; cells <= 2000; ++cells) {
            const int count = Discretisation<Dim>::points_with(outline, resolution, cells);
            const int miss = std::abs(count - resolution.points);
            if (best == 0 || miss < best_miss) {
                best = cells;
                best_miss = miss;
            }
            if (count > 2 * resolution.points) break;
        }
        return best;
    }

    /// Shape functions and gradients of the stencil around a position, with the cell counted from its node.
    template <int Dim> struct Stencil {
        static constexpr int count = power(3, Dim);
        std::array<Eigen::Matrix<int, Dim, 1>, count> cell;
        std::array<double, count> value;
        std::array<Vec<Dim>, count> gradient;

        Stencil(const Vec<Dim>& x, const Vec<Dim>& middle, const Eigen::Matrix<int, Dim, 1>& home, double width)
        {
            std::vector<QuadraticBSpline> axis;
            for (int d = 0; d < Dim; ++d)
                axis.emplace_back((x[d] - middle[d]) / width);
            for (int k = 0; k < count; ++k) {
                value[k] = 1;
                gradient[k].setOnes();
                for (int d = 0, rest = k; d < Dim; ++d, rest /= 3) {
                    const int i = rest % 3;
                    cell[k][d] = home[d] + i - 1;
                    value[k] *= axis[d].value[i];
                    for (int e = 0; e < Dim; ++e)
                        gradient[k][e] *= e == d ? axis[d].slope[i] / width : axis[d].value[i];
                }
            }
        }
    };

    template <int Dim> struct IndexLess {
        bool operator()(const Eigen::Matrix<int, Dim, 1>& a, const Eigen::Matrix<int, Dim, 1>& b) const
        {
            return std::lexicographical_compare(a.data(), a.data() + Dim, b.data(), b.data() + Dim);
        }
    };

} // namespace

template <int Dim> Discretisation<Dim>::Discretisation(const Outline<Dim>& outline, const Resolution& resolution)
{
    const Cells cells(outline, resolution, cells_for(outline, resolution));
    cell_width = cells.width;
    node_threshold = resolution.threshold();
    place_points(cells, resolution.mean_dilatation);
    place_surface(outline, cells, resolution.surface_spacing * cell_width);
    bind_slaves(node_threshold * *std::max_element(node_mass.begin(), node_mass.end()));
    for (double mass : node_mass)
        inverse_mass.push_back(1 / mass);
    average_gradients();
    build_delassus();
}

template <int Dim> void Discretisation<Dim>::place_points(const Cells& cells, bool mean_dilatation)
{
    std::map<typename Cells::Index, int, IndexLess<Dim>> node_of;
    int full_cell = -1; // where the gradients of full cells are
    for (int c = 0; c < int(cells.region.size()); ++c) {
        const Moments<Dim>& region = cells.region[c];
        if (region.volume == 0) continue;
        // 2^Dim points at centroid + L (+-1, +-1), L the symmetric root of the covariance: they carry the exact
        // volume, centroid and second moments of the region, and are the 2-point Gauss rule in a full cell.
        const Eigen::SelfAdjointEigenSolver<Mat<Dim>> spectrum(region.covariance());
        const Mat<Dim> root = spectrum.operatorSqrt();
        constexpr int count = power(2, Dim);
        // points of one region that lie in one cell make a block
        std::map<typename Cells::Index, std::vector<Vec<Dim>>, IndexLess<Dim>> by_cell;
        for (int k = 0; k < count; ++k) {
            Vec<Dim> corner;
            for (int d = 0; d < Dim; ++d)
                corner[d] = (k >> d) % 2 ? 1 : -1;
            const Vec<Dim> x = region.centroid() + root * corner;
            by_cell[cells.cell_of(x)].push_back(x);
        }
        const bool full = cells.full[c];
        const double pointwise = !mean_dilatation ? 1 : full ? 0 : 0.8;
        regions.push_back({ int(blocks.size()), int(by_cell.size()), region.volume, full, pointwise });
        for (const auto& [cell, positions] : by_cell) {
            const int in_block = int(positions.size());
            const bool known = full && full_cell >= 0;
            Block block { point_count(), in_block, known ? full_cell : int(gradient.size()), {} };
            if (!known) gradient.resize(gradient.size() + size_t(stencil) * in_block * Dim);
            if (full) full_cell = block.gradient;
            for (int q = 0; q < in_block; ++q) {
                const Vec<Dim>& x = positions[q];
                const Stencil<Dim> shape(x, cells.node_position(cell), cell, cell_width);
                for (int k = 0; k < stencil; ++k) {
                    const auto [entry, added] = node_of.try_emplace(shape.cell[k], node_count());
                    if (added) {
                        node_position.push_back(cells.node_position(shape.cell[k]));
                        node_mass.push_back(0);
                    }
                    block.node[k] = entry->second;
                    node_mass[entry->second] += region.volume / count * shape.value[k];
                    this->shape.push_back(shape.value[k]);
                    if (!known)
                        std::copy(shape.gradient[k].data(), shape.gradient[k].data() + Dim,
                                  &gradient[block.gradient + size_t(k * in_block + q) * Dim]);
                }
                point_position.push_back(x);
                point_volume.push_back(region.volume / count);
                moments += Moments<Dim> { region.volume / count, region.volume / count * x,
                                          region.volume / count * x * x.transpose() };
            }
            blocks.push_back(block);
        }
    }
}

template <int Dim> void Discretisation<Dim>::place_surface(const Outline<Dim>& outline, const Cells& cells, double spacing)
{
    std::map<typename Cells::Index, int, IndexLess<Dim>> node_of;
    for (int i = 0; i < node_count(); ++i)
        node_of[cells.cell_of(node_position[i])] = i;
    surface = outline.sample(spacing);
    for (const auto& point : surface) {
        const typename Cells::Index home = cells.cell_of(point.position);
        const Stencil<Dim> shape(point.position, cells.node_position(home), home, cell_width);
        SurfaceStencil entry;
        for (int k = 0; k < stencil; ++k) {
            const auto [found, added] = node_of.try_emplace(shape.cell[k], node_count());
            if (added) {
                node_position.push_back(cells.node_position(shape.cell[k]));
                node_mass.push_back(0);
            }
            entry.node[k] = found->second;
            entry.weight[k] = shape.value[k];
        }
        surface_stencil.push_back(entry);
    }
}

template <int Dim> void Discretisation<Dim>::bind_slaves(double threshold)
{
    // renumber: masters first
    std::vector<int> order(node_count());
    for (int i = 0; i < node_count(); ++i)
        order[i] = i;
    std::stable_partition(order.begin(), order.end(), [&](int i) { return node_mass[i] >= threshold; });
    std::vector<int> number(node_count());
    std::vector<Vec<Dim>> positions;
    std::vector<double> masses;
    for (int i = 0; i < node_count(); ++i) {
        number[order[i]] = i;
        positions.push_back(node_position[order[i]]);
        masses.push_back(node_mass[order[i]]);
    }
    node_position = positions;
    master_count = int(std::count_if(masses.begin(), masses.end(), [&](double m) { return m >= threshold; }));
    for (auto& block : blocks)
        for (auto& node : block.node)
            node = number[node];
    for (auto& entry : surface_stencil)
        for (auto& node : entry.node)
            node = number[node];

    // A slave is the linear extrapolation of near masters.
    node_mass.assign(masses.begin(), masses.begin() + master_count);
    slave_row.push_back(0);
    for (int s = master_count; s < node_count(); ++s) {
        for (double reach = 2.3;; reach += 1) {
            std::vector<int> near;
            std::vector<Vec<Dim>> places;
            for (int m = 0; m < master_count; ++m)
                if ((node_position[m] - node_position[s]).norm() < reach * cell_width) {
                    near.push_back(m);
                    places.push_back(node_position[m]);
                }
            std::vector<double> weights;
            if (!extrapolate<Dim>(node_position[s], places, cell_width, weights)) {
                if (reach > 100)
                    throw UserError("soft grain: the shape is too thin for its grid of cells " + shown(cell_width)
                                    + " radii wide; give more points.");
                continue;
            }
            for (size_t k = 0; k < near.size(); ++k) {
                if (std::abs(weights[k]) < 1e-14) continue;
                links.push_back({ near[k], weights[k] });
                node_mass[near[k]] += weights[k] * masses[s];
            }
            slave_row.push_back(int(links.size()));
            break;
        }
    }
}

template <int Dim> void Discretisation<Dim>::average_gradients()
{
    std::vector<double> all(Dim * node_position.size(), 0);
    for (const Block& block : blocks)
        for (int p = block.first_point; p < block.first_point + block.point_count; ++p)
            for (int k = 0; k < stencil; ++k)
                for (int d = 0; d < Dim; ++d)
                    all[size_t(Dim) * block.node[k] + d] += point_volume[p] / moments.volume * gradient_at(block, p, k)[d];
    each_link([&](int slave, int master, double weight) {
        for (int d = 0; d < Dim; ++d)
            all[size_t(Dim) * master + d] += weight * all[size_t(Dim) * slave + d];
    });
    mean_gradient.assign(all.begin(), all.begin() + size_t(Dim) * master_count);
}

template <int Dim> void Discretisation<Dim>::build_delassus()
{
    // Rows of the interpolation at the surface with the slaves folded into their masters.
    std::vector<std::map<int, double>> folded(surface_count());
    for (int p = 0; p < surface_count(); ++p)
        for (int k = 0; k < stencil; ++k) {
            const int node = surface_stencil[p].node[k];
            const double weight = surface_stencil[p].weight[k];
            if (node < master_count)
                folded[p][node] += weight;
            else
                each_link([&](int slave, int master, double share) {
                    if (slave == node) folded[p][master] += weight * share;
                });
        }
    std::vector<typename SurfaceOperator<Dim>::Row> rows;
    for (const auto& row : folded)
        rows.emplace_back(row.begin(), row.end());
    this->build(rows, node_mass);
}

template <int Dim> Vec<Dim> Discretisation<Dim>::at_surface(int point, const double* field) const
{
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (int k = 0; k < stencil; ++k)
        sum += surface_stencil[point].weight[k]
            * Eigen::Map<const Vec<Dim>>(field + size_t(Dim) * surface_stencil[point].node[k]);
    return sum;
}

template <int Dim> bool Discretisation<Dim>::is_concave() const
{
    constexpr double straight = 1e-6; // sine of an angle
    const size_t n = surface.size();
    for (size_t p = 0; p < n; ++p) {
        const Vec<Dim> before = (surface[p].position - surface[(p + n - 1) % n].position).normalized(),
                       after = (surface[(p + 1) % n].position - surface[p].position).normalized();
        if (before.x() * after.y() - before.y() * after.x() < -straight) return true;
    }
    return false;
}

template class Discretisation<2>;

} // namespace softgrain
