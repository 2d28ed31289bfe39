// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/assembly.hpp"

#include "step/viscosity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

    /// Moves so far in a step that it could get past other bodies.
    template <int Dim> bool leaps(const Grain<Dim>& grain, double dt)
    {
        return grain.surface.speed * dt > 0.5 * grain.surface.size;
    }

    template <int Dim> [[noreturn]] void report_leap(const Grain<Dim>& grain, double dt)
    {
        throw SimulationError(whose(grain.id) + ": it moves " + shown(grain.surface.speed * dt / grain.surface.size)
                              + " radii in one step, so that it could pass through other bodies; slow it down (speed "
                              + shown(grain.surface.speed) + " m/s) or take a smaller time step.");
    }

    template <int Dim> bool is_left_alone(const Grain<Dim>& grain, const Vec<Dim>& gravity)
    {
        return !grain.surface.struck && gravity + grain.acceleration == Vec<Dim>::Zero()
            && grain.spin_acceleration == Mat<Dim>::Zero();
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

    template <int Dim> void predict_updated(Grain<Dim>& grain, double dt, const Vec<Dim>& gravity)
    {
        UpdatedBody<Dim>& body = *grain.updated;
        Surface<Dim>& surface = grain.surface;
        surface.response = &body.response();            // of this very grain, which may be a copy
        grain.read_velocities(surface.velocity_before); // on the grid of this step
        if (grain.spin_acceleration != Mat<Dim>::Zero()) grain.add_velocity(Vec<Dim>::Zero(), dt * grain.spin_acceleration);
        grain.min_J
            = body.kick(*grain.mesh, *grain.law, grain.parameters.data(), dt / (grain.density * grain.radius * grain.radius),
                        dt / grain.radius * (gravity + grain.acceleration));
        grain.read_velocities(surface.velocity);
    }

    /// Surface and motion of a grain whose nodes have moved, and its grid anew where that is due; what is wrong with that.
    template <int Dim> std::string settle_updated(Grain<Dim>& grain, bool gone)
    {
        if (!gone) {
            grain.motion.kinetic = std::numeric_limits<double>::quiet_NaN();
            return "";
        }
        try {
            grain.settle();
        } catch (const SimulationError& error) { // must not leave the parallel loop
            return error.what();
        }
        grain.surface.bound();
        return "";
    }

    template <int Dim> std::string correct_updated(Grain<Dim>& grain, double dt)
    {
        UpdatedBody<Dim>& body = *grain.updated;
        Surface<Dim>& surface = grain.surface;
        const double unit = surface.mobility / grain.radius;
        double speed2 = 0;
        for (int p = 0; p < surface.count; ++p) {
            const Eigen::Map<Vec<Dim>> impulse(&surface.impulse[size_t(Dim) * p]);
            if (impulse != Vec<Dim>::Zero()) body.push(p, unit * impulse);
            speed2 = std::max(speed2, surface.v(p).squaredNorm());
        }
        std::fill(surface.impulse.begin(), surface.impulse.end(), 0);
        surface.struck = false;
        surface.speed = std::sqrt(speed2);
        surface.travel += dt * surface.speed;
        return leaps(grain, dt) ? "" : settle_updated(grain, body.drift(dt));
    }

    /// Nodes have been moved by another scheme.
    template <int Dim> std::string take_updated(Grain<Dim>& grain, double dt)
    {
        const std::string complaint = settle_updated(grain, grain.updated->arrive());
        Surface<Dim>& surface = grain.surface;
        grain.read_velocities(surface.velocity);
        surface.measure_speed();
        surface.travel += dt * surface.speed;
        grain.min_J = 1e300;
        for (const Mat<Dim>& F : grain.updated->deformation_gradients())
            grain.min_J = std::min(grain.min_J, F.determinant());
        return complaint;
    }

} // namespace

template <int Dim>
Assembly<Dim>::Assembly(std::vector<Grain<Dim>*> grains)
    : grains_(std::move(grains))
{
    std::map<std::pair<const void*, const void*>, std::vector<Grain<Dim>*>> groups;
    std::vector<std::pair<const void*, const void*>> order;
    for (Grain<Dim>* grain : grains_) {
        grain->surface.wanted = true;
        grain->renew_positions();
        if (grain->updated) {
            updated_.push_back(grain);
            continue;
        }
        auto& group = groups[{ grain->mesh.get(), grain->law }];
        if (group.empty()) order.push_back({ grain->mesh.get(), grain->law });
        group.push_back(grain);
    }
    for (const auto& key : order)
        put_in_batches(groups[key]);
    least_J_.assign(batches_.size() + updated_.size(), 1);
    for (size_t b = 0; b < batches_.size(); ++b)
        for (size_t lane = 0; lane < members_[b].size(); ++lane) {
            members_[b][lane]->batch = batches_[b].get();
            members_[b][lane]->lane = int(lane);
        }
    for (int b = 0; b < batch_count(); ++b)
        asleep_.push_back(is_at_rest(b));
    dissipated_.resize(batches_.size());
}

template <int Dim> void Assembly<Dim>::put_in_batches(std::vector<Grain<Dim>*> group)
{
    sort_by_place(group);
    const int lanes = group.size() == 1 ? 1 : 8;
    for (size_t first = 0; first < group.size(); first += lanes) {
        std::vector<Grain<Dim>*> part(group.begin() + first, group.begin() + std::min(first + lanes, group.size()));
        auto batch = std::make_unique<Batch<Dim>>(part[0]->mesh, *part[0]->law, lanes);
        for (int lane = 0; lane < lanes; ++lane) {
            // lanes without a grain of their own repeat the first, at rest
            const bool spare = lane >= int(part.size());
            Grain<Dim>& grain = *part[spare ? 0 : lane];
            batch->set_parameters(lane, grain.parameters);
            batch->inverse_inertia[lane] = 1 / (grain.density * grain.radius * grain.radius);
            if (grain.viscosity > 0) batch->set_viscosity(lane, grain.viscosity);
            if (spare) continue;
            grain.pull();
            batch->set_memory(lane, grain.memory);
            for (size_t i = 0; i < grain.displacement.size(); ++i) {
                batch->displacement[i * lanes + lane] = grain.displacement[i];
                batch->velocity[i * lanes + lane] = grain.velocity[i];
            }
        }
        motion_kernels<Dim>().extend[batch->wide()](batch->data());
        batches_.push_back(std::move(batch));
        members_.push_back(part);
    }
}

/// No velocity, and forces that are nothing but round-off.
template <int Dim> bool Assembly<Dim>::is_at_rest(int b)
{
    constexpr double round_off = 1e-12; // of the modulus, over all points of a node
    Batch<Dim>& batch = *batches_[b];
    if (!std::all_of(batch.velocity.begin(), batch.velocity.end(), [](double v) { return v == 0; })) return false;
    const KernelData<Dim> data = batch.data();
    batch.law.internal_force[batch.wide()](data, batch.per_lane.data());
    double modulus = 1e300;
    for (const Grain<Dim>* grain : members_[b])
        modulus = std::min(modulus, batch.law.wave_modulus(grain->parameters.data()));
    for (int i = 0; i < Dim * data.master_count * batch.lanes; ++i)
        if (!(std::abs(data.force[i]) <= round_off * modulus)) return false;
    for (Grain<Dim>* grain : members_[b])
        grain->surface.speed = 0;
    return true;
}

template <int Dim> Assembly<Dim>::~Assembly()
{
    for (Grain<Dim>* grain : grains_) {
        grain->pull();
        grain->batch = nullptr;
    }
}

template <int Dim> void Assembly<Dim>::predict(double dt, const Vec<Dim>& gravity, int threads)
{
    const int count = int(batches_.size());
    if (damping > 0) local_damping_.resize(batches_.size());
#pragma omp parallel for num_threads(team(threads, batches_.size())) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = *batches_[b];
        const int lanes = batch.lanes;
        const auto& kernels = motion_kernels<Dim>();
        if (damping > 0) local_damping_[b].begin(batch); // also of those that contacts will wake
        asleep_[b] &= std::all_of(members_[b].begin(), members_[b].end(),
                                  [&](const Grain<Dim>* grain) { return is_left_alone(*grain, gravity); });
        if (asleep_[b]) continue;
        if (std::any_of(members_[b].begin(), members_[b].end(),
                        [](const Grain<Dim>* grain) { return grain->surface.wanted; }))
            kernels.velocities[batch.wide()](batch.data(), batch.extent.data());
        hand_out(b, &Surface<Dim>::velocity_before);
        batch.law.internal_force[batch.wide()](batch.data(), batch.per_lane.data());
        double least = 1;
        if (!batch.viscosity.empty()) {
            add_viscous_force(batch, dt);
            dissipated_[b].viscous = viscous_loss(b) / 2;
        }
        for (size_t lane = 0; lane < members_[b].size(); ++lane) {
            Grain<Dim>& grain = *members_[b][lane];
            grain.min_J = batch.per_lane[lane];
            if (!(grain.min_J >= least)) least = grain.min_J; // also when it is no number
            for (int d = 0; d < Dim; ++d)
                batch.gain[d * lanes + lane] = dt * (gravity[d] + grain.acceleration[d]) / grain.radius;
            if (grain.spin_acceleration != Mat<Dim>::Zero())
                grain.add_velocity(Vec<Dim>::Zero(), dt * grain.spin_acceleration);
        }
        kernels.kick[batch.wide()](batch.data(), dt, batch.gain.data(), batch.extent.data());
        hand_out(b, &Surface<Dim>::velocity);
        least_J_[b] = least;
    }
    const int single = int(updated_.size());
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g) {
        predict_updated(*updated_[g], dt, gravity);
        const double J = updated_[g]->min_J;
        least_J_[count + g] = J >= 1 ? 1 : J;
    }
    if (!std::all_of(least_J_.begin(), least_J_.end(), [](double J) { return J > 0; }))
        for (Grain<Dim>* grain : grains_)
            if (!(grain->min_J > 0)) report_inversion(*grain);
}

template <int Dim> double Assembly<Dim>::min_J() const
{
    return least_J_.empty() ? 1 : *std::min_element(least_J_.begin(), least_J_.end());
}

template <int Dim> void Assembly<Dim>::correct(double dt, int threads, const Visit& before, const Visit& after)
{
    const int count = int(batches_.size()), single = int(updated_.size());
    std::vector<char> sound(count + single, true);
    std::vector<std::string> complaint(single);
#pragma omp parallel for num_threads(team(threads, batches_.size())) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = *batches_[b];
        const int lanes = batch.lanes;
        double* values = batch.surface();
        bool struck = false;
        for (Grain<Dim>* grain : members_[b]) {
            if (before) before(*grain);
            struck |= grain->surface.struck;
        }
        asleep_[b] &= !struck;
        if (asleep_[b]) continue;
        const auto& kernels = motion_kernels<Dim>();
        if (damping > 0) local_damping_[b].strike(batch);
        if (struck) {
            std::fill_n(values, size_t(Dim) * batch.mesh->surface_count() * lanes, 0);
            for (size_t lane = 0; lane < members_[b].size(); ++lane) {
                Grain<Dim>& grain = *members_[b][lane];
                if (!std::exchange(grain.surface.struck, false)) continue;
                const double unit = grain.surface.mobility / grain.radius;
                for (size_t i = 0; i < grain.surface.impulse.size(); ++i)
                    values[i * lanes + lane] = unit * std::exchange(grain.surface.impulse[i], 0);
            }
            kernels.push[batch.wide()](batch.data(), batch.extent.data());
        }
        if (damping > 0) dissipated_[b].numerical = local_damping_[b].end(batch, members_[b], damping);
        if (!batch.viscosity.empty()) dissipated_[b].viscous += viscous_loss(b) / 2;
        kernels.drift[batch.wide()](batch.data(), dt);
        sound[b] = observe(b, dt, after);
        for (const Grain<Dim>* grain : members_[b])
            sound[b] &= !leaps(*grain, dt);
    }
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g) {
        Grain<Dim>& grain = *updated_[g];
        if (before) before(grain);
        complaint[g] = correct_updated(grain, dt);
        sound[count + g] = is_finite(grain) && !leaps(grain, dt) && complaint[g].empty();
        if (after && sound[count + g]) after(grain);
    }
    report_unsound(sound, dt);
    report(complaint);
}

template <int Dim> void Assembly<Dim>::renew(double dt, int threads, const Visit& after)
{
    const int count = int(batches_.size()), single = int(updated_.size());
    std::vector<char> sound(count + single, true);
    std::vector<std::string> complaint(single);
#pragma omp parallel for num_threads(team(threads, batches_.size())) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = *batches_[b];
        motion_kernels<Dim>().extend[batch.wide()](batch.data());
        batch.law.internal_force[batch.wide()](batch.data(), batch.per_lane.data());
        motion_kernels<Dim>().velocities[batch.wide()](batch.data(), batch.extent.data());
        least_J_[b] = 1;
        asleep_[b] = false;
        for (size_t lane = 0; lane < members_[b].size(); ++lane)
            least_J_[b] = std::min(least_J_[b], members_[b][lane]->min_J = batch.per_lane[lane]);
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
    Batch<Dim>& batch = *batches_[b];
    const int lanes = batch.lanes;
    bool sound = true;
    motion_kernels<Dim>().observe[batch.wide()](batch.data(), batch.sums.data(), batch.extent.data());
    if (batch.law.memory_count > 0) dissipated_[b].plastic = advance_memory(b);
    hand_out(b, &Surface<Dim>::position);
    for (size_t lane = 0; lane < members_[b].size(); ++lane) {
        Grain<Dim>& grain = *members_[b][lane];
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
    const double* values = batches_[b]->surface();
    const int lanes = batches_[b]->lanes;
    for (size_t lane = 0; lane < members_[b].size(); ++lane) {
        Grain<Dim>& grain = *members_[b][lane];
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
        if (leaps(*grain, dt)) report_leap(*grain, dt);
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
    const int count = int(batches_.size());
#pragma omp parallel for num_threads(team(threads, batches_.size())) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = *batches_[b];
        batch.law.energy[batch.wide()](batch.data(), batch.per_lane.data() + batch.lanes, batch.per_lane.data());
        for (size_t lane = 0; lane < members_[b].size(); ++lane)
            members_[b][lane]->min_stretch = batch.per_lane[lane];
    }
    const int single = int(updated_.size());
#pragma omp parallel for num_threads(team(threads, updated_.size())) schedule(dynamic)
    for (int g = 0; g < single; ++g)
        updated_[g]->elastic_energy();
}

template <int Dim> void Assembly<Dim>::evaluate_energy(double dt, int threads)
{
    const int count = int(batches_.size());
#pragma omp parallel for num_threads(team(threads, batches_.size())) schedule(dynamic)
    for (int b = 0; b < count; ++b) {
        Batch<Dim>& batch = *batches_[b];
        KernelData<Dim> data = batch.data();
        std::copy(batch.displacement.begin(), batch.displacement.end(), data.force);
        data.displacement = data.force;
        for (Grain<Dim>* grain : members_[b])
            grain->elastic = 0;
        for (double share : { -0.5, 2.0, -0.5 }) { // at the end of the step, in its middle, at its start
            motion_kernels<Dim>().extend[batch.wide()](data);
            batch.law.energy[batch.wide()](data, batch.per_lane.data(), batch.per_lane.data() + batch.lanes);
            for (size_t lane = 0; lane < members_[b].size(); ++lane)
                members_[b][lane]->elastic += share * std::pow(members_[b][lane]->radius, Dim) * batch.per_lane[lane];
            motion_kernels<Dim>().drift[batch.wide()](data, -dt / 2);
        }
    }
    const int single = int(updated_.size());
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
