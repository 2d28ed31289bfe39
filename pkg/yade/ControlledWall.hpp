// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Scene.hpp>

#include "step/wall_motion.hpp"

namespace yade {

/// A wall of the scene that an engine moves along its normal, once a step is done. Velocities are positive into the grains,
/// forces in compression.
class ControlledWall {
public:
    /// Throws when the body is no Wall, has another axis than the one asked for (-1: x or y), or no side on which the grains
    /// are: `side`, or the wall's sense where that is 0.
    ControlledWall(Scene& scene, const std::string& engine, Body::id_t id, int axis = -1, int side = 0);

    int axis() const { return axis_; }
    Real place() const { return state_.pos[axis_]; }
    Real velocity() const { return side_ * state_.vel[axis_]; }
    Real borne() const;                  ///< force of the grains in this step [N/m]
    Real work() const;                   ///< on the grains in this step [J/m]
    void drive(Real velocity);           ///< from now on, whatever the grains do
    void give(Real velocity, Real mass); ///< to a wall of that mass [kg/m], which contacts move from here on
    Real along(const Vector3r& field) const { return side_ * field[axis_]; }

private:
    void block(unsigned degrees) { state_.blockedDOFs = degrees; }

    Scene& scene_;
    Body::id_t id_;
    State& state_;
    int axis_ = 0, side_ = 1;
};

} // namespace yade
