// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/implicit_grains.hpp"

#include <cmath>
#include <map>

namespace softgrain {

template <int Dim>
ImplicitGrains<Dim>::ImplicitGrains(Assembly<Dim>& assembly)
    : assembly_(assembly)
    , compliance_(assembly.grains().size())
    , compliance_view_(assembly.grains().size())
    , start_(assembly.grains().size())
    , mark_(assembly.grains().size())
    , moved_(assembly.grains().size())
{
    std::map<const Grain<Dim>*, size_t> number;
    for (const Grain<Dim>* grain : assembly.grains()) {
        moved_[number.size()].resize(size_t(Dim) * size_t(grain->surface.count));
        number.emplace(grain, number.size());
    }
    for (auto& body : implicit_bodies(assembly)) {
        Part part;
        for (const Grain<Dim>* grain : body->members)
            part.index.push_back(number.at(grain));
        part.body = std::move(body);
        parts_.push_back(std::move(part));
    }
}

/// Room for the pattern as it is.
template <int Dim> void ImplicitGrains<Dim>::Part::resize()
{
    const size_t size = at(rows(), 0, 0), points = size_t(body->pattern->surface_count());
    if (displacement.size() == size && matrix.size() == size_t(body->pattern->block_count()) * Dim * Dim * lanes()) return;
    for (AlignedVector* field : { &displacement, &velocity, &force, &base, &step, &stage, &place, &arrived, &centre, &lift,
                                  &rhs, &loads, &internal, &direction, &residual, &conjugate, &product })
        field->resize(size);
    for (AlignedVector* field : { &inertia, &held, &factored })
        field->assign(size_t(lanes()), 1);
    energy.resize(size_t(lanes()));
    per_lane.resize(2 * size_t(lanes()));
    matrix.resize(size_t(body->pattern->block_count()) * Dim * Dim * lanes());
    compliance.resize(points * points * Dim * Dim * lanes());
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
        ImplicitBody<Dim>& body = *part.body;
        body.begin();
        part.resize();
        body.state(part.displacement, part.velocity);
        body.forces(part.displacement, part.force);
        body.energy(part.displacement, part.energy.data(), part.per_lane.data());
        std::vector<Vec<Dim>> loads, centres, ways;
        for (size_t lane = 0; lane < body.members.size(); ++lane) {
            const Grain<Dim>& grain = part.grain(lane);
            start_[part.index[lane]] = mark_[part.index[lane]] = grain.surface.position;
            part.inertia[lane] = settings.quasistatic
                ? settings.regularisation * grain.law->shear_modulus(grain.parameters.data())
                : part.mass_unit(lane) / (theta * theta * dt * dt);
            loads.push_back((gravity + grain.acceleration) / grain.radius);
            centres.push_back((grain.motion.position - grain.origin) / grain.radius);
            ways.push_back(prediction(grain.motion.position) / grain.radius);
        }
        part.each_component([&](size_t lane, int r, int d, size_t k) {
            const Grain<Dim>& grain = part.grain(lane);
            const double mass = part.mass_unit(lane);
            double load = loads[lane][d];
            for (int e = 0; e < Dim; ++e)
                load += grain.spin_acceleration(d, e)
                    * (body.pattern->position[size_t(r)][e] + part.displacement[part.at(r, e, lane)] - centres[lane][e]);
            part.lift[k] = mass * load / part.inertia[lane] * (settings.quasistatic ? 1 : 1 / theta);
            part.centre[k] = part.displacement[k]
                + (settings.quasistatic
                       ? ways[lane][d]
                       : dt * part.velocity[k] + theta * (1 - theta) * dt * dt * part.force[k] / (part.mass(r) * mass));
        });
        part.base = part.stage = part.place = part.displacement;
    });
    for (const Part& part : parts_)
        if (part.body->pattern->most_rows > StiffnessPattern<Dim>::row_limit)
            throw SimulationError("soft grain #" + std::to_string(part.grain(0).id)
                                  + ": its material points have scattered too far for the implicit scheme.");
}

template <int Dim> void ImplicitGrains<Dim>::aim(Start start)
{
    each_part([&](Part& part) {
        part.base = part.displacement;
        std::fill(part.step.begin(), part.step.end(), 0.0);
        if (start == Start::rest) return;
        std::vector<Vec<Dim>> ways;
        for (const Grain<Dim>* grain : part.body->members)
            ways.push_back(prediction_(grain->motion.position) / grain->radius);
        part.each_component([&](size_t lane, int, int d, size_t k) {
            part.step[k] = start == Start::velocity ? dt_ * part.velocity[k] : ways[lane][d];
        });
    });
}

template <int Dim> typename ImplicitGrains<Dim>::Place ImplicitGrains<Dim>::evaluate(double share)
{
    each_part([&](Part& part) {
        ImplicitBody<Dim>& body = *part.body;
        for (size_t k = 0; k < part.base.size(); ++k)
            part.place[k] = part.base[k] + share * part.step[k];
        double* smallest = part.per_lane.data() + part.lanes();
        body.energy(part.place, part.per_lane.data(), smallest);
        double away[most_lanes] = {};
        part.each_component([&](size_t lane, int r, int, size_t k) {
            const double apart = part.place[k] - part.centre[k] - part.lift[k];
            away[lane] += part.mass(r) * apart * apart;
        });
        interpolate(part, part.place, moved_);
        part.potential = 0;
        part.farthest = 0;
        part.sound = true;
        for (size_t lane = 0; lane < body.members.size(); ++lane) {
            Grain<Dim>& grain = *body.members[lane];
            part.potential += std::pow(grain.radius, Dim) * (part.per_lane[lane] + 0.5 * part.inertia[lane] * away[lane]);
            part.sound &= smallest[lane] > 0;
            Surface<Dim>& surface = grain.surface;
            const auto& mark = mark_[part.index[lane]];
            double longest = 0;
            for (int p = 0; p < surface.count; ++p) {
                double way = 0;
                for (int d = 0; d < Dim; ++d) {
                    const size_t i = size_t(Dim) * p + d;
                    surface.position[i] = grain.origin[d] + grain.radius * body.pattern->surface_position[size_t(p)][d]
                        + moved_[part.index[lane]][i];
                    way += (surface.position[i] - mark[i]) * (surface.position[i] - mark[i]);
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

template <int Dim> int ImplicitGrains<Dim>::turned_inside_out() const
{
    for (const Part& part : parts_)
        for (size_t lane = 0; lane < part.index.size(); ++lane)
            if (!(part.per_lane[size_t(part.lanes()) + lane] > 0)) return int(part.index[lane]);
    return -1;
}

template <int Dim> void ImplicitGrains<Dim>::settle()
{
    each_part([&](Part& part) { part.base = part.place; });
}

template <int Dim> void ImplicitGrains<Dim>::recentre()
{
    each_part([&](Part& part) { part.stage = part.centre = part.place; });
}

template <int Dim> void ImplicitGrains<Dim>::back_to_centre()
{
    each_part([&](Part& part) {
        part.base = part.stage;
        part.each_component([&](size_t, int, int, size_t k) { part.lift[k] /= 4; });
        for (double& inertia : part.inertia)
            inertia *= 4;
    });
}

template <int Dim> void ImplicitGrains<Dim>::mark()
{
    each_part([&](Part& part) {
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            Surface<Dim>& surface = part.body->members[lane]->surface;
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
        std::fill(part.loads.begin(), part.loads.end(), 0.0);
        add_surface_forces(part, contact_forces, 1, part.loads);
        part.body->forces(part.place, part.internal);
        for (size_t index : part.index)
            of_grain[index] = { 0, 0, 0, int(index) };
        part.each_component([&](size_t lane, int r, int, size_t k) {
            Forces& sum = of_grain[part.index[lane]];
            const double unit = part.inertia[lane] * part.mass(r), inertia = unit * (part.centre[k] - part.place[k]);
            part.rhs[k] = part.internal[k] + inertia + unit * part.lift[k] + part.loads[k];
            sum.unbalanced += part.rhs[k] * part.rhs[k];
            sum.contact += part.loads[k] * part.loads[k];
            sum.inertia += inertia * inertia;
        });
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            Forces& sum = of_grain[part.index[lane]];
            for (double* value : { &sum.unbalanced, &sum.contact, &sum.inertia })
                *value *= std::pow(part.grain(lane).radius, 2 * (Dim - 1));
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
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            const auto& now = part.grain(lane).surface.position;
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
        for (size_t k = 0; k < part.place.size(); ++k)
            part.arrived[k] = ((part.place[k] - part.displacement[k]) / dt_ - (1 - theta) * part.velocity[k]) / theta;
        part.body->leave(part.place, part.arrived);
    });
}

template <int Dim> void ImplicitGrains<Dim>::velocities(SurfaceField& velocity)
{
    each_part([&](Part& part) { interpolate(part, part.arrived, velocity); });
}

template <int Dim> void ImplicitGrains<Dim>::exchange_places()
{
    for (size_t g = 0; g < start_.size(); ++g)
        assembly_.grains()[g]->surface.position.swap(start_[g]);
}

template <int Dim> void ImplicitGrains<Dim>::strike(const SurfaceField& impulses, double share)
{
    each_part([&](Part& part) {
        std::fill(part.loads.begin(), part.loads.end(), 0.0);
        add_surface_forces(part, impulses, share, part.loads);
        part.each_component([&](size_t lane, int r, int, size_t k) {
            part.arrived[k] += part.loads[k] / (part.mass(r) * part.mass_unit(lane));
        });
        part.body->leave(part.place, part.arrived);
    });
}

// With contact forces that work over the way, the scheme loses
//     m (v' - v) . [(u' - u) / h - (v' + v) / 2] - (theta - 1/2) (f' - f) . (u' - u) + E - E' - (f' + f) . (u' - u) / 2.
// The last three terms are nothing for linear internal forces f.
template <int Dim> typename ImplicitGrains<Dim>::Energy ImplicitGrains<Dim>::energy()
{
    const bool rest = settings_.quasistatic;
    std::vector<Energy> of_part(parts_.size(), Energy {});
    each_part([&](Part& part) {
        struct Sums {
            double kinetic = 0, by_contacts = 0, by_loads = 0, lost = 0, middle = 0;
        } of_lane[most_lanes];
        part.body->forces(part.place, part.internal);
        part.body->energy(part.place, part.per_lane.data(), part.per_lane.data() + part.lanes());
        part.each_component([&](size_t lane, int r, int, size_t k) {
            Sums& sum = of_lane[lane];
            const double way = part.place[k] - part.displacement[k], v = part.arrived[k], before = part.velocity[k],
                         m = part.mass_unit(lane) * part.mass(r);
            sum.by_contacts += way * part.loads[k];
            sum.by_loads += way * part.inertia[lane] * part.mass(r) * part.lift[k] * (rest ? 1 : settings_.theta);
            if (rest) return;
            sum.kinetic += m * (v * v - before * before) / 2;
            sum.lost += m * (v - before) * (way / dt_ - (v + before) / 2)
                - (settings_.theta - 0.5) * (part.internal[k] - part.force[k]) * way;
            sum.middle += (part.internal[k] + part.force[k]) * way / 2;
        });
        Energy& energy = of_part[size_t(&part - parts_.data())];
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            const Sums& sum = of_lane[lane];
            const double unit = std::pow(part.grain(lane).radius, Dim), elastic = part.per_lane[lane] - part.energy[lane];
            energy.gained += unit * (sum.kinetic + elastic - sum.by_loads);
            energy.exchanged += unit * (std::abs(sum.kinetic) + std::abs(elastic));
            const double bent = rest ? 0 : -elastic - sum.middle;
            energy.dissipated += unit * (rest ? sum.by_contacts + sum.by_loads - elastic : sum.lost + bent);
            energy.bent += unit * bent;
        }
    });
    Energy total {};
    for (const Energy& part : of_part)
        total = { total.gained + part.gained, total.exchanged + part.exchanged, total.dissipated + part.dissipated,
                  total.bent + part.bent };
    return total;
}

template <int Dim> void ImplicitGrains<Dim>::restore()
{
    each_part([&](Part& part) {
        part.body->leave(part.displacement, part.velocity);
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            Surface<Dim>& surface = part.body->members[lane]->surface;
            surface.position = start_[part.index[lane]];
            surface.bound();
        }
    });
}

template class ImplicitGrains<2>;

} // namespace softgrain
