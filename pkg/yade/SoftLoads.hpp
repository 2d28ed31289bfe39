// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SoftPairs.hpp"

namespace yade {

/// Loads on each grain as a whole, besides contacts: gravity, what O.forces holds for it, and what keeps blocked degrees of
/// freedom.
class SoftLoads {
public:
    explicit SoftLoads(const SoftBodies& soft)
        : soft_(soft)
    {
    }
    /// Takes velocities set by hand, gravity [m/s²] and O.forces in. Throws on what is not finite or not in the plane.
    void gather(Scene& scene, const Vector3r& gravity, int threads);
    /// Brings blocked degrees of freedom to the velocity that the state asks for, once the impulses of contacts are known.
    void hold(int grain, double dt);
    /// Counts the work of half a step with the velocities of now.
    void work(int grain, double dt);
    /// Counts the work on the way [m] and turn [rad] of a grain.
    void work(int grain, const Vector3r& way) { loads_[size_t(grain)].work += loads_[size_t(grain)].on.dot(way); }
    /// Work of all grains since the last call [J/m], velocities set by hand included.
    Real takeWork();

private:
    struct Load {
        Vector3r on = Vector3r::Zero(); ///< x and y components [N/m], torque [N]
        Real work = 0;                  ///< [J/m]
    };
    void gather(Load& load, SoftState& state, const Vector3r& gravity, const Vector3r& force, const Vector3r& torque);

    const SoftBodies& soft_;
    std::vector<Load> loads_;
};

} // namespace yade
