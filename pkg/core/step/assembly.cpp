// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/assembly.hpp"

#include "step/rigid_flight.hpp"
#include "step/updated_step.hpp"
#include "step/viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace softgrain {
namespace {

    std::string whose(int id) { return "soft grain #" + std::to_string(id); }

    template <int Dim> [[noreturn]] void report_inversion(Grain<Dim>& grain)
    {
        grain.pull();
        const auto F = grain.deformation_gradients();
        int worst = 0;
        for (int p = 1; p < int(F.size()); ++p)
            if (!(F[p].determinant() >= F[worst].determinant())) worst = p;
        throw SimulationError(whose(grain.id) + ": material point " + std::to_string(worst)
                              + " turned inside out (J = " + shown(F[worst].determinant())
                              + "); likely causes: a time step over the stable limit, grains pressed beyond what their "
                                "resolution can follow, an impact near the wave speed, or a start from such points, which "
                                "untangle() mends.");
    }

    template <int Dim> bool is_finite(const Grain<Dim>& grain)
    {
        return std::isfinite(grain.motion.kinetic) && grain.motion.position.allFinite();
    }

    template <int Dim> [[noreturn]] void report_not_finite(Grain<Dim>& grain)
    {
        grain.pull();
        const auto x = grain.point_positions(), v = grain.point_velocities();
        int first = 0;
        while (first + 1 < int(x.size()) && x[first].allFinite() && v[first].allFinite())
            ++first;
        throw SimulationError(whose(grain.id) + ": the motion of material point " + std::to_string(first)
                              + " is no longer a finite number (kinetic energy " + shown(grain.motion.kinetic)
                              + " J); likely causes: a time step over the stable limit or a body moved by hand.");
    }

    template <int Dim> [[noreturn]] void report_leap(const Grain<Dim>& grain, double dt)
    {
        throw SimulationError(whose(grain.id) + ": it moves " + shown(grain.surface.speed * dt / grain.surface.size)
                              + " radii in one step, so that it could pass through other bodies; slow it down (speed "
                              + shown(grain.surface.speed) + " m/s) or take a smaller time step.");
    }

    /// Neighbours one after the other, in rows some three grains high, by where they were put, which a run that goes on after a
    /// break has kept: they are set in motion together.
    template <int Dim> void sort_by_place(std::vector<Grain<Dim>*>& grains)
    {
        double sum = 0;
        for (const Grain<Dim>* grain : grains)
            sum += grain->radius;
        const double row = 6 * sum / double(grains.size());
        std::stable_sort(grains.begin(), grains.end(), [row](const Grain<Dim>* a, const Grain<Dim>* b) {
            for (int d = Dim - 1; d > 0; --d) {
                const double of_a = std::floor(a->origin[d] / row), of_b = std::floor(b->origin[d] / row);
                if (of_a != of_b) return of_a < of_b;
            }
            return a->origin[0] < b->origin[0];
        });
    }

} // namespace

template <int Dim>
Assembly<Dim>::Assembly(std::vector<Grain<Dim>*> grains, bool may_fly)
    : grains_(std::move(grains))
    , seats_(grains_)
    , dissipated_(grains_.size())
{
    std::vector<Grain<Dim>*> seated;
    for (size_t i = 0; i < grains_.size(); ++i) {
        Grain<Dim>& grain = *grains_[i];
        grain.number = int(i);
        grain.pull(); // another assembly may have had it
        grain.surface.wanted = true;
        grain.renew_positions();
        if (grain.updated) {
            updated_.push_back(&grain);
            continue;
        }
        if (grain.flight && !may_fly) softgrain::land(grain);
        if (may_fly && !grain.flight && only_translates(grain)) {
            grain.motion.angular_momentum.setZero(); // round-off
            softgrain::take_off(grain);
        }
        (grain.flight ? flights_ : seated).push_back(&grain);
    }
    sort_by_place(seated);
    for (Grain<Dim>* grain : seated)
        seats_.put_in(*grain);
}

template <int Dim> Assembly<Dim>::~Assembly()
{
    for (Grain<Dim>* grain : grains_) {
        grain->pull();
        grain->batch = nullptr;
    }
}

/// Those of the grains in flight that something is near to deform from now on.
template <int Dim> void Assembly<Dim>::land_touched()
{
    const auto landing = std::stable_partition(flights_.begin(), flights_.end(),
                                               [](const Grain<Dim>* grain) { return !grain->surface.near; });
    for (auto grain = landing; grain != flights_.end(); ++grain) {
        softgrain::land(**grain);
        seats_.put_in(**grain);
    }
    flights_.erase(landing, flights_.end());
}

/// Grains that are ready for it; what their vibration held is lost.
template <int Dim> void Assembly<Dim>::take_off(const std::vector<char>& ready, double dt)
{
    std::vector<double> elastic;
    for (Grain<Dim>* grain : grains_) {
        if (!ready[size_t(grain->number)]) continue;
        seats_.take_out(*grain);
        Batch<Dim> batch = grain->alone();
        energy_over_step(batch, dt, elastic);
        const double before = grain->motion.kinetic + std::pow(grain->radius, Dim) * elastic[0];
        softgrain::take_off(*grain);
        dissipated_[size_t(grain->number)].numerical += before - grain->motion.kinetic - grain->elastic;
        flights_.push_back(grain);
    }
}

template <int Dim> void Assembly<Dim>::predict(double dt, const Vec<Dim>& gravity, int threads)
{
    kick_ = dt;
    gravity_ = gravity;
    land_touched();
    std::fill(dissipated_.begin(), dissipated_.end(), Dissipation {});
    const int count = seats_.count(), single = int(updated_.size());
    least_J_.assign(size_t(count + single), 1);
    if (damping > 0) local_damping_.resize(size_t(count));
#pragma omp parallel for num_threads(team(threads, size_t(count))) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        if (seats_.members(b).empty()) continue;
        Batch<Dim>& batch = seats_.batch(b);
        const int lanes = batch.lanes;
        const auto& kernels = motion_kernels<Dim>();
        if (damping > 0) local_damping_[b].begin(batch);
        if (std::any_of(seats_.members(b).begin(), seats_.members(b).end(),
                        [](const Grain<Dim>* grain) { return grain->surface.wanted; }))
            kernels.velocities[batch.wide()](batch.data(), batch.extent.data());
        hand_out(b, &Surface<Dim>::velocity_before);
        batch.law.internal_force[batch.wide()](batch.data(), batch.per_lane.data());
        if (!batch.viscosity.empty()) {
            add_viscous_force(batch, dt);
            count_viscous_loss(b);
        }
        for (size_t lane = 0; lane < seats_.members(b).size(); ++lane) {
            Grain<Dim>& grain = *seats_.members(b)[lane];
            grain.min_J = batch.per_lane[lane];
            if (!(grain.min_J >= least_J_[b])) least_J_[b] = grain.min_J; // also when it is no number
            for (int d = 0; d < Dim; ++d)
                batch.gain[d * lanes + lane] = dt * (gravity[d] + grain.acceleration[d]) / grain.radius;
            if (grain.spin_acceleration != Mat<Dim>::Zero())
                grain.add_velocity(Vec<Dim>::Zero(), dt * grain.spin_acceleration);
        }
        kernels.kick[batch.wide()](batch.data(), dt, batch.gain.data(), batch.extent.data());
        hand_out(b, &Surface<Dim>::velocity);
    }
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g) {
        predict_updated(*updated_[g], dt, gravity);
        if (!(updated_[g]->min_J >= 1)) least_J_[count + g] = updated_[g]->min_J;
    }
    if (!std::all_of(least_J_.begin(), least_J_.end(), [](double J) { return J > 0; }))
        for (Grain<Dim>* grain : grains_)
            if (!(grain->min_J > 0)) report_inversion(*grain);
}

template <int Dim> double Assembly<Dim>::min_J() const
{
    double least = 1;
    for (double J : least_J_)
        least = std::min(least, J);
    for (const Grain<Dim>* grain : flights_)
        least = std::min(least, grain->min_J);
    return least;
}

template <int Dim> void Assembly<Dim>::correct(double dt, int threads, const Visit& before, const Visit& after)
{
    const int count = seats_.count(), single = int(updated_.size());
    std::vector<char> sound(size_t(count + single), true);
    std::vector<std::string> complaint(single);
    std::vector<char> ready(rigid_below > 0 ? grains_.size() : 0, false); // to take off
    sound.push_back(fly(dt, threads, before, after));
#pragma omp parallel for num_threads(team(threads, size_t(count))) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = seats_.batch(b);
        if (seats_.members(b).empty()) continue;
        bool struck = false;
        for (Grain<Dim>* grain : seats_.members(b)) {
            if (before) before(*grain);
            struck |= grain->surface.struck;
        }
        if (damping > 0) local_damping_[b].strike(batch);
        if (struck) push(b);
        if (damping > 0) damp(b);
        if (!batch.viscosity.empty()) count_viscous_loss(b);
        motion_kernels<Dim>().drift[batch.wide()](batch.data(), dt);
        sound[b] = observe(b, dt, after);
        for (Grain<Dim>* grain : seats_.members(b)) {
            sound[b] &= !grain->surface.leaps(dt);
            if (rigid_below > 0 && !grain->surface.near) ready[size_t(grain->number)] = is_nearly_rigid(*grain, rigid_below);
        }
    }
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g) {
        Grain<Dim>& grain = *updated_[g];
        if (before) before(grain);
        complaint[g] = correct_updated(grain, dt);
        sound[count + g] = is_finite(grain) && !grain.surface.leaps(dt) && complaint[g].empty();
        if (after && sound[count + g]) after(grain);
    }
    report_unsound(sound, dt);
    report(complaint);
    if (rigid_below > 0) take_off(ready, dt);
}

/// The grains in flight; false when something is wrong with one.
template <int Dim> bool Assembly<Dim>::fly(double dt, int threads, const Visit& before, const Visit& after)
{
    constexpr size_t flights_of_a_thread = 50;
    const int count = int(flights_.size());
    bool sound = true;
#pragma omp parallel for num_threads(team(threads, size_t(count) / flights_of_a_thread)) schedule(static) reduction(&& : sound)
    for (int i = 0; i < count; ++i) {
        Grain<Dim>& grain = *flights_[size_t(i)];
        if (before) before(grain);
        dissipated_[size_t(grain.number)].numerical = accelerate(grain, kick_, gravity_, damping);
        if (!softgrain::fly(grain, dt)) continue;
        sound = sound && is_finite(grain) && !grain.surface.leaps(dt);
        if (after) after(grain);
    }
    return sound;
}

/// Impulses on the surfaces, to the nodes of a batch.
template <int Dim> void Assembly<Dim>::push(int b)
{
    Batch<Dim>& batch = seats_.batch(b);
    double* values = batch.surface();
    std::fill_n(values, size_t(Dim) * batch.mesh->surface_count() * batch.lanes, 0);
    for (size_t lane = 0; lane < seats_.members(b).size(); ++lane) {
        Grain<Dim>& grain = *seats_.members(b)[lane];
        if (!std::exchange(grain.surface.struck, false)) continue;
        const double unit = grain.surface.mobility / grain.radius;
        for (size_t i = 0; i < grain.surface.impulse.size(); ++i)
            values[i * batch.lanes + lane] = unit * std::exchange(grain.surface.impulse[i], 0);
    }
    motion_kernels<Dim>().push[batch.wide()](batch.data(), batch.extent.data());
}

template <int Dim> void Assembly<Dim>::renew(double dt, int threads, const Visit& after)
{
    const int count = seats_.count(), single = int(updated_.size());
    std::vector<char> sound(size_t(count + single), true);
    std::vector<std::string> complaint(single);
    least_J_.assign(size_t(count + single), 1);
#pragma omp parallel for num_threads(team(threads, size_t(count))) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = seats_.batch(b);
        motion_kernels<Dim>().extend[batch.wide()](batch.data());
        batch.law.internal_force[batch.wide()](batch.data(), batch.per_lane.data());
        motion_kernels<Dim>().velocities[batch.wide()](batch.data(), batch.extent.data());
        for (size_t lane = 0; lane < seats_.members(b).size(); ++lane)
            least_J_[b] = std::min(least_J_[b], seats_.members(b)[lane]->min_J = batch.per_lane[lane]);
        sound[b] = observe(b, dt, after);
    }
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g) {
        Grain<Dim>& grain = *updated_[g];
        complaint[g] = take_updated(grain, dt);
        least_J_[count + g] = std::min(1.0, grain.min_J);
        sound[count + g] = is_finite(grain) && complaint[g].empty();
        if (after && sound[count + g]) after(grain);
    }
    report_unsound(sound, dt);
    report(complaint);
}

/// Surfaces and motions of a batch from its nodes; false when something is wrong with them.
template <int Dim> bool Assembly<Dim>::observe(int b, double dt, const Visit& after)
{
    Batch<Dim>& batch = seats_.batch(b);
    const int lanes = batch.lanes;
    bool sound = true;
    motion_kernels<Dim>().observe[batch.wide()](batch.data(), batch.sums.data(), batch.extent.data());
    if (batch.law.memory_count > 0) advance_memory(b);
    hand_out(b, &Surface<Dim>::position);
    for (size_t lane = 0; lane < seats_.members(b).size(); ++lane) {
        Grain<Dim>& grain = *seats_.members(b)[lane];
        Surface<Dim>& surface = grain.surface;
        using Extent = SurfaceExtent<Dim>;
        const auto extent = [&](int entry) { return batch.extent[size_t(entry) * lanes + lane]; };
        for (int d = 0; d < Dim; ++d) {
            surface.min[d] = grain.origin[d] + grain.radius * extent(Extent::low + d);
            surface.max[d] = grain.origin[d] + grain.radius * extent(Extent::high + d);
        }
        surface.speed = grain.radius * std::sqrt(extent(Extent::speed2));
        surface.travel += dt * surface.speed;
        surface.stale = !surface.wanted;
        grain.motion = motion_of(grain, batch.sums.data() + lane, lanes);
        sound &= is_finite(grain);
        if (after) after(grain);
    }
    return sound;
}

/// What a kernel found at the surfaces of a batch, to those that are wanted.
template <int Dim> void Assembly<Dim>::hand_out(int b, std::vector<double> Surface<Dim>::*field)
{
    const double* values = seats_.batch(b).surface();
    const int lanes = seats_.batch(b).lanes;
    for (size_t lane = 0; lane < seats_.members(b).size(); ++lane) {
        Grain<Dim>& grain = *seats_.members(b)[lane];
        if (!grain.surface.wanted) continue;
        const Vec<Dim> offset = field == &Surface<Dim>::position ? grain.origin : Vec<Dim>(Vec<Dim>::Zero());
        double* to = (grain.surface.*field).data();
        for (int p = 0; p < grain.surface.count; ++p)
            for (int d = 0; d < Dim; ++d)
                to[Dim * p + d] = offset[d] + grain.radius * values[(size_t(Dim) * p + d) * lanes + lane];
    }
}

template <int Dim> void Assembly<Dim>::report(const std::vector<std::string>& complaints) const
{
    for (size_t g = 0; g < complaints.size(); ++g)
        if (!complaints[g].empty()) throw SimulationError(whose(updated_[g]->id) + ": " + complaints[g] + ".");
}

template <int Dim> void Assembly<Dim>::report_unsound(const std::vector<char>& sound, double dt)
{
    if (std::all_of(sound.begin(), sound.end(), [](char is) { return is; })) return;
    for (Grain<Dim>* grain : grains_) {
        if (!is_finite(*grain)) report_not_finite(*grain);
        if (grain->surface.leaps(dt)) report_leap(*grain, dt);
    }
}

template <int Dim> void Assembly<Dim>::account(const ContactProblem<Dim>& problem, EnergyBalance& balance)
{
    const auto velocity = [](const Surface<Dim>& body, int p) { // of the middle, as driven bodies have it anyway
        const auto of
            = [p](const std::vector<double>& field) { return Eigen::Map<const Vec<Dim>>(&field[size_t(Dim) * p]); };
        return Vec<Dim>((of(body.velocity_before) + of(body.velocity)) / 2);
    };
    for (const auto& contact : problem.contacts) {
        if (contact.impulse == Vec<Dim>::Zero()) continue;
        const Vec<Dim> u = (problem.relative(contact, &Surface<Dim>::velocity)
                            + problem.relative(contact, &Surface<Dim>::velocity_before))
            / 2;
        const double normal = contact.impulse.dot(contact.normal) * u.dot(contact.normal);
        balance.contact_dissipation -= normal;
        if (contact.friction > 0) balance.friction -= contact.impulse.dot(u) - normal; // else but round-off
        if (contact.other < 0)
            balance.external_work += contact.impulse.dot(contact.drive);
        else if (const Surface<Dim>& other = *problem.bodies[contact.other]; other.mobility == 0)
            for (int k = 0; k < face_vertices<Dim>; ++k)
                balance.external_work += contact.weight[k] * contact.impulse.dot(velocity(other, contact.vertex[k]));
        if (const Surface<Dim>& body = *problem.bodies[contact.body]; body.mobility == 0)
            balance.external_work -= contact.impulse.dot(velocity(body, contact.point));
    }
}

template <int Dim> void Assembly<Dim>::evaluate_stretch(int threads)
{
    const int count = seats_.count();
#pragma omp parallel for num_threads(team(threads, size_t(count))) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = seats_.batch(b);
        batch.law.energy[batch.wide()](batch.data(), batch.per_lane.data() + batch.lanes, batch.per_lane.data());
        for (size_t lane = 0; lane < seats_.members(b).size(); ++lane)
            seats_.members(b)[lane]->min_stretch = batch.per_lane[lane];
    }
    const int single = int(updated_.size());
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g)
        updated_[g]->elastic_energy();
}

template <int Dim> void Assembly<Dim>::evaluate_energy(double dt, int threads)
{
    const int count = seats_.count(), single = int(updated_.size());
#pragma omp parallel for num_threads(team(threads, size_t(count))) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        std::vector<double> energy;
        energy_over_step(seats_.batch(b), dt, energy);
        for (size_t lane = 0; lane < seats_.members(b).size(); ++lane) {
            Grain<Dim>& grain = *seats_.members(b)[lane];
            grain.elastic = std::pow(grain.radius, Dim) * energy[lane];
        }
    }
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g) {
        Grain<Dim>& grain = *updated_[g];
        const auto energy = [&](double back) {
            double min_stretch;
            return grain.updated->elastic_energy(*grain.mesh, *grain.law, grain.parameters.data(), back, min_stretch);
        };
        grain.elastic = std::pow(grain.radius, Dim) * (2 * energy(dt / 2) - (energy(dt) + energy(0)) / 2);
    }
}

template class Assembly<2>;

} // namespace softgrain
