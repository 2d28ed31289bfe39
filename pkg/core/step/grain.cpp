// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/grain.hpp"

#include "step/rigid_flight.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {

template <int Dim> Motion<Dim> motion_of(const Grain<Dim>& grain, const double* sums, int stride)
{
    using Sums = MotionSums<Dim>;
    const double volume = grain.mesh->moments.volume, R = grain.radius;
    const auto at = [&](int entry) { return sums[size_t(entry) * stride]; };
    Motion<Dim> motion;
    Vec<Dim> x, v;
    for (int d = 0; d < Dim; ++d) {
        x[d] = at(Sums::position + d) / volume;
        v[d] = at(Sums::velocity + d) / volume;
        for (int e = 0; e < Dim; ++e) {
            motion.second_moment(d, e) = at(Sums::second + Dim * d + e);
            motion.mean_gradient(d, e) = (d == e) + at(Sums::gradient + Dim * d + e);
        }
    }
    const double mass_unit = grain.density * std::pow(R, Dim);
    motion.position = grain.origin + R * x;
    motion.velocity = R * v;
    motion.second_moment = mass_unit * R * R * (motion.second_moment - volume * x * x.transpose());
    for (int a = 0, k = 0; a < Dim; ++a)
        for (int b = a + 1; b < Dim; ++b, ++k)
            motion.angular_momentum[k] = mass_unit * R * R * (at(Sums::spin + k) - volume * (x[a] * v[b] - x[b] * v[a]));
    motion.kinetic = 0.5 * mass_unit * R * R * at(Sums::kinetic);
    return motion;
}

template <int Dim>
void Grain<Dim>::place(const Vec<Dim>& centre, const Mat<Dim>& rotation, const Vec<Dim>& speed,
                       const Mat<Dim>& velocity_gradient)
{
    batch = nullptr;
    flight.reset();
    origin = centre;
    if (updated) {
        updated->place(*mesh, rotation);
        updated->add_velocity(Vec<Dim>::Zero(), speed / radius, velocity_gradient);
        return refresh();
    }
    forget();
    displacement.resize(size_t(Dim) * mesh->master_count);
    velocity.resize(displacement.size());
    for (int i = 0; i < mesh->master_count; ++i) {
        const Vec<Dim>& X = mesh->node_position[i];
        const Vec<Dim> x = rotation * X, v = speed / radius + velocity_gradient * x;
        for (int d = 0; d < Dim; ++d) {
            displacement[size_t(Dim) * i + d] = x[d] - X[d];
            velocity[size_t(Dim) * i + d] = v[d];
        }
    }
    refresh();
}

template <int Dim> void Grain<Dim>::forget()
{
    memory.clear();
    for (int p = 0; p < mesh->point_count(); ++p)
        memory.insert(memory.end(), law->first_memory, law->first_memory + law->memory_count);
}

template <int Dim> std::vector<double> Grain<Dim>::with_slaves(const std::vector<double>& field) const
{
    std::vector<double> all(field);
    all.resize(size_t(Dim) * mesh->node_count(), 0);
    mesh->each_link([&](int slave, int master, double weight) {
        for (int d = 0; d < Dim; ++d)
            all[size_t(Dim) * slave + d] += weight * all[size_t(Dim) * master + d];
    });
    return all;
}

template <int Dim> Batch<Dim> Grain<Dim>::alone() const
{
    Batch<Dim> batch(mesh, *law, 1);
    batch.set_parameters(0, parameters);
    batch.set_memory(0, memory);
    std::copy(displacement.begin(), displacement.end(), batch.displacement.begin());
    std::copy(velocity.begin(), velocity.end(), batch.velocity.begin());
    motion_kernels<Dim>().observe[0](batch.data(), batch.sums.data(), batch.extent.data());
    return batch;
}

template <int Dim> double Grain<Dim>::elastic_energy()
{
    if (updated) {
        elastic = updated->elastic_energy(*mesh, *law, parameters.data(), 0, min_stretch);
        return elastic *= std::pow(radius, Dim);
    }
    Batch<Dim> batch = alone();
    law->energy[0](batch.data(), &elastic, &min_stretch);
    return elastic *= std::pow(radius, Dim);
}

template <int Dim> void Grain<Dim>::refresh()
{
    surface.resize(mesh->surface_count());
    surface.size = radius;
    surface.mobility = 1 / (density * std::pow(radius, Dim));
    for (int p = 0; p < surface.count; ++p)
        surface.corner[p] = mesh->surface[p].corner;
    if (updated) {
        settle();
        read_velocities(surface.velocity);
    } else
        refresh_from_nodes();
    surface.measure_speed();
    surface.bound();
}

template <int Dim> void Grain<Dim>::read_velocities(std::vector<double>& field) const
{
    for (int p = 0; p < surface.count; ++p) {
        const Vec<Dim> v = radius * updated->velocity_at_surface(p);
        std::copy_n(v.data(), Dim, &field[size_t(Dim) * p]);
    }
}

template <int Dim> void Grain<Dim>::refresh_from_nodes()
{
    if (flight) write_nodes(*this);
    Batch<Dim> alone = this->alone();
    motion = motion_of(*this, alone.sums.data(), 1);
    surface.response = mesh.get();
    const std::vector<double> v = with_slaves(velocity);
    for (int p = 0; p < surface.count; ++p)
        surface.v(p) = radius * mesh->at_surface(p, v.data());
    take_positions(alone.surface());
}

template <int Dim> void Grain<Dim>::take_positions(const double* of_surface)
{
    for (int p = 0; p < surface.count; ++p)
        for (int d = 0; d < Dim; ++d)
            surface.position[size_t(Dim) * p + d] = origin[d] + radius * of_surface[size_t(Dim) * p + d];
    surface.stale = false;
}

template <int Dim> void Grain<Dim>::renew_positions()
{
    if (!surface.stale) return;
    if (flight) return write_positions(*this);
    pull();
    take_positions(alone().surface());
}

template <int Dim> void Grain<Dim>::settle()
{
    updated->settle(*mesh);
    motion = motion_of(*this, updated->sums(*mesh).data(), 1);
    take_positions(updated->surface()[0].data());
}

template <int Dim> void Grain<Dim>::pull()
{
    if (flight) write_nodes(*this);
    if (!batch) return;
    for (size_t i = 0; i < displacement.size(); ++i) {
        displacement[i] = batch->displacement[i * batch->lanes + lane];
        velocity[i] = batch->velocity[i * batch->lanes + lane];
    }
    for (size_t k = 0; k < memory.size(); ++k)
        memory[k] = batch->memory[k * batch->lanes + lane];
}

template <int Dim> void Grain<Dim>::put()
{
    if (!batch) return;
    for (size_t i = 0; i < displacement.size(); ++i) {
        batch->displacement[i * batch->lanes + lane] = displacement[i];
        batch->velocity[i * batch->lanes + lane] = velocity[i];
    }
    batch->set_memory(lane, memory);
}

template <int Dim> void Grain<Dim>::translate(const Vec<Dim>& shift)
{
    origin += shift;
    motion.position += shift;
    for (int p = 0; p < surface.count; ++p)
        Eigen::Map<Vec<Dim>>(&surface.position[size_t(Dim) * p]) += shift;
    surface.travel += shift.norm();
    surface.min += shift;
    surface.max += shift;
}

template <int Dim> void Grain<Dim>::add_velocity(const Vec<Dim>& of_centre, const Mat<Dim>& gradient)
{
    const Vec<Dim> centre = (motion.position - origin) / radius;
    if (flight) {
        motion.velocity += of_centre;
        motion.angular_momentum[0] += gradient(1, 0) * motion.second_moment.trace();
    } else if (updated)
        updated->add_velocity(centre, of_centre / radius, gradient);
    else
        add_to_nodes(centre, of_centre / radius, gradient);
    for (int p = 0; p < surface.count; ++p)
        surface.v(p) += of_centre + gradient * (surface.x(p) - motion.position);
}

template <int Dim> void Grain<Dim>::add_to_nodes(const Vec<Dim>& centre, const Vec<Dim>& of_centre, const Mat<Dim>& gradient)
{
    pull();
    for (int i = 0; i < mesh->master_count; ++i) {
        const Eigen::Map<const Vec<Dim>> u(&displacement[size_t(Dim) * i]);
        Eigen::Map<Vec<Dim>>(&velocity[size_t(Dim) * i]) += of_centre + gradient * (mesh->node_position[i] + u - centre);
    }
    put();
    surface.struck = true;
}

template <int Dim> std::vector<Mat<Dim>> Grain<Dim>::deformation_gradients() const
{
    if (updated) return updated->deformation_gradients();
    constexpr int stencil = Discretisation<Dim>::stencil;
    const std::vector<double> u = with_slaves(displacement);
    std::vector<Mat<Dim>> F(mesh->point_count(), Mat<Dim>::Identity());
    for (const auto& block : mesh->blocks)
        for (int p = block.first_point; p < block.first_point + block.point_count; ++p)
            for (int k = 0; k < stencil; ++k)
                F[p] += Eigen::Map<const Vec<Dim>>(&u[size_t(Dim) * block.node[k]])
                    * mesh->gradient_at(block, p, k).transpose();
    return F;
}

template <int Dim> std::vector<Mat<3>> Grain<Dim>::cauchy_stresses() const
{
    const std::vector<Mat<Dim>> F = deformation_gradients();
    std::vector<Mat<3>> stress;
    std::vector<double> constants(parameters.begin(), parameters.begin() + law->parameter_count);
    constants.resize(constants.size() + law->memory_count);
    for (const auto& region : mesh->regions) {
        const int first = mesh->blocks[region.first_block].first_point, points = power(2, Dim);
        double mean_J = 0;
        for (int p = first; p < first + points; ++p)
            mean_J += F[p].determinant() / points;
        for (int p = first; p < first + points; ++p) {
            Mat<3> whole = Mat<3>::Identity();
            whole.template topLeftCorner<Dim, Dim>() = F[p];
            std::copy_n(memory.data() + size_t(p) * law->memory_count, law->memory_count,
                        constants.data() + law->parameter_count);
            stress.push_back(
                law->cauchy_stress(constants.data(), whole, region.pointwise < 1 ? mean_J : F[p].determinant()));
        }
    }
    return stress;
}

template <int Dim> std::vector<double> Grain<Dim>::plastic_strains() const
{
    std::vector<double> strains(mesh->point_count());
    for (size_t p = 0; p < strains.size() && law->memory_count > 0; ++p)
        strains[p] = memory[(p + 1) * law->memory_count - 1];
    return strains;
}

template <int Dim> std::vector<Vec<Dim>> Grain<Dim>::at_points(const std::vector<double>& field) const
{
    constexpr int stencil = Discretisation<Dim>::stencil;
    const std::vector<double> all = with_slaves(field);
    std::vector<Vec<Dim>> values(mesh->point_count(), Vec<Dim>::Zero());
    for (const auto& block : mesh->blocks)
        for (int p = block.first_point; p < block.first_point + block.point_count; ++p)
            for (int k = 0; k < stencil; ++k)
                values[p]
                    += mesh->shape[size_t(p) * stencil + k] * Eigen::Map<const Vec<Dim>>(&all[size_t(Dim) * block.node[k]]);
    return values;
}

template <int Dim> std::vector<Vec<Dim>> Grain<Dim>::point_positions() const
{
    std::vector<Vec<Dim>> x = updated ? updated->point_positions() : at_points(displacement);
    for (int p = 0; p < mesh->point_count(); ++p) {
        if (!updated) x[p] += mesh->point_position[p];
        x[p] = origin + radius * x[p];
    }
    return x;
}

template <int Dim> std::vector<Vec<Dim>> Grain<Dim>::point_velocities() const
{
    std::vector<Vec<Dim>> v = updated ? updated->point_velocities() : at_points(velocity);
    for (auto& value : v)
        value *= radius;
    return v;
}

template Motion<2> motion_of<2>(const Grain<2>&, const double*, int);
template struct Grain<2>;

} // namespace softgrain
