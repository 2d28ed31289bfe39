// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include "SoftState.hpp"

#include "solver/contact_problem.hpp"

#include <map>

namespace yade {

/// Rigid bodies that have contacts in a step and are free to move. NewtonIntegrator has moved them without these
/// contacts; what contacts change in their velocities moves and turns them on, as if it had been part of that step.
class FreeBodies {
public:
    /// What moves freely in the plane when this body does: itself or its clump; null when no motion is free.
    static shared_ptr<Body> mover(const Scene& scene, const shared_ptr<Body>& body);

    /// The body itself, or the clump that it is in.
    static const shared_ptr<Body>& whole(const Scene& scene, const shared_ptr<Body>& body);
    static softgrain::RigidBody<2>::Twist twistOf(const State& state);

    void clear();
    /// A mover that touches a grain and showed this surface before NewtonIntegrator took a step of `moved` [s]: where it was then,
    /// with the velocities of now. Throws when it has no mass, or its centre is off the grain's plane.
    softgrain::RigidBody<2>* take(const shared_ptr<Body>& mover, const SoftState& grain,
                                  const softgrain::Surface<2>& surface, Real moved);
    /// A mover that had this twist then and touches a rigid body at this z [m]: a surface that moves with it, without points.
    softgrain::Surface<2>& take(const shared_ptr<Body>& mover, const softgrain::RigidBody<2>::Twist& before,
                                Body::id_t other, Real z, Real moved);
    /// Place of that surface among the bodies of a problem.
    int placeIn(softgrain::ContactProblem<2>& problem, Body::id_t mover);
    /// Brings the twists that the contact solver has changed to the bodies, as far as a step of dt takes them.
    void move(Scene& scene, Real dt);

private:
    struct Free {
        shared_ptr<Body> body; ///< null: has no contact in this step
        softgrain::RigidBody<2> rigid;
        Real moved;
        softgrain::Surface<2> surface; ///< for contacts with rigid bodies
        int place;                     ///< of that in the contact problem; -1: not yet
    };
    /// What a mover meets, for messages.
    struct Met {
        const char* what;
        Body::id_t id;
        Real z, room; ///< how far off that plane it may be [m]
    };
    /// True when it was not yet there; all but the twist before the step is set then.
    bool take(Free& free, const shared_ptr<Body>& mover, const Met& met, Real moved);

    std::map<Body::id_t, Free> all_; ///< by id, so that all runs are alike; places in it stay
};

} // namespace yade
