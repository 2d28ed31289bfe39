// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include "SoftState.hpp"

#include "contact/rigid_body.hpp"

#include <map>

namespace yade {

/// Rigid bodies that soft grains touch in a step and that are free to move. NewtonIntegrator has moved them without these
/// contacts; what contacts change in their velocities moves and turns them on, as if it had been part of that step.
class FreeBodies {
public:
    /// What moves freely in the plane when this body does: itself or its clump; null when no motion is free.
    static shared_ptr<Body> mover(const Scene& scene, const shared_ptr<Body>& body);

    void clear() { all_.clear(); }
    /// A mover that touches a grain and showed this surface before NewtonIntegrator took a step of `moved` [s]: where it was then,
    /// with the velocities of now. Throws when it has no mass, or its centre is off the grain's plane.
    softgrain::RigidBody<2>* take(const shared_ptr<Body>& mover, const SoftState& grain,
                                  const softgrain::Surface<2>& surface, Real moved);
    /// Brings the twists that the contact solver has changed to the bodies, as far as a step of dt takes them.
    void move(Scene& scene, Real dt);

private:
    struct Free {
        shared_ptr<Body> body;
        softgrain::RigidBody<2> rigid;
        Real moved;
    };
    std::map<Body::id_t, Free> all_; ///< by id, so that all runs are alike; places in it stay
};

} // namespace yade
