// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/updated.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    /// A cell is out of shape when it has been strained against the mean of the grain so that a principal stretch is over this
    /// number or below its inverse.
    constexpr double most_stretch = 3;

    template <int Dim> Tensor<Dim, double> tensor(const Mat<Dim>& matrix)
    {
        Tensor<Dim, double> result;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                result.at[i][j] = matrix(i, j);
        return result;
    }

    /// The larger of the largest principal stretch and the inverse of the smallest.
    double largest_stretch(const Mat<2>& F)
    {
        const double half_sum = F.squaredNorm() / 2, J = F.determinant();
        const double largest = std::sqrt(half_sum + std::sqrt(std::max(0.0, half_sum * half_sum - J * J)));
        return std::max(largest, largest / std::abs(J));
    }

    double cross(const Vec<2>& a, const Vec<2>& b) { return a[0] * b[1] - a[1] * b[0]; }
    Vec<2> turned(double rate, const Vec<2>& arm) { return rate * Vec<2>(-arm[1], arm[0]); }

} // namespace

template <int Dim> void UpdatedBody<Dim>::place(const Discretisation<Dim>& mesh, const Mat<Dim>& deformation_gradient)
{
    position_.clear();
    surface_.clear();
    for (const Vec<Dim>& X : mesh.point_position)
        position_.push_back(deformation_gradient * X);
    for (const auto& point : mesh.surface)
        surface_.push_back(deformation_gradient * point.position);
    deformation_.assign(position_.size(), deformation_gradient);
    lay(mesh);
    node_velocity_.assign(grid_.node_count(), Vec<Dim>::Zero());
}

template <int Dim> void UpdatedBody<Dim>::settle(const Discretisation<Dim>& mesh)
{
    if (largest_stretch(mesh) <= most_stretch) return;
    const Whole before = whole();
    const std::vector<Vec<Dim>> velocity = point_velocities();
    std::vector<Mat<Dim>> rate;
    for (int p = 0; p < int(velocity.size()); ++p)
        rate.push_back(gradient_at(node_velocity_, p) * gradient_at(grid_.node_position, p).inverse());
    lay(mesh);
    gather(mesh.point_volume, velocity, rate);
    keep(before);
}

/// Of the points against the mean of the grain, since the grid was laid.
template <int Dim> double UpdatedBody<Dim>::largest_stretch(const Discretisation<Dim>& mesh) const
{
    const Mat<Dim> back = mean_deformation(mesh).inverse();
    double largest = 1;
    for (int p = 0; p < int(position_.size()); ++p)
        largest = std::max(largest, softgrain::largest_stretch(back * gradient_at(grid_.node_position, p) * laid_.mean));
    return largest;
}

template <int Dim> Mat<Dim> UpdatedBody<Dim>::mean_deformation(const Discretisation<Dim>& mesh) const
{
    Mat<Dim> mean = Mat<Dim>::Zero();
    for (size_t p = 0; p < deformation_.size(); ++p)
        mean += mesh.point_volume[p] / mesh.moments.volume * deformation_[p];
    return mean;
}

/// In the space that the mean deformation maps on the grain.
template <int Dim> void UpdatedBody<Dim>::lay(const Discretisation<Dim>& mesh)
{
    laid_ = { position_, surface_, deformation_, mean_deformation(mesh) };
    const Mat<Dim> back = laid_.mean.inverse();
    std::vector<Vec<Dim>> points, surface;
    for (const Vec<Dim>& x : position_)
        points.push_back(back * x);
    for (const Vec<Dim>& x : surface_)
        surface.push_back(back * x);
    grid_.lay(points, mesh.point_volume, surface, mesh.node_position[0], mesh.cell_width, mesh.node_threshold);
    for (Vec<Dim>& x : grid_.node_position)
        x = laid_.mean * x;
    for (auto& entry : grid_.entry)
        entry.gradient = back.transpose() * entry.gradient;
}

/// Velocities of the nodes: means over the points of what each says from its velocity and its gradient (Jiang, Schroeder,
/// Selle, Teran and Stomakhin 2015). Keeps momentum, and what is linear in space.
template <int Dim>
void UpdatedBody<Dim>::gather(const std::vector<double>& masses, const std::vector<Vec<Dim>>& velocity,
                              const std::vector<Mat<Dim>>& rate)
{
    node_velocity_.assign(grid_.node_count(), Vec<Dim>::Zero());
    for (size_t p = 0; p < velocity.size(); ++p)
        for (int k = grid_.point_row[p]; k < grid_.point_row[p + 1]; ++k) {
            const auto& [node, weight, gradient] = grid_.entry[k];
            node_velocity_[node] += masses[p] * weight / grid_.node_mass[node]
                * (velocity[p] + rate[p] * (grid_.node_position[node] - position_[p]));
        }
}

template <int Dim> typename UpdatedBody<Dim>::Whole UpdatedBody<Dim>::whole() const
{
    Whole sum;
    for (int i = 0; i < grid_.node_count(); ++i) {
        const double m = grid_.node_mass[i];
        sum.mass += m;
        sum.centre += m * grid_.node_position[i];
        sum.velocity += m * node_velocity_[i];
        sum.kinetic += m / 2 * node_velocity_[i].squaredNorm();
    }
    sum.centre /= sum.mass;
    sum.velocity /= sum.mass;
    for (int i = 0; i < grid_.node_count(); ++i) {
        const Vec<Dim> arm = grid_.node_position[i] - sum.centre;
        sum.spin += grid_.node_mass[i] * cross(arm, node_velocity_[i]);
        sum.inertia += grid_.node_mass[i] * arm.squaredNorm();
    }
    return sum;
}

/// The lumped masses of a new grid have another moment of inertia than those of the last, and the mean over points filters: a
/// rigid spin keeps the angular momentum, a factor on what is no rigid motion the kinetic energy (projection on invariants,
/// Hairer, Lubich and Wanner 2006, section IV.4).
template <int Dim> void UpdatedBody<Dim>::keep(const Whole& before)
{
    constexpr double most = 2; // what is left of a motion that is all but rigid is round-off
    const Whole now = whole();
    const auto of_rigid
        = [&](double spin) { return now.mass / 2 * now.velocity.squaredNorm() + spin * spin / (2 * now.inertia); };
    const double wanted = before.kinetic - of_rigid(before.spin), found = now.kinetic - of_rigid(now.spin);
    const double factor = found > 0 ? std::min(std::sqrt(std::max(wanted, 0.0) / found), most) : 1;
    for (int i = 0; i < grid_.node_count(); ++i) {
        const Vec<Dim> arm = grid_.node_position[i] - now.centre;
        const Vec<Dim> rest = node_velocity_[i] - now.velocity - turned(now.spin / now.inertia, arm);
        node_velocity_[i] = now.velocity + turned(before.spin / now.inertia, arm) + factor * rest;
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
            P[q] = tensor<Dim>(deformation_[first + q]);
        const double J = law.region_stress(parameters, mesh.regions[r].pointwise, -mesh.regions[r].volume / points, P);
        if (!(J >= smallest)) smallest = J; // also when it is no number
        for (int q = 0; q < points; ++q) {
            const int p = first + q;
            Mat<Dim> first_piola;
            for (int i = 0; i < Dim; ++i)
                for (int j = 0; j < Dim; ++j)
                    first_piola(i, j) = P[q].at[i][j];
            const Mat<Dim> since_laid = first_piola * laid_.deformation[p].transpose(); // times -V_p
            for (int k = grid_.point_row[p]; k < grid_.point_row[p + 1]; ++k)
                force_[grid_.entry[k].node] += since_laid * grid_.entry[k].gradient;
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
        grid_.node_position[i] += dt * node_velocity_[i];
    return arrive();
}

template <int Dim> void UpdatedBody<Dim>::put(int node, const Vec<Dim>& position, const Vec<Dim>& velocity)
{
    grid_.node_position[node] = position;
    node_velocity_[node] = velocity;
}

template <int Dim> bool UpdatedBody<Dim>::arrive()
{
    for (const auto* field : { &grid_.node_position, &node_velocity_ })
        for (const Vec<Dim>& value : *field)
            if (!value.allFinite()) return false;
    for (int p = 0; p < int(position_.size()); ++p) {
        position_[p] = at_point(grid_.node_position, p);
        deformation_[p] = gradient_at(grid_.node_position, p) * laid_.deformation[p];
    }
    for (size_t s = 0; s < surface_.size(); ++s)
        surface_[s] = at_surface(grid_.node_position, int(s));
    return true;
}

template <int Dim>
void UpdatedBody<Dim>::add_velocity(const Vec<Dim>& centre, const Vec<Dim>& of_centre, const Mat<Dim>& gradient)
{
    for (int i = 0; i < grid_.node_count(); ++i)
        node_velocity_[i] += of_centre + gradient * (grid_.node_position[i] - centre);
}

template <int Dim> Vec<Dim> UpdatedBody<Dim>::at_surface(const std::vector<Vec<Dim>>& field, int point) const
{
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (const auto& [node, weight] : grid_.surface_row[point])
        sum += weight * field[node];
    return sum;
}

template <int Dim> Vec<Dim> UpdatedBody<Dim>::at_point(const std::vector<Vec<Dim>>& field, int point) const
{
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (int k = grid_.point_row[point]; k < grid_.point_row[point + 1]; ++k)
        sum += grid_.entry[k].weight * field[grid_.entry[k].node];
    return sum;
}

template <int Dim> Mat<Dim> UpdatedBody<Dim>::gradient_at(const std::vector<Vec<Dim>>& field, int point) const
{
    Mat<Dim> sum = Mat<Dim>::Zero();
    for (int k = grid_.point_row[point]; k < grid_.point_row[point + 1]; ++k)
        sum += field[grid_.entry[k].node] * grid_.entry[k].gradient.transpose();
    return sum;
}

template <int Dim> Vec<Dim> UpdatedBody<Dim>::velocity_at_surface(int point) const
{
    return at_surface(node_velocity_, point);
}

template <int Dim> std::vector<Vec<Dim>> UpdatedBody<Dim>::point_velocities() const
{
    std::vector<Vec<Dim>> velocity;
    for (int p = 0; p < int(position_.size()); ++p)
        velocity.push_back(at_point(node_velocity_, p));
    return velocity;
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
    const Mat<Dim> mean = mean_deformation(mesh);
    for (int a = 0; a < Dim; ++a)
        for (int b = 0; b < Dim; ++b)
            total[Sums::gradient + Dim * a + b] = mean(a, b) - (a == b);
    return total;
}

template <int Dim>
double UpdatedBody<Dim>::elastic_energy(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law,
                                        const double* parameters, double back, double& min_stretch) const
{
    constexpr int points = power(2, Dim);
    double sum = 0;
    min_stretch = 1e300;
    for (int r = 0, p = 0; r < int(mesh.regions.size()); ++r) {
        Tensor<Dim, double> F[points];
        for (int q = 0; q < points; ++q, ++p) {
            const Mat<Dim> rate = back > 0 ? gradient_at(node_velocity_, p) : Mat<Dim>(Mat<Dim>::Zero());
            F[q] = tensor<Dim>(deformation_[p] - back * rate * laid_.deformation[p]);
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
    add(laid_.position);
    add(laid_.surface);
    add(laid_.deformation);
    add(grid_.node_position);
    add(node_velocity_);
    return values;
}

template <int Dim> bool UpdatedBody<Dim>::unpack(const Discretisation<Dim>& mesh, const std::vector<double>& values)
{
    const size_t of_points = position_.size() * (Dim + Dim * Dim) + surface_.size() * Dim;
    if (values.size() < of_points) return false;
    const double* from = values.data();
    const auto take = [&](auto& items) {
        for (auto& item : items) {
            std::copy(from, from + item.size(), item.data());
            from += item.size();
        }
    };
    take(position_);
    take(surface_);
    take(deformation_);
    lay(mesh);
    node_velocity_.resize(grid_.node_count());
    if (values.size() != of_points + 2 * Dim * node_velocity_.size()) return false;
    take(grid_.node_position);
    take(node_velocity_);
    return arrive();
}

template class UpdatedBody<2>;

} // namespace softgrain
