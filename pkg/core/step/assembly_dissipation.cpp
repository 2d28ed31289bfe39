// SPDX-License-Identifier: GPL-2.0-or-later
// What is dissipated in the grains.
#include "step/assembly.hpp"
#include "step/viscosity.hpp"

#include <cmath>

namespace softgrain {

/// Of a batch [J].
template <int Dim> double Assembly<Dim>::viscous_loss(int b) const
{
    double sum = 0;
    for (size_t lane = 0; lane < members_[b].size(); ++lane)
        sum += std::pow(members_[b][lane]->radius, Dim) * softgrain::viscous_loss(*batches_[b], int(lane));
    return sum;
}

/// The points of a batch remember the end of the step; what was dissipated [J].
template <int Dim> double Assembly<Dim>::advance_memory(int b)
{
    Batch<Dim>& batch = *batches_[b];
    batch.law.advance[batch.wide()](batch.data(), batch.per_lane.data());
    double sum = 0;
    for (size_t lane = 0; lane < members_[b].size(); ++lane)
        sum += std::pow(members_[b][lane]->radius, Dim) * batch.per_lane[lane];
    return sum;
}

template <int Dim> typename Assembly<Dim>::Dissipation Assembly<Dim>::dissipated() const
{
    Dissipation sum;
    for (const Dissipation& of_batch : dissipated_) {
        sum.viscous += of_batch.viscous;
        sum.plastic += of_batch.plastic;
        if (damping > 0) sum.numerical += of_batch.numerical;
    }
    return sum;
}

template class Assembly<2>;

} // namespace softgrain
