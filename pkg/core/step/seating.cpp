// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/seating.hpp"

#include <algorithm>

namespace softgrain {
namespace {

    /// A lane without a grain of its own: undeformed, at rest.
    template <int Dim> void clear(Batch<Dim>& batch, int lane)
    {
        for (size_t i = lane; i < batch.displacement.size(); i += batch.lanes)
            batch.displacement[i] = batch.velocity[i] = 0;
        const int count = batch.law.memory_count;
        for (size_t k = 0; k < batch.memory.size() / batch.lanes; ++k)
            batch.memory[k * batch.lanes + lane] = batch.law.first_memory[k % count];
    }

    /// Material constants of a grain, without which a lane cannot be computed.
    template <int Dim> void describe(const Grain<Dim>& grain, Batch<Dim>& batch, int lane)
    {
        batch.set_parameters(lane, grain.parameters);
        batch.inverse_inertia[lane] = 1 / (grain.density * grain.radius * grain.radius);
        if (grain.viscosity > 0 || !batch.viscosity.empty()) batch.set_viscosity(lane, grain.viscosity);
    }

} // namespace

template <int Dim> Seating<Dim>::Seating(const std::vector<Grain<Dim>*>& grains)
{
    for (const Grain<Dim>* grain : grains) {
        const auto found = std::find_if(groups_.begin(), groups_.end(), [&](const Group& group) {
            return group.mesh == grain->mesh.get() && group.law == grain->law;
        });
        if (found == groups_.end())
            groups_.push_back({ grain->mesh.get(), grain->law, 1, 1, {}, 0 });
        else
            ++found->grains;
    }
    for (Group& group : groups_)
        group.lanes = group.grains == 1 ? 1 : 8;
}

template <int Dim> typename Seating<Dim>::Group& Seating<Dim>::group_of(const Grain<Dim>& grain)
{
    return *std::find_if(groups_.begin(), groups_.end(),
                         [&](const Group& group) { return group.mesh == grain.mesh.get() && group.law == grain.law; });
}

template <int Dim> void Seating<Dim>::put_in(Grain<Dim>& grain)
{
    Group& group = group_of(grain);
    const size_t place = size_t(group.seated / group.lanes);
    if (place == group.batches.size()) {
        group.batches.push_back(count());
        batches_.push_back(std::make_unique<Batch<Dim>>(grain.mesh, *grain.law, group.lanes));
        members_.emplace_back();
        for (int lane = 0; lane < group.lanes; ++lane)
            describe(grain, *batches_.back(), lane);
    }
    const int b = group.batches[place], lane = group.seated++ % group.lanes;
    members_[size_t(b)].push_back(&grain);
    seat(grain, b, lane);
    motion_kernels<Dim>().extend[batch(b).wide()](batch(b).data());
}

template <int Dim> void Seating<Dim>::seat(Grain<Dim>& grain, int b, int lane)
{
    describe(grain, batch(b), lane);
    members_[size_t(b)][size_t(lane)] = &grain;
    grain.batch = &batch(b);
    grain.lane = lane;
    grain.put();
}

template <int Dim> void Seating<Dim>::take_out(Grain<Dim>& grain)
{
    Group& group = group_of(grain);
    const int lane = grain.lane, last = group.batches[size_t(--group.seated / group.lanes)];
    const int b = *std::find_if(group.batches.begin(), group.batches.end(),
                                [&](int number) { return &batch(number) == grain.batch; });
    Grain<Dim>& mover = *members_[size_t(last)].back();
    grain.pull();
    mover.pull();
    grain.batch = nullptr;
    members_[size_t(last)].pop_back();
    clear(batch(last), group.seated % group.lanes);
    if (&mover == &grain) return;
    seat(mover, b, lane);
    motion_kernels<Dim>().extend[batch(b).wide()](batch(b).data());
}

template class Seating<2>;

} // namespace softgrain
