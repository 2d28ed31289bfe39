// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/critical_step.hpp"

#include "step/spectrum.hpp"
#include "step/viscosity.hpp"

#include <algorithm>

namespace softgrain {
namespace {

    /// Steps of Lanczos's method, for the highest eigenvalue to 1e-4 and to 1 %.
    constexpr int fine = 40, coarse = 12;

    /// Of its lower bound, the most that is believed: strong compression grows within few steps.
    constexpr double most = 1.25;

    /// A grain, the lower bound of its step [s], and the damping of its undeformed shape.
    template <int Dim> struct Bounded {
        const Grain<Dim>* grain;
        double bound, damping;
    };
    template <int Dim> using Grains = std::vector<Bounded<Dim>>;

    /// A point that flows is softer than one that does not, and any may stop.
    template <int Dim> std::array<double, max_parameters> stiffest(const Grain<Dim>& grain)
    {
        return grain.law->elastic ? grain.law->elastic(grain.parameters) : grain.parameters;
    }

    /// Grains of one mesh and law as they are deformed.
    template <int Dim> Batch<Dim> side_by_side(const Grains<Dim>& grains)
    {
        const int lanes = grains.size() == 1 ? 1 : 8;
        Batch<Dim> batch(grains[0].grain->mesh, *grains[0].grain->law, lanes);
        for (int lane = 0; lane < lanes; ++lane) {
            const Grain<Dim>& grain = *grains[std::min(size_t(lane), grains.size() - 1)].grain;
            batch.set_parameters(lane, stiffest(grain));
            const auto take = [&](AlignedVector Batch<Dim>::*field, const std::vector<double>& held) {
                for (size_t i = 0; i < held.size(); ++i)
                    (batch.*field)[i * lanes + lane]
                        = grain.batch ? (grain.batch->*field)[i * grain.batch->lanes + grain.lane] : held[i];
            };
            take(&Batch<Dim>::displacement, grain.flight ? grain.flight->displacement : grain.displacement);
            take(&Batch<Dim>::memory, grain.memory);
        }
        return batch;
    }

    /// The smallest step of up to eight grains of one mesh and law [s].
    template <int Dim> double smallest_of(const Grains<Dim>& grains)
    {
        Batch<Dim> batch = side_by_side(grains);
        std::vector<double> stiffness(batch.lanes);
        highest_eigenvalues(batch, coarse, stiffness.data());
        double least = 1e300;
        for (size_t lane = 0; lane < grains.size(); ++lane) {
            const auto& [grain, bound, damping] = grains[lane];
            const double own
                = critical_step(*grain, 2 / std::sqrt(stiffness[lane]) / std::min(1.0, grain->min_stretch), damping);
            least = std::min({ least, own, most * bound });
        }
        return least;
    }

    /// Grains of one mesh and law, up to eight together.
    template <int Dim> std::vector<Grains<Dim>> groups_of(const Grains<Dim>& grains)
    {
        std::vector<Grains<Dim>> groups;
        std::map<std::pair<const void*, const void*>, size_t> open;
        for (const auto& grain : grains) {
            const auto [at, added] = open.try_emplace({ grain.grain->mesh.get(), grain.grain->law }, groups.size());
            if (added || groups[at->second].size() == 8) {
                at->second = groups.size();
                groups.emplace_back();
            }
            groups[at->second].push_back(grain);
        }
        return groups;
    }

    /// Down to six digits: beyond them stands the round-off of differences of forces, which a run that goes on after a break
    /// would not repeat.
    double without_noise(double step)
    {
        int exponent;
        const double mantissa = std::frexp(step, &exponent);
        return std::ldexp(std::floor(std::ldexp(mantissa, 20)), exponent - 20);
    }

} // namespace

template <int Dim> double unit_critical_step(const Grain<Dim>& grain)
{
    Batch<Dim> batch(grain.mesh, *grain.law, 1);
    batch.set_parameters(0, stiffest(grain));
    double stiffness;
    highest_eigenvalues(batch, fine, &stiffness);
    return 2 / std::sqrt(stiffness);
}

template <int Dim> double SmallestCriticalStep<Dim>::damping_of(const Grain<Dim>& grain)
{
    if (grain.viscosity == 0) return 0;
    const auto [damping, added] = damping_.try_emplace(grain.mesh, 0);
    if (added) damping->second = highest_viscous_eigenvalue<Dim>(grain.mesh);
    return damping->second;
}

template <int Dim> double SmallestCriticalStep<Dim>::operator()(const std::vector<Grain<Dim>*>& grains, int threads)
{
    double least = 1e300;
    Grains<Dim> bounded;
    for (const Grain<Dim>* grain : grains) {
        const auto [unit, added] = unit_.try_emplace({ grain->mesh, grain->law, grain->parameters }, 0);
        if (added) unit->second = unit_critical_step(*grain);
        const double damping = damping_of(*grain), bound = critical_step(*grain, unit->second, damping);
        if (grain->updated)
            least = std::min(least, bound); // its nodes have no displacements to vary
        else
            bounded.push_back({ grain, bound, damping });
    }
    std::stable_sort(bounded.begin(), bounded.end(), [](const auto& a, const auto& b) { return a.bound < b.bound; });
    // a grain whose bound is over the step of some other is not in question
    const auto first = bounded.begin() + std::min<size_t>(8, bounded.size());
    for (const auto& group : groups_of<Dim>({ bounded.begin(), first }))
        least = std::min(least, smallest_of(group));
    const auto end = std::find_if(first, bounded.end(), [least](const auto& grain) { return grain.bound >= least; });
    const auto groups = groups_of<Dim>({ first, end });
#pragma omp parallel for num_threads(team(threads, groups.size())) schedule(dynamic) reduction(min : least)
    for (size_t g = 0; g < groups.size(); ++g)
        least = std::min(least, smallest_of(groups[g]));
    return without_noise(least);
}

template double unit_critical_step<2>(const Grain<2>&);
template class SmallestCriticalStep<2>;

} // namespace softgrain
