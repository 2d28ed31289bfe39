// SPDX-License-Identifier: GPL-2.0-or-later
// The largest stable step of symplectic Euler, 2 / omega_max of the stiffest mode; viscosity makes it shorter.
#pragma once

#include "step/grain.hpp"

#include <map>
#include <tuple>

namespace softgrain {

/// Of the undeformed grain, per sqrt(density) radius [s sqrt(m/kg)].
template <int Dim> double unit_critical_step(const Grain<Dim>& grain);

/// With forces -omega^2 u - c v, v half a step behind [s]: the root of omega^2 h^2 + 2 c h = 4.
inline double stable_step(double omega, double c) { return (std::sqrt(c * c + 4 * omega * omega) - c) / (omega * omega); }

/// A lower bound for a grain as deformed at its last evaluation of stretches [s]. Compression by a stretch s raises the
/// frequency of waves along it by 1/s, the damping of viscosity by its square; the stiffest mode sees some mean over the grain.
/// `unit_damping`: highest_viscous_eigenvalue, where there is viscosity.
template <int Dim> double critical_step(const Grain<Dim>& grain, double unit_step, double unit_damping = 0)
{
    const double stretch = std::min(1.0, grain.min_stretch), inertia = grain.density * grain.radius * grain.radius;
    return stable_step(2 / (unit_step * std::sqrt(inertia) * stretch),
                       grain.viscosity * unit_damping / (inertia * stretch * stretch));
}

/// The smallest of many grains' steps.
template <int Dim> class SmallestCriticalStep {
public:
    /// Of the grains as they are deformed, by their own stiffness, to 1 % [s]; no more than 1.25 times the lower bound, since
    /// where a grain is squeezed most its stiffness grows fastest. Updated-Lagrangian grains keep the lower bound. The smallest
    /// stretches have to be known.
    double operator()(const std::vector<Grain<Dim>*>& grains, int threads);

private:
    using Kind = std::tuple<std::shared_ptr<const Discretisation<Dim>>, const void*, std::array<double, max_parameters>>;
    double damping_of(const Grain<Dim>& grain);

    std::map<Kind, double> unit_;                                          ///< steps of undeformed grains
    std::map<std::shared_ptr<const Discretisation<Dim>>, double> damping_; ///< highest_viscous_eigenvalue
};

extern template double unit_critical_step<2>(const Grain<2>&);
extern template class SmallestCriticalStep<2>;

} // namespace softgrain
