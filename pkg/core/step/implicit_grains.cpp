// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/implicit_grains.hpp"

#include <cmath>

namespace softgrain {

template <int Dim>
ImplicitGrains<Dim>::ImplicitGrains(Assembly<Dim>& assembly)
    : assembly_(assembly)
    , compliance_(assembly.grains().size())
    , compliance_view_(assembly.grains().size())
    , start_(assembly.grains().size())
    , mark_(assembly.grains().size())
{
    std::map<const Grain<Dim>*, size_t> number;
    for (const Grain<Dim>* grain : assembly.grains())
        number.emplace(grain, number.size());
    for (int b = 0; b < assembly.batch_count(); ++b) {
        Batch<Dim>& batch = assembly.batch(b);
        auto& pattern = patterns_[batch.mesh.get()];
        if (!pattern) pattern = std::make_unique<StiffnessPattern<Dim>>(*batch.mesh);
        if (pattern->most_rows > StiffnessPattern<Dim>::row_limit)
            throw UserError("soft grain #" + std::to_string(assembly.members(b)[0]->id)
                            + ": its grid is too coarse for the implicit scheme; give more points.");
        Part part;
        part.batch = &batch;
        part.members = &assembly.members(b);
        part.pattern = pattern.get();
        const size_t size = size_t(Dim) * pattern->rows * batch.lanes, points = size_t(batch.mesh->surface_count());
        for (AlignedVector* field : { &part.displacement, &part.velocity, &part.force, &part.base, &part.step, &part.stage,
                                      &part.centre, &part.lift, &part.rhs, &part.loads, &part.internal, &part.direction,
                                      &part.residual, &part.conjugate, &part.product })
            field->resize(size);
        for (AlignedVector* field : { &part.inertia, &part.held, &part.factored })
            field->assign(size_t(batch.lanes), 1);
        part.energy.resize(size_t(batch.lanes));
        part.matrix.resize(size_t(pattern->block_count()) * Dim * Dim * batch.lanes);
        part.compliance.resize(points * points * Dim * Dim * batch.lanes);
        for (const Grain<Dim>* grain : *part.members)
            part.index.push_back(number.at(grain));
        parts_.push_back(std::move(part));
    }
}

template <int Dim>
void ImplicitGrains<Dim>::begin(double dt, const ImplicitSettings& settings, const Vec<Dim>& gravity,
                                const Prediction& prediction)
{
    settings_ = settings;
    dt_ = dt;
    prediction_ = prediction;
    const double theta = settings.theta;
    each_part([&](Part& part) {
        Batch<Dim>& batch = *part.batch;
        const int lanes = batch.lanes;
        std::copy_n(batch.displacement.begin(), part.displacement.size(), part.displacement.begin());
        std::copy_n(batch.velocity.begin(), part.velocity.size(), part.velocity.begin());
        motion_kernels<Dim>().extend[batch.wide()](batch.data());
        KernelData<Dim> data = batch.data();
        batch.law.internal_force[batch.wide()](data, batch.per_lane.data());
        std::copy_n(data.force, part.force.size(), part.force.begin());
        batch.law.energy[batch.wide()](data, part.energy.data(), batch.per_lane.data());
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            const Grain<Dim>& grain = *(*part.members)[lane];
            start_[part.index[lane]] = mark_[part.index[lane]] = grain.surface.position;
            const double R = grain.radius, mass = grain.density * R * R,
                         shear = grain.law->shear_modulus(grain.parameters.data());
            const Vec<Dim> body = (gravity + grain.acceleration) / R, way = prediction(grain.motion.position) / R;
            const Vec<Dim> centre = (grain.motion.position - grain.origin) / R;
            part.inertia[lane] = settings.quasistatic ? settings.regularisation * shear : mass / (theta * theta * dt * dt);
            for (int i = 0; i < batch.mesh->master_count; ++i) {
                const Vec<Dim> x = batch.mesh->node_position[i]
                    + Vec<Dim>(Eigen::Map<const Vec<Dim>, 0, Eigen::InnerStride<>>(
                        &part.displacement[size_t(i) * Dim * lanes + lane], Eigen::InnerStride<>(lanes)));
                const Vec<Dim> load = body + grain.spin_acceleration * (x - centre);
                for (int d = 0; d < Dim; ++d) {
                    const size_t k = (size_t(i) * Dim + d) * lanes + lane;
                    part.lift[k] = mass * load[d] / part.inertia[lane] * (settings.quasistatic ? 1 : 1 / theta);
                    part.centre[k] = part.displacement[k]
                        + (settings.quasistatic ? way[d]
                                                : dt * part.velocity[k]
                                   + theta * (1 - theta) * dt * dt * part.force[k] * batch.mesh->inverse_mass[i] / mass);
                }
            }
        }
        part.base = part.stage = part.displacement;
    });
}

template <int Dim> void ImplicitGrains<Dim>::aim(Start start)
{
    each_part([&](Part& part) {
        const int lanes = part.batch->lanes;
        part.base = part.displacement;
        std::fill(part.step.begin(), part.step.end(), 0.0);
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            const Grain<Dim>& grain = *(*part.members)[lane];
            const Vec<Dim> way = prediction_(grain.motion.position) / grain.radius;
            for (int i = 0; i < part.batch->mesh->master_count; ++i)
                for (int d = 0; d < Dim; ++d) {
                    const size_t k = (size_t(i) * Dim + d) * lanes + lane;
                    part.step[k] = start == Start::rest ? 0 : start == Start::velocity ? dt_ * part.velocity[k] : way[d];
                }
        }
    });
}

template <int Dim> typename ImplicitGrains<Dim>::Place ImplicitGrains<Dim>::evaluate(double share)
{
    each_part([&](Part& part) {
        Batch<Dim>& batch = *part.batch;
        const int lanes = batch.lanes;
        for (size_t k = 0; k < part.base.size(); ++k)
            batch.displacement[k] = part.base[k] + share * part.step[k];
        KernelData<Dim> data = batch.data();
        motion_kernels<Dim>().observe[batch.wide()](data, batch.sums.data(), batch.extent.data());
        batch.law.energy[batch.wide()](data, batch.per_lane.data(), batch.per_lane.data() + lanes);
        part.potential = 0;
        part.farthest = 0;
        part.sound = true;
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            Grain<Dim>& grain = *(*part.members)[lane];
            double away = 0;
            for (int i = 0; i < batch.mesh->master_count; ++i)
                for (int d = 0; d < Dim; ++d) {
                    const size_t k = (size_t(i) * Dim + d) * lanes + lane;
                    const double apart = batch.displacement[k] - part.centre[k] - part.lift[k];
                    away += batch.mesh->node_mass[i] * apart * apart;
                }
            part.potential += std::pow(grain.radius, Dim) * (batch.per_lane[lane] + 0.5 * part.inertia[lane] * away);
            part.sound &= batch.per_lane[lanes + lane] > 0;
            Surface<Dim>& surface = grain.surface;
            const auto& start = mark_[part.index[lane]];
            double longest = 0;
            for (int p = 0; p < surface.count; ++p) {
                double way = 0;
                for (int d = 0; d < Dim; ++d) {
                    const size_t i = size_t(Dim) * p + d;
                    surface.position[i] = grain.origin[d] + grain.radius * data.surface[i * lanes + lane];
                    way += (surface.position[i] - start[i]) * (surface.position[i] - start[i]);
                }
                longest = std::max(longest, way);
            }
            part.farthest = std::max(part.farthest, std::sqrt(longest) / grain.radius);
        }
    });
    Place place { 0, true };
    farthest_ = 0;
    for (const Part& part : parts_) {
        place.potential += part.potential;
        place.sound &= part.sound && std::isfinite(part.potential);
        farthest_ = std::max(farthest_, part.farthest);
    }
    return place;
}

template <int Dim> void ImplicitGrains<Dim>::settle()
{
    each_part([&](Part& part) { std::copy_n(part.batch->displacement.begin(), part.base.size(), part.base.begin()); });
}

template <int Dim> void ImplicitGrains<Dim>::recentre()
{
    each_part([&](Part& part) {
        std::copy_n(part.batch->displacement.begin(), part.stage.size(), part.stage.begin());
        part.centre = part.stage;
    });
}

template <int Dim> void ImplicitGrains<Dim>::back_to_centre()
{
    each_part([&](Part& part) {
        part.base = part.stage;
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            part.inertia[lane] *= 4;
            for (size_t k = lane; k < part.lift.size(); k += part.batch->lanes)
                part.lift[k] /= 4;
        }
    });
}

template <int Dim> void ImplicitGrains<Dim>::mark()
{
    each_part([&](Part& part) {
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            Surface<Dim>& surface = (*part.members)[lane]->surface;
            surface.travel += part.farthest * surface.size;
            surface.bound();
            mark_[part.index[lane]] = surface.position;
        }
        part.farthest = 0;
    });
    farthest_ = 0;
}

template <int Dim> typename ImplicitGrains<Dim>::Forces ImplicitGrains<Dim>::load(const SurfaceField& contact_forces)
{
    std::vector<Forces> of_grain(compliance_.size());
    each_part([&](Part& part) {
        Batch<Dim>& batch = *part.batch;
        const int lanes = batch.lanes;
        std::fill(part.loads.begin(), part.loads.end(), 0.0);
        add_surface_forces(part, contact_forces, 1, part.loads);
        KernelData<Dim> data = batch.data();
        batch.law.internal_force[batch.wide()](data, batch.per_lane.data());
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            Forces& sum = of_grain[part.index[lane]] = { 0, 0, 0, int(part.index[lane]) };
            for (int r = 0; r < part.pattern->rows; ++r)
                for (int d = 0; d < Dim; ++d) {
                    const int i = part.pattern->master[r];
                    const size_t k = (size_t(i) * Dim + d) * lanes + lane, row = (size_t(r) * Dim + d) * lanes + lane;
                    const double unit = part.inertia[lane] * batch.mesh->node_mass[i];
                    const double inertia = unit * (part.centre[k] - batch.displacement[k]);
                    part.internal[row] = data.force[k];
                    part.rhs[row] = data.force[k] + inertia + unit * part.lift[k] + part.loads[row];
                    sum.unbalanced += part.rhs[row] * part.rhs[row];
                    sum.contact += part.loads[row] * part.loads[row];
                    sum.inertia += inertia * inertia;
                }
            const double unit = std::pow((*part.members)[lane]->radius, 2 * (Dim - 1));
            for (double* value : { &sum.unbalanced, &sum.contact, &sum.inertia })
                *value *= unit;
        }
    });
    Forces total { 0, 0, 0, 0 };
    for (const Forces& sum : of_grain) {
        if (sum.unbalanced > of_grain[size_t(total.worst)].unbalanced) total.worst = sum.worst;
        total.unbalanced += sum.unbalanced;
        total.contact += sum.contact;
        total.inertia += sum.inertia;
    }
    return { std::sqrt(total.unbalanced), std::sqrt(total.contact), std::sqrt(total.inertia), total.worst };
}

template <int Dim> void ImplicitGrains<Dim>::slide(SurfaceField& way) const
{
    for (const Part& part : parts_)
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            const auto& now = (*part.members)[lane]->surface.position;
            const auto& start = start_[part.index[lane]];
            auto& field = way[part.index[lane]];
            for (size_t i = 0; i < now.size(); ++i)
                field[i] = now[i] - start[i];
        }
}

template <int Dim> void ImplicitGrains<Dim>::accept()
{
    const double theta = settings_.quasistatic ? 1 : settings_.theta;
    each_part([&](Part& part) {
        for (size_t k = 0; k < part.displacement.size(); ++k)
            part.batch->velocity[k]
                = ((part.batch->displacement[k] - part.displacement[k]) / dt_ - (1 - theta) * part.velocity[k]) / theta;
    });
}

template <int Dim> void ImplicitGrains<Dim>::velocities(SurfaceField& velocity)
{
    each_part([&](Part& part) {
        const size_t width = size_t(Dim) * part.batch->lanes;
        for (int r = 0; r < part.pattern->rows; ++r)
            std::copy_n(&part.batch->velocity[size_t(part.pattern->master[r]) * width], width,
                        &part.direction[size_t(r) * width]);
        interpolate(part, part.direction, velocity);
    });
}

template <int Dim> void ImplicitGrains<Dim>::exchange_places()
{
    for (size_t g = 0; g < start_.size(); ++g)
        assembly_.grains()[g]->surface.position.swap(start_[g]);
}

template <int Dim> void ImplicitGrains<Dim>::strike(const SurfaceField& impulses, double share)
{
    each_part([&](Part& part) {
        Batch<Dim>& batch = *part.batch;
        const size_t lanes = size_t(batch.lanes);
        std::fill(part.loads.begin(), part.loads.end(), 0.0);
        add_surface_forces(part, impulses, share, part.loads);
        for (int r = 0; r < part.pattern->rows; ++r) {
            const int i = part.pattern->master[r];
            for (size_t d = 0; d < Dim; ++d)
                for (size_t lane = 0; lane < lanes; ++lane)
                    batch.velocity[(size_t(i) * Dim + d) * lanes + lane] += part.loads[(size_t(r) * Dim + d) * lanes + lane]
                        * batch.mesh->inverse_mass[i] * batch.inverse_inertia[lane];
        }
    });
}

// With contact forces that work over the way, the scheme loses, for linear internal forces f,
//     m (v' - v) . [(u' - u) / h - (v' + v) / 2] - (theta - 1/2) (f' - f) . (u' - u).
template <int Dim> typename ImplicitGrains<Dim>::Energy ImplicitGrains<Dim>::energy()
{
    const bool rest = settings_.quasistatic;
    std::vector<Energy> of_part(parts_.size(), Energy {});
    each_part([&](Part& part) {
        Batch<Dim>& batch = *part.batch;
        const int lanes = batch.lanes;
        KernelData<Dim> data = batch.data();
        batch.law.internal_force[batch.wide()](data, batch.per_lane.data());
        batch.law.energy[batch.wide()](data, batch.per_lane.data(), batch.per_lane.data() + lanes);
        Energy& sum = of_part[size_t(&part - parts_.data())];
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            const Grain<Dim>& grain = *(*part.members)[lane];
            const double mass = grain.density * grain.radius * grain.radius, unit = std::pow(grain.radius, Dim);
            const double elastic = batch.per_lane[lane] - part.energy[lane];
            double kinetic = 0, by_contacts = 0, by_loads = 0, lost = 0;
            for (int i = 0; i < batch.mesh->master_count; ++i)
                for (int d = 0; d < Dim; ++d) {
                    const size_t k = (size_t(i) * Dim + d) * lanes + lane;
                    const double way = batch.displacement[k] - part.displacement[k], m = mass * batch.mesh->node_mass[i],
                                 v = batch.velocity[k], before = part.velocity[k];
                    by_contacts += way * part.loads[(size_t(part.pattern->row_of[i]) * Dim + d) * lanes + lane];
                    by_loads
                        += way * part.inertia[lane] * batch.mesh->node_mass[i] * part.lift[k] * (rest ? 1 : settings_.theta);
                    if (rest) continue;
                    kinetic += m * (v * v - before * before) / 2;
                    lost += m * (v - before) * (way / dt_ - (v + before) / 2)
                        - (settings_.theta - 0.5) * (data.force[k] - part.force[k]) * way;
                }
            sum.gained += unit * (kinetic + elastic - by_loads);
            sum.exchanged += unit * (std::abs(kinetic) + std::abs(elastic));
            sum.dissipated += unit * (rest ? by_contacts + by_loads - elastic : lost);
        }
    });
    Energy total {};
    for (const Energy& part : of_part)
        total = { total.gained + part.gained, total.exchanged + part.exchanged, total.dissipated + part.dissipated };
    return total;
}

template <int Dim> void ImplicitGrains<Dim>::restore()
{
    each_part([&](Part& part) {
        std::copy(part.displacement.begin(), part.displacement.end(), part.batch->displacement.begin());
        std::copy(part.velocity.begin(), part.velocity.end(), part.batch->velocity.begin());
        motion_kernels<Dim>().extend[part.batch->wide()](part.batch->data());
        for (size_t lane = 0; lane < part.members->size(); ++lane)
            (*part.members)[lane]->surface.position = start_[part.index[lane]];
    });
}

template class ImplicitGrains<2>;

} // namespace softgrain
