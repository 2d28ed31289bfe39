// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable step of symplectic Euler, 2 / omega_max of the stiffest mode.
#pragma once

#include "step/grain.hpp"

#include <map>
#include <tuple>

namespace softgrain {

/// Of the undeformed grain, per sqrt(density) radius [s sqrt(m/kg)].
template <int Dim> double unit_critical_step(const Grain<Dim>& grain);

/// A lower bound for a grain as deformed at its last evaluation of stretches [s]. Compression by a stretch s raises the
/// frequency of waves along it by 1/s; the stiffest mode sees some mean over the grain.
template <int Dim> double critical_step(const Grain<Dim>& grain, double unit_step)
{
    return unit_step * std::sqrt(grain.density) * grain.radius * std::min(1.0, grain.min_stretch);
}

/// The smallest of many grains' steps.
template <int Dim> class SmallestCriticalStep {
public:
    /// Of the grains as they are deformed, by their own stiffness, to 1 % [s]; no more than 1.25 times the lower bound, since
    /// where a grain is squeezed most its stiffness grows fastest. Their smallest stretches have to be known.
    double operator()(const std::vector<Grain<Dim>*>& grains, int threads);

private:
    using Kind = std::tuple<std::shared_ptr<const Discretisation<Dim>>, const void*, std::array<double, max_parameters>>;
    std::map<Kind, double> unit_; ///< steps of undeformed grains
};

extern template double unit_critical_step<2>(const Grain<2>&);
extern template class SmallestCriticalStep<2>;

} // namespace softgrain
