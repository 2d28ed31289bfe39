// SPDX-License-Identifier: GPL-2.0-or-later
#include "grid/point_grid.hpp"

#include "grid/bspline.hpp"
#include "grid/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {

/// The box of cells that the stencils of points and surface points reach; a node stands in the middle of each.
template <int Dim> struct PointGrid<Dim>::Window {
    Vec<Dim> anchor;
    double width;
    Index first, size;

    Window(const std::vector<Vec<Dim>>& points, const std::vector<Vec<Dim>>& surface, const Vec<Dim>& anchor_, double width_)
        : anchor(anchor_)
        , width(width_)
        , first(home(points[0]))
        , size(first)
    {
        for (const auto* places : { &points, &surface })
            for (const Vec<Dim>& x : *places) {
                first = first.cwiseMin(home(x));
                size = size.cwiseMax(home(x));
            }
        size += Index::Constant(3) - first;
        first -= Index::Ones();
    }

    int count() const { return size.prod(); }
    /// Cell that holds x.
    Index home(const Vec<Dim>& x) const { return ((x - anchor) / width).array().round().template cast<int>(); }
    Vec<Dim> middle(const Index& cell) const { return anchor + width * cell.template cast<double>(); }
    /// Place of a cell in the window.
    int place(const Index& cell) const
    {
        int at = 0;
        for (int d = Dim - 1; d >= 0; --d)
            at = at * size[d] + cell[d] - first[d];
        return at;
    }
    Index cell(int place) const
    {
        Index at;
        for (int d = 0; d < Dim; ++d) {
            at[d] = first[d] + place % size[d];
            place /= size[d];
        }
        return at;
    }

    /// Calls visit(place, shape function, gradient) for the stencil around x.
    template <class Visit> void each_shape(const Vec<Dim>& x, const Visit& visit) const
    {
        const Index at = home(x);
        const Vec<Dim> from_middle = (x - middle(at)) / width;
        std::array<std::array<double, 3>, Dim> value, slope;
        for (int d = 0; d < Dim; ++d) {
            const QuadraticBSpline axis(from_middle[d]);
            value[d] = axis.value;
            slope[d] = axis.slope;
        }
        for (int k = 0; k < power(3, Dim); ++k) {
            Index cell = at;
            double shape = 1;
            Vec<Dim> gradient = Vec<Dim>::Constant(1 / width);
            for (int d = 0, rest = k; d < Dim; ++d, rest /= 3) {
                const int i = rest % 3;
                cell[d] += i - 1;
                shape *= value[d][i];
                for (int e = 0; e < Dim; ++e)
                    gradient[e] *= e == d ? slope[d][i] : value[d][i];
            }
            visit(place(cell), shape, gradient);
        }
    }
};

template <int Dim>
void PointGrid<Dim>::lay(const std::vector<Vec<Dim>>& points, const std::vector<double>& masses,
                         const std::vector<Vec<Dim>>& surface, const Vec<Dim>& anchor, double width, double threshold)
{
    const Window window(points, surface, anchor, width);
    std::vector<double> mass(window.count(), 0);
    std::vector<char> touched(window.count(), false);
    for (size_t p = 0; p < points.size(); ++p)
        window.each_shape(points[p], [&](int place, double shape, const Vec<Dim>&) {
            mass[place] += masses[p] * shape;
            touched[place] = true;
        });
    for (const Vec<Dim>& x : surface)
        window.each_shape(x, [&](int place, double, const Vec<Dim>&) { touched[place] = true; });
    std::vector<int> number; // of the masters, by place; -1: none
    const double least = threshold * *std::max_element(mass.begin(), mass.end());
    std::vector<char> master(window.count());
    for (int place = 0; place < window.count(); ++place)
        master[place] = mass[place] >= least;
    do {
        place_nodes(window, master, number);
        bind_slaves(window, number, touched);
    } while (!fold_masses(mass, number, least / 3, master));

    // entries of the masters, each once
    std::vector<int> where(node_count(), -1);
    const auto add = [&](int begin, int node, double weight, const Vec<Dim>& gradient) {
        int& at = where[node];
        if (at < begin) {
            at = int(entry.size());
            entry.push_back({ node, 0, Vec<Dim>::Zero() });
        }
        entry[at].weight += weight;
        entry[at].gradient += gradient;
    };
    const auto fold = [&](const Vec<Dim>& x) {
        const int begin = int(entry.size());
        window.each_shape(x, [&](int place, double shape, const Vec<Dim>& gradient) {
            if (number[place] >= 0)
                add(begin, number[place], shape, gradient);
            else
                for (int k = link_row_[place]; k < link_row_[place + 1]; ++k)
                    add(begin, links_[k].first, links_[k].second * shape, links_[k].second * gradient);
        });
    };
    entry.clear();
    surface_row.resize(surface.size());
    for (size_t s = 0; s < surface.size(); ++s) {
        fold(surface[s]);
        surface_row[s].clear();
        for (const Entry& e : entry)
            surface_row[s].push_back({ e.node, e.weight });
        for (const Entry& e : entry)
            where[e.node] = -1;
        entry.clear();
    }
    point_row.assign(1, 0);
    for (const Vec<Dim>& x : points) {
        fold(x);
        point_row.push_back(int(entry.size()));
    }
    response.build(surface_row, node_mass);
}

/// Numbers the masters and sets their positions.
template <int Dim>
void PointGrid<Dim>::place_nodes(const Window& window, const std::vector<char>& master, std::vector<int>& number)
{
    number.assign(window.count(), -1);
    node_position.clear();
    for (int place = 0; place < window.count(); ++place)
        if (master[place]) {
            number[place] = node_count();
            node_position.push_back(window.middle(window.cell(place)));
        }
}

/// Masses of the masters with those of their slaves. Extrapolation has negative weights, which may leave a master with less
/// than `least`: such ones are no masters, and the answer is false.
template <int Dim>
bool PointGrid<Dim>::fold_masses(const std::vector<double>& mass, const std::vector<int>& number, double least,
                                 std::vector<char>& master)
{
    node_mass.assign(node_count(), 0);
    for (size_t place = 0; place < mass.size(); ++place) {
        if (number[place] >= 0) node_mass[number[place]] += mass[place];
        for (int k = link_row_[place]; k < link_row_[place + 1]; ++k)
            node_mass[links_[k].first] += links_[k].second * mass[place];
    }
    bool sound = true;
    for (size_t place = 0; place < mass.size(); ++place)
        if (number[place] >= 0 && node_mass[number[place]] < least) {
            master[place] = false;
            sound = false;
        }
    return sound;
}

/// Links of the nodes that points touch and that are no masters.
template <int Dim>
void PointGrid<Dim>::bind_slaves(const Window& window, const std::vector<int>& number, const std::vector<char>& touched)
{
    std::vector<int> near;
    std::vector<Vec<Dim>> places;
    std::vector<double> weights;
    link_row_.assign(1, 0);
    links_.clear();
    for (int place = 0; place < window.count(); ++place) {
        for (double reach = 2.3; touched[place] && number[place] < 0; reach += 1) {
            const Index cell = window.cell(place), farthest = Index::Constant(int(reach));
            const Index lo = (cell - farthest).cwiseMax(window.first);
            const Index hi = (cell + farthest).cwiseMin(window.first + window.size - Index::Ones());
            if (reach > 2.3 + window.size.maxCoeff())
                throw SimulationError("its material points have scattered too far for a grid of cells " + shown(window.width)
                                      + " radii wide");
            near.clear();
            places.clear();
            const Index extent = hi - lo + Index::Ones();
            for (int k = 0; k < extent.prod(); ++k) {
                Index other = lo;
                for (int d = 0, rest = k; d < Dim; rest /= extent[d], ++d)
                    other[d] += rest % extent[d];
                const int master = number[window.place(other)];
                if (master < 0 || (other - cell).template cast<double>().norm() >= reach) continue;
                near.push_back(master);
                places.push_back(node_position[master]);
            }
            if (!extrapolate<Dim>(window.middle(cell), places, window.width, weights)) continue;
            for (size_t k = 0; k < near.size(); ++k)
                if (std::abs(weights[k]) >= 1e-14) links_.push_back({ near[k], weights[k] });
            break;
        }
        link_row_.push_back(int(links_.size()));
    }
}

template class PointGrid<2>;

} // namespace softgrain
