// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/rigid_body.hpp"
#include "law/contact_law.hpp"

#include <vector>

namespace softgrain {

/// A contact of a rigid body with a soft one, as the rigid one meets it while the other contacts of the soft one are held.
template <int Dim> struct RigidContact {
    const ContactLaw<Dim>* law;
    Vec<Dim> normal;
    double friction;
    double inertia; ///< of the soft side alone [kg]
    /// Relative velocity by a unit twist; transposed: what an impulse on the point's side sums up to on the rigid body.
    Eigen::Matrix<double, Dim, RigidBody<Dim>::twists> lever;
    Vec<Dim> velocity; ///< relative velocity with the gap, by the impulse and twist that are given [m/s]
    Vec<Dim> impulse;  ///< on the point's side [N s]
};

/// Twist of a rigid body over that without impulses, and impulses of its contacts, that belong to each other:
///
///     gain = mobility sum of lever^T impulse,    every impulse fulfils the law
///
/// by Newton's method for both, starting from those given; the twist alone is left in its equations. They are of the same size
/// however light or heavy the body is against the soft ones. Where they do not converge, as friction may wedge a very light
/// body, it counts as ten times heavier, and so on.
template <int Dim>
void balance(const RigidBody<Dim>& body, typename RigidBody<Dim>::Twist& gain, std::vector<RigidContact<Dim>>& contacts);

extern template void balance<2>(const RigidBody<2>&, RigidBody<2>::Twist&, std::vector<RigidContact<2>>&);

} // namespace softgrain
