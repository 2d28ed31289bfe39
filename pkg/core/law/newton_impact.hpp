// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/narrow_phase.hpp"

#include <algorithm>

namespace softgrain {

/// Newton's law of impact in the form of Moreau 1994: where a point comes into touch within the step,
///     0 <= r_n perp u_n + e_n u_n^before >= 0,    Coulomb's friction against u_t + e_t u_t^before,
/// with the relative velocities before the step. That is the law of Signorini and Coulomb with another offset of the relative
/// velocity, so that sweeps know nothing of it. A point that bore a force in the last step is in touch already: no impact.
///
/// Where all contacts share e_n = e_t the law never creates energy, whatever couples them; without friction, for any e_n <= 1.
template <int Dim> struct NewtonImpact {
    double normal = 0, tangential = 0; ///< coefficients of restitution, 0 to 1

    /// What the law adds to the relative velocity [m/s]: of those `before` the step and `free` of contact impulses, and of
    /// gap / dt along the normal.
    Vec<Dim> offset(const ContactPoint<Dim>& point, const Vec<Dim>& gap_speed, const Vec<Dim>& before,
                    const Vec<Dim>& free) const
    {
        const Vec<Dim>& n = point.normal;
        const double approach = before.dot(n);
        const bool impact = point.force == Vec<Dim>::Zero() && approach < 0 && (free + gap_speed).dot(n) < 0;
        if (!impact) return gap_speed;
        return std::min(gap_speed.dot(n), normal * approach) * n + tangential * (before - approach * n);
    }
};

} // namespace softgrain
