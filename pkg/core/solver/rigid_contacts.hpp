// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/contact_problem.hpp"

#include <unordered_map>

namespace softgrain {

/// Contacts of rigid bodies among each other and with what impulses do not move, as non-linear Gauss-Seidel (Jean 1999) treats
/// them: one after the other with all else held, in the order of the problem. Impulses change the twists of the bodies at once.
/// Normals and tangents have inertias of their own, so that the law's answer is exact where a contact's Delassus operator is
/// diagonal in them, as that of discs and spheres. One contact after the other would take as many sweeps as a body is lighter than
/// what lies on it: all contacts of such a light one are balanced together.
///
/// Between two sweeps the impulses go on along the direction that non-linear conjugate gradients give, with a sweep's change for
/// the gradient (Silcowitz-Hansen, Niebe and Erleben 2010): sweeps grow with the depth of a pile, not with its square.
template <int Dim> class RigidContacts {
public:
    /// No soft body is on either side.
    static bool knows(const ContactProblem<Dim>& problem, const Contact<Dim>& contact)
    {
        const auto soft = [&](int body) { return body >= 0 && problem.bodies[size_t(body)]->mobility > 0; };
        return !soft(contact.body) && !soft(contact.other);
    }

    void begin(ContactProblem<Dim>& problem);
    /// Applies the impulses that the contacts start from.
    void start();
    /// Treats all contacts once. With friction the impulses go `share` of the way to the law's.
    void sweep(double share);
    double change = 0, size = 0; ///< squared, of the impulses in the last sweep
    /// Hands over the impulses.
    void finish();

private:
    using Body = RigidBody<Dim>;
    using Twist = typename Body::Twist;
    using Lever = Eigen::Matrix<double, Dim, Body::twists>;
    using Response = Eigen::Matrix<double, Body::twists, Dim>;
    struct Side {
        size_t body = 0; ///< place in bodies_
        Lever lever = Lever::Zero();
        Response response = Response::Zero(); ///< of the twist to unit impulses
    };
    struct Local {
        Side point, face;
        Vec<Dim> normal, offset, impulse;
        Vec<Dim> step, way;   ///< changes of the impulse: by the last sweep, along the conjugate gradients
        double along, across; ///< inertias along the normal and the tangents [kg]
        double friction;
        const ContactLaw<Dim>* law;
        const SignoriniCoulomb<Dim>* coulomb; ///< the law, if it is this one
        Contact<Dim>* contact;
    };
    struct Moving {
        Body* body; ///< null: of what impulses do not move
        Twist twist;
    };
    struct Light {
        size_t body;
        std::vector<size_t> contacts;
    };
    Side side(int surface, const Vec<Dim>& place);
    void gather_light();
    void fetch_twists();
    void store_twists();
    void go_on();
    Vec<Dim> reaction(const Local& local, const Vec<Dim>& trial) const;
    Vec<Dim> approach(const Local& local) const;
    void strike(const Local& local, const Vec<Dim>& impulse);
    void settle(const Light& light);

    ContactProblem<Dim>* problem_ = nullptr;
    std::vector<Local> locals_;
    std::vector<Moving> bodies_;                       ///< the first: what impulses do not move
    std::vector<size_t> place_;                        ///< in bodies_, of the surfaces of the problem; 0: not yet known
    std::unordered_map<const Body*, size_t> place_of_; ///< the same of bodies, that several surfaces may show
    std::vector<Light> light_;
    double change_before_ = 0; ///< squared, of the last sweep but one; 0: there was none
};

extern template class RigidContacts<2>;

} // namespace softgrain
