// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Interaction.hpp>
#include <core/State.hpp>

#include "contact/surface.hpp"

namespace yade {

/// What a rigid body shows in the plane of the grains.
struct RigidOutline {
    vector<Vector3r> arms; ///< vertices, counter-clockwise, from the body's position [m]; none: it shows nothing
    Real size = 0;         ///< radius, or half the least width [m]
    softgrain::Surface<2>::Kind kind = softgrain::Surface<2>::Kind::polygon;

    /// Puts it where the body is now, and in motion with it.
    void show(const State& body, Real dt, softgrain::Surface<2>& surface) const;
    /// Brings the contact points of the body with a soft grain up to date; returns whether the interaction is to go on.
    bool meet(const State& body, const State& grain, const shared_ptr<Interaction>& interaction, Real dt) const;
};

} // namespace yade
