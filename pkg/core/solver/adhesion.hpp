// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/narrow_phase.hpp"
#include "solver/contact_problem.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {

/// Surface points of a pair that its adhesion holds, and those that it has let go of for good; ascending.
struct Bonds {
    std::vector<int> held, parted;

    /// Goes on with these; what was held and is not among them has parted.
    void hold(std::vector<int> now);
};

/// Adhesion of two bodies (Dugdale 1960; Maugis 1992): a constant tension between surfaces nearer than `range`. The work of
/// adhesion is tension x range. With r the whole impulse of a contact point and c = tension x its width x dt,
///     0 <= r_n + c  perp  u_n + g/dt >= 0,    |r_t| <= mu (r_n + c):
/// the cone of Signorini and Coulomb, shifted by -c. So -c acts as a force that is known, and the contact problem is the
/// one without adhesion, for r + c n.
template <int Dim> struct Adhesion {
    double tension = 0;     ///< [Pa], of the surface as it is
    double range = 0;       ///< [m]
    bool reversible = true; ///< else points that have come apart attract each other no more

    /// Impulse c of each contact point in a step of dt, 0 where nothing holds it [N s]. `carrier`: the body whose points stand
    /// for the surface, see points_are_of_second(); the points of the other are there besides. Irreversible: renews the bonds.
    std::vector<double> pulls(const std::vector<ContactPoint<Dim>>& points, const Surface<Dim>& carrier, bool on_second,
                              double dt, Bonds& bonds) const;
};

/// Length (area in 3D) of the boundary nearer than `range` that a contact point of this surface stands for, as seen along its
/// normal [m]: half of the way to each neighbour, or, where that is out of range, the way up to there. So the sum over all
/// points does not jump as one of them leaves. What a corner turns away from the face does not count.
template <int Dim> double width_within(double range, const ContactPoint<Dim>& point, const Surface<Dim>& surface);

/// The same of two round bodies as a whole, the middle of whose contact has this gap: nearer than `range` their arcs, taken as
/// parabolas, are over this width [m]. `radius`: 1 over the sum of their curvatures [m].
inline double width_within(double range, double gap, double radius)
{
    return gap < range ? std::sqrt(8 * radius * (range - std::max(0.0, gap))) : 0;
}

/// Brings impulses of contacts that are known beforehand to the velocities of the bodies.
template <int Dim> void give(const ContactProblem<Dim>& known);

extern template struct Adhesion<2>;
extern template void give<2>(const ContactProblem<2>&);

} // namespace softgrain
