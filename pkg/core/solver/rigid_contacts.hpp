// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/contact_problem.hpp"

namespace softgrain {

/// Contacts of rigid bodies among each other and with what impulses do not move, as non-linear Gauss-Seidel (Jean 1999) treats
/// them: one after the other with all else held, in the order of the problem. Impulses change the twists of the bodies at once.
/// Normals and tangents have inertias of their own, so that the law's answer is exact where a contact's Delassus operator is
/// diagonal in them, as that of discs and spheres. One contact after the other would take as many sweeps as a body is lighter than
/// what lies on it: all contacts of such a light one are balanced together.
template <int Dim> class RigidContacts {
public:
    /// No soft body is on either side.
    static bool knows(const ContactProblem<Dim>& problem, const Contact<Dim>& contact)
    {
        const auto soft = [&](int body) { return body >= 0 && problem.bodies[size_t(body)]->mobility > 0; };
        return !soft(contact.body) && !soft(contact.other);
    }

    void begin(ContactProblem<Dim>& problem);
    bool empty() const { return locals_.empty(); }
    /// Applies the impulses that the contacts start from.
    void start();
    /// Treats all contacts once. With friction the impulses go `share` of the way to the law's.
    void sweep(double share);
    double change = 0, size = 0; ///< squared, of the impulses in the last sweep
    /// Hands over impulses, and the velocities of the surfaces.
    void finish();

private:
    using Body = RigidBody<Dim>;
    using Lever = Eigen::Matrix<double, Dim, Body::twists>;
    struct Local {
        Contact<Dim>* contact;
        Body *body, *other; ///< null: impulses do not move it
        Lever lever, other_lever;
        Vec<Dim> offset, impulse;
        double along, across; ///< inertias along the normal and the tangents [kg]
    };
    struct Light {
        Body* body;
        std::vector<size_t> contacts;
    };
    void gather_light();
    Vec<Dim> approach(const Local& local) const;
    void strike(const Local& local, const Vec<Dim>& impulse);
    void settle(const Light& light);

    ContactProblem<Dim>* problem_ = nullptr;
    std::vector<Local> locals_;
    std::vector<Light> light_; ///< bodies
};

extern template class RigidContacts<2>;

} // namespace softgrain
