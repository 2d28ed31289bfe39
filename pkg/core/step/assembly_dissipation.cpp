// SPDX-License-Identifier: GPL-2.0-or-later
// What is dissipated in the grains.
#include "step/assembly.hpp"
#include "step/viscosity.hpp"

#include <cmath>

namespace softgrain {

/// Half of what the viscosity of a batch takes at its present velocities, those at an end of the step.
template <int Dim> void Assembly<Dim>::count_viscous_loss(int b)
{
    for (const Grain<Dim>* grain : seats_.members(b))
        dissipated_[size_t(grain->number)].viscous
            += std::pow(grain->radius, Dim) * viscous_loss(seats_.batch(b), grain->lane) / 2;
}

/// The points of a batch remember the end of the step.
template <int Dim> void Assembly<Dim>::advance_memory(int b)
{
    Batch<Dim>& batch = seats_.batch(b);
    batch.law.advance[batch.wide()](batch.data(), batch.per_lane.data());
    for (const Grain<Dim>* grain : seats_.members(b))
        dissipated_[size_t(grain->number)].plastic = std::pow(grain->radius, Dim) * batch.per_lane[size_t(grain->lane)];
}

/// Velocities of a batch at the end of the step.
template <int Dim> void Assembly<Dim>::damp(int b)
{
    Batch<Dim>& batch = seats_.batch(b);
    for (const Grain<Dim>* grain : seats_.members(b))
        dissipated_[size_t(grain->number)].numerical = grain->density * std::pow(grain->radius, Dim + 2)
            * local_damping_[size_t(b)].damp(batch, grain->lane, damping);
    motion_kernels<Dim>().velocities[batch.wide()](batch.data(), batch.extent.data());
}

template <int Dim> typename Assembly<Dim>::Dissipation Assembly<Dim>::dissipated() const
{
    Dissipation sum;
    for (const Dissipation& of_grain : dissipated_) {
        sum.viscous += of_grain.viscous;
        sum.plastic += of_grain.plastic;
        sum.numerical += of_grain.numerical;
    }
    return sum;
}

template class Assembly<2>;

} // namespace softgrain
