// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/types.hpp"

namespace softgrain {

/// One contact as the solver meets it in a sweep, all other contacts held: its Delassus operator is `inertia`^-1
/// times the identity (bodies are isotropic in space), so local laws have closed forms.
template <int Dim> struct LocalContact {
    const Vec<Dim>& normal;
    double friction; ///< Coulomb coefficient
    Vec<Dim> trial;  ///< impulse that would stop relative motion and close the gap, in tension too [N s]
};

/// A contact law: from a local problem to its reaction. Pure; called once a contact and sweep.
template <int Dim> class ContactLaw {
public:
    virtual ~ContactLaw() = default;
    /// Impulse on the point side [N s].
    virtual Vec<Dim> reaction(const LocalContact<Dim>& contact) const = 0;
};

/// Signorini's condition in velocities with the gap, 0 <= r_n perp u_n + g/dt >= 0, and Coulomb's friction
/// |r_t| <= mu r_n, sliding against r_t (Moreau 1994; Jean 1999). With an isotropic Delassus operator the
/// solution is the trial impulse cut to r_n >= 0 and then to the cone's section at that r_n.
template <int Dim> class SignoriniCoulomb final : public ContactLaw<Dim> {
public:
    Vec<Dim> reaction(const LocalContact<Dim>& contact) const override
    {
        const double normal = contact.trial.dot(contact.normal);
        if (normal <= 0) return Vec<Dim>::Zero();
        if (contact.friction == 0) return normal * contact.normal;
        const Vec<Dim> tangential = contact.trial - normal * contact.normal;
        const double size = tangential.norm(), most = contact.friction * normal;
        return size <= most ? contact.trial : Vec<Dim>(normal * contact.normal + most / size * tangential);
    }
};

} // namespace softgrain
