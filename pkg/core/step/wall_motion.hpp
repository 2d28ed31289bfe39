// SPDX-License-Identifier: GPL-2.0-or-later
// Velocities of a wall that is to press on grains with a wanted force; positive into the grains, forces in compression.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace softgrain {

/// A wall with mass whose contacts are solved together with those of the grains. The wanted force drives it, and a drag lets it
/// run at `speed` where nothing resists: mostly cubic, so that a wall that gives way slowly bears little more than wanted. Both are
/// passive but for that force, so that no gain is too large for stiff grains; and where the wall stands still, the grains bear the
/// wanted force.
struct Piston {
    double mass;   ///< [kg/m]
    double speed;  ///< where nothing resists [m/s]
    double wanted; ///< force [N/m]
    double borne;  ///< by the grains now [N/m]

    double largest() const { return std::max(std::abs(wanted), std::abs(borne)); }
    /// Mass that it needs in steps of dt: a step kicks it by a tenth of its speed at most [kg/m].
    double inertia(double dt) const { return std::max(mass, 10 * largest() * dt / speed); }
    /// Against a velocity [N/m].
    double drag(double velocity) const
    {
        constexpr double linear = 0.1;
        const double share = velocity / speed;
        return largest() * (linear + (1 - linear) * share * share) * share;
    }
    /// Velocity after a kick that lasts dt, of a wall with that mass.
    double kicked(double velocity, double dt) const
    {
        if (largest() == 0) return 0;                               // nothing drives it, nothing would stop it
        const double bounded = std::clamp(velocity, -speed, speed); // grains may have thrown it
        return bounded + (wanted - drag(bounded)) * dt / inertia(dt);
    }
};

/// A wall that is driven, where the force is known at the end of a step alone: secant method in the force over the way, with a
/// bound on the way that is halved whenever the force passes the wanted one and grows again while it does not.
struct Servo {
    double force = 0;     ///< at the end of the step before [N/m]
    double lack = 0;      ///< of force then [N/m]
    double stiffness = 0; ///< last secant with forces that grew on the way in [N/m²]
    double share = 1;     ///< of the largest way that may be taken

    /// Way of the next step, `most` at most, after one of `way` that ended with the force `borne`.
    double next(double wanted, double borne, double way, double most)
    {
        constexpr double shrink = 0.5, grow = 1.5, least = 1e-9;
        if (way != 0 && (borne - force) / way > 0) stiffness = (borne - force) / way;
        const double now = wanted - borne;
        share = now * lack < 0 ? std::max(shrink * share, least) : std::min(grow * share, 1.0);
        force = borne;
        lack = now;
        const double secant
            = borne > 0 && stiffness > 0 ? std::abs(now) / stiffness : std::numeric_limits<double>::infinity();
        return now == 0 ? 0 : std::copysign(std::min(secant, share * most), now);
    }
};

} // namespace softgrain
