// SPDX-License-Identifier: GPL-2.0-or-later
// A contact problem as plain data: who touches whom, and where. Solvers stand apart and are judged by one
// residual.
#pragma once

#include "contact/surface.hpp"
#include "law/contact_law.hpp"

#include <array>

namespace softgrain {

template <int Dim> struct Contact {
    Surface<Dim>* body;  ///< that the point is on
    Surface<Dim>* other; ///< that the face is on; none: a rigid plane
    int point;
    std::array<int, Dim> vertex;
    std::array<double, Dim> weight;
    Vec<Dim> normal;     ///< from the face to the point
    double gap_speed;    ///< gap / dt [m/s]
    Vec<Dim> drive;      ///< velocity of the rigid plane [m/s]
    double friction;
    const ContactLaw<Dim>* law;
    Vec<Dim> impulse;    ///< on the point side: start value, then solution [N s]
    double inertia = 0;  ///< 1 / (normal entry of the Delassus operator) [kg]; set by the solver

    /// Velocity of the point relative to the face, from the given field of the surfaces.
    Vec<Dim> relative(std::vector<double> Surface<Dim>::*field) const
    {
        const auto value = [&](const Surface<Dim>& s, int p) {
            return Eigen::Map<const Vec<Dim>>(&(s.*field)[size_t(Dim) * p]);
        };
        Vec<Dim> u = value(*body, point);
        if (!other) return u - drive;
        for (int k = 0; k < Dim; ++k)
            u -= weight[k] * value(*other, vertex[k]);
        return u;
    }
};

/// || r - P_K(r - u - mu |u_t| n) || over the contacts, divided by max(|q|, |r|, |u|): Siconos's measure of a
/// frictional contact problem (Acary and Brogliato 2008; u with the gap, q its value without impulses).
/// Velocities count in units of impulse through the mean contact inertia.
template <int Dim> double contact_residual(const std::vector<Contact<Dim>>& contacts);

extern template double contact_residual<2>(const std::vector<Contact<2>>&);

} // namespace softgrain
