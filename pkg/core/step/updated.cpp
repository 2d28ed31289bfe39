// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/updated.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    template <int Dim> Tensor<Dim, double> tensor(const Mat<Dim>& matrix)
    {
        Tensor<Dim, double> result;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                result.at[i][j] = matrix(i, j);
        return result;
    }

    double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }

} // namespace

template <int Dim> void UpdatedBody<Dim>::place(const Discretisation<Dim>& mesh, const Mat<Dim>& rotation)
{
    position.clear();
    surface.clear();
    for (const Vec<Dim>& X : mesh.point_position)
        position.push_back(rotation * X);
    for (const auto& point : mesh.surface)
        surface.push_back(rotation * point.position);
    velocity.assign(position.size(), Vec<Dim>::Zero());
    deformation.assign(position.size(), rotation);
    spin.reset();
}

template <int Dim> void UpdatedBody<Dim>::settle(const Discretisation<Dim>& mesh)
{
    grid_.lay(position, mesh.point_volume, surface, mesh.node_position[0], mesh.cell_width, mesh.node_threshold);
    grid_.project(mesh.point_volume, velocity, node_velocity_);
    node_way_.assign(size_t(grid_.node_count()), Vec<Dim>::Zero());
    rate_.resize(position.size(), Mat<Dim>::Zero());
    if (spin)
        restore_spin();
    else
        spin = spin_of_nodes();
}

/// About the centre of mass.
template <int Dim> double UpdatedBody<Dim>::spin_of_nodes() const
{
    double sum = 0, mass = 0;
    Vec<Dim> x = Vec<Dim>::Zero(), v = Vec<Dim>::Zero();
    for (int i = 0; i < grid_.node_count(); ++i) {
        const double m = grid_.node_mass[i];
        mass += m;
        x += m * grid_.node_position[i];
        v += m * node_velocity_[i];
        sum += m * cross(grid_.node_position[i], node_velocity_[i]);
    }
    return sum - cross(x, v) / mass;
}

/// The lumped masses of a new grid have another moment of inertia than those of the last: a rigid spin keeps the angular
/// momentum (projection on an invariant, Hairer, Lubich and Wanner 2006, section IV.4).
template <int Dim> void UpdatedBody<Dim>::restore_spin()
{
    double inertia = 0, mass = 0;
    Vec<Dim> centre = Vec<Dim>::Zero();
    for (int i = 0; i < grid_.node_count(); ++i) {
        mass += grid_.node_mass[i];
        centre += grid_.node_mass[i] * grid_.node_position[i];
    }
    centre /= mass;
    for (int i = 0; i < grid_.node_count(); ++i)
        inertia += grid_.node_mass[i] * (grid_.node_position[i] - centre).squaredNorm();
    const double lacking = (*spin - spin_of_nodes()) / inertia;
    for (int i = 0; i < grid_.node_count(); ++i) {
        const Vec<Dim> arm = grid_.node_position[i] - centre;
        node_velocity_[i] += lacking * Vec<Dim>(-arm[1], arm[0]);
    }
}

template <int Dim>
double UpdatedBody<Dim>::kick(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law, const double* parameters,
                              double scale, const Vec<Dim>& gain)
{
    constexpr int points = power(2, Dim);
    double smallest = 1e300;
    force_.assign(grid_.node_count(), Vec<Dim>::Zero());
    for (int r = 0, first = 0; r < int(mesh.regions.size()); ++r, first += points) {
        Tensor<Dim, double> P[points];
        for (int q = 0; q < points; ++q)
            P[q] = tensor<Dim>(deformation[first + q]);
        const double J = law.region_stress(parameters, mesh.regions[r].pointwise, -mesh.regions[r].volume / points, P);
        if (!(J >= smallest)) smallest = J; // also when it is no number
        for (int q = 0; q < points; ++q) {
            const int p = first + q;
            Mat<Dim> first_piola;
            for (int i = 0; i < Dim; ++i)
                for (int j = 0; j < Dim; ++j)
                    first_piola(i, j) = P[q].at[i][j];
            const Mat<Dim> kirchhoff = first_piola * deformation[p].transpose(); // times -V_p
            for (int k = grid_.point_row[p]; k < grid_.point_row[p + 1]; ++k)
                force_[grid_.entry[k].node] += kirchhoff * grid_.entry[k].gradient;
        }
    }
    for (int i = 0; i < grid_.node_count(); ++i)
        node_velocity_[i] += scale / grid_.node_mass[i] * force_[i] + gain;
    return smallest;
}

template <int Dim> void UpdatedBody<Dim>::push(int surface_point, const Vec<Dim>& impulse)
{
    for (const auto& [node, weight] : grid_.surface_row[surface_point])
        node_velocity_[node] += weight / grid_.node_mass[node] * impulse;
}

template <int Dim> bool UpdatedBody<Dim>::drift(double dt)
{
    for (int i = 0; i < grid_.node_count(); ++i)
        node_way_[i] = dt * node_velocity_[i];
    return arrive(dt);
}

template <int Dim> void UpdatedBody<Dim>::leave(int node, const Vec<Dim>& way, const Vec<Dim>& velocity)
{
    node_way_[node] = way;
    node_velocity_[node] = velocity;
}

template <int Dim> bool UpdatedBody<Dim>::arrive(double dt)
{
    for (const auto* field : { &node_way_, &node_velocity_ })
        for (const Vec<Dim>& value : *field)
            if (!value.allFinite()) return false;
    for (int i = 0; i < grid_.node_count(); ++i)
        grid_.node_position[i] += node_way_[i];
    spin = spin_of_nodes();
    for (size_t p = 0; p < position.size(); ++p) {
        Vec<Dim> way = Vec<Dim>::Zero();
        Mat<Dim> gradient = Mat<Dim>::Zero();
        velocity[p].setZero();
        for (int k = grid_.point_row[p]; k < grid_.point_row[p + 1]; ++k) {
            const auto& entry = grid_.entry[k];
            way += entry.weight * node_way_[entry.node];
            velocity[p] += entry.weight * node_velocity_[entry.node];
            gradient += node_way_[entry.node] * entry.gradient.transpose();
        }
        position[p] += way;
        rate_[p] = gradient / dt;
        deformation[p] += gradient * deformation[p].eval();
    }
    for (size_t s = 0; s < surface.size(); ++s)
        surface[s] += at_surface(node_way_, int(s));
    return true;
}

template <int Dim>
void UpdatedBody<Dim>::add_velocity(const Vec<Dim>& centre, const Vec<Dim>& of_centre, const Mat<Dim>& gradient)
{
    for (size_t p = 0; p < position.size(); ++p)
        velocity[p] += of_centre + gradient * (position[p] - centre);
    for (int i = 0; i < grid_.node_count(); ++i)
        node_velocity_[i] += of_centre + gradient * (grid_.node_position[i] - centre);
    if (spin) spin = spin_of_nodes();
}

template <int Dim> Vec<Dim> UpdatedBody<Dim>::at_surface(const std::vector<Vec<Dim>>& field, int point) const
{
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (const auto& [node, weight] : grid_.surface_row[point])
        sum += weight * field[node];
    return sum;
}

template <int Dim> Vec<Dim> UpdatedBody<Dim>::velocity_at_surface(int point) const
{
    return at_surface(node_velocity_, point);
}

template <int Dim> std::array<double, MotionSums<Dim>::count> UpdatedBody<Dim>::sums(const Discretisation<Dim>& mesh) const
{
    using Sums = MotionSums<Dim>;
    std::array<double, Sums::count> total {};
    for (int i = 0; i < grid_.node_count(); ++i) {
        const double m = grid_.node_mass[i];
        const Vec<Dim>& x = grid_.node_position[i];
        const Vec<Dim> mv = m * node_velocity_[i];
        for (int a = 0, k = 0; a < Dim; ++a) {
            total[Sums::position + a] += m * x[a];
            total[Sums::velocity + a] += mv[a];
            for (int b = a + 1; b < Dim; ++b, ++k)
                total[Sums::spin + k] += x[a] * mv[b] - x[b] * mv[a];
            for (int b = 0; b < Dim; ++b)
                total[Sums::second + Dim * a + b] += m * x[a] * x[b];
        }
        total[Sums::kinetic] += mv.dot(node_velocity_[i]);
    }
    for (size_t p = 0; p < position.size(); ++p)
        for (int a = 0; a < Dim; ++a)
            for (int b = 0; b < Dim; ++b)
                total[Sums::gradient + Dim * a + b]
                    += mesh.point_volume[p] / mesh.moments.volume * (deformation[p](a, b) - (a == b));
    return total;
}

template <int Dim>
double UpdatedBody<Dim>::elastic_energy(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law,
                                        const double* parameters, double dt, double back, double& min_stretch) const
{
    constexpr int points = power(2, Dim);
    double sum = 0;
    min_stretch = 1e300;
    for (int r = 0, first = 0; r < int(mesh.regions.size()); ++r, first += points) {
        Tensor<Dim, double> F[points];
        for (int q = 0; q < points; ++q) {
            const Mat<Dim> one = Mat<Dim>::Identity(), &rate = rate_[first + q], &end = deformation[first + q];
            F[q] = tensor<Dim>(back == 0 ? end : (one + (dt - back) * rate) * (one + dt * rate).inverse() * end);
        }
        sum += law.region_energy(parameters, mesh.regions[r].pointwise, mesh.regions[r].volume, F, min_stretch);
    }
    return sum;
}

template <int Dim> std::vector<double> UpdatedBody<Dim>::packed() const
{
    std::vector<double> values;
    const auto add = [&](const auto& items) {
        for (const auto& item : items)
            values.insert(values.end(), item.data(), item.data() + item.size());
    };
    add(position);
    add(velocity);
    add(deformation);
    add(rate_);
    add(surface);
    values.push_back(*spin);
    return values;
}

template <int Dim> bool UpdatedBody<Dim>::unpack(const std::vector<double>& values)
{
    if (values.size() != position.size() * 2 * (Dim + Dim * Dim) + surface.size() * Dim + 1) return false;
    const double* from = values.data();
    rate_.resize(position.size());
    const auto take = [&](auto& items) {
        for (auto& item : items) {
            std::copy(from, from + item.size(), item.data());
            from += item.size();
        }
    };
    take(position);
    take(velocity);
    take(deformation);
    take(rate_);
    take(surface);
    spin = *from;
    return true;
}

template class UpdatedBody<2>;

} // namespace softgrain
