// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/updated_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softgrain {
namespace {

    /// Surface and motion of a grain whose nodes have moved, and its grid anew where that is due; what is wrong with that.
    template <int Dim> std::string settle_updated(Grain<Dim>& grain, bool gone)
    {
        if (!gone) {
            grain.motion.kinetic = std::numeric_limits<double>::quiet_NaN();
            return "";
        }
        try {
            grain.settle();
        } catch (const SimulationError& error) { // must not leave the parallel loop
            return error.what();
        }
        grain.surface.bound();
        return "";
    }

} // namespace

template <int Dim> void predict_updated(Grain<Dim>& grain, double dt, const Vec<Dim>& gravity)
{
    UpdatedBody<Dim>& body = *grain.updated;
    Surface<Dim>& surface = grain.surface;
    surface.response = &body.response();            // of this very grain, which may be a copy
    grain.read_velocities(surface.velocity_before); // on the grid of this step
    if (grain.spin_acceleration != Mat<Dim>::Zero()) grain.add_velocity(Vec<Dim>::Zero(), dt * grain.spin_acceleration);
    grain.min_J
        = body.kick(*grain.mesh, *grain.law, grain.parameters.data(), dt / (grain.density * grain.radius * grain.radius),
                    dt / grain.radius * (gravity + grain.acceleration));
    grain.read_velocities(surface.velocity);
}

template <int Dim> std::string correct_updated(Grain<Dim>& grain, double dt)
{
    UpdatedBody<Dim>& body = *grain.updated;
    Surface<Dim>& surface = grain.surface;
    const double unit = surface.mobility / grain.radius;
    double speed2 = 0;
    for (int p = 0; p < surface.count; ++p) {
        const Eigen::Map<Vec<Dim>> impulse(&surface.impulse[size_t(Dim) * p]);
        if (impulse != Vec<Dim>::Zero()) body.push(p, unit * impulse);
        speed2 = std::max(speed2, surface.v(p).squaredNorm());
    }
    std::fill(surface.impulse.begin(), surface.impulse.end(), 0);
    surface.struck = false;
    surface.speed = std::sqrt(speed2);
    surface.travel += dt * surface.speed;
    return surface.leaps(dt) ? "" : settle_updated(grain, body.drift(dt));
}

template <int Dim> std::string take_updated(Grain<Dim>& grain, double dt)
{
    const std::string complaint = settle_updated(grain, grain.updated->arrive());
    Surface<Dim>& surface = grain.surface;
    grain.read_velocities(surface.velocity);
    surface.measure_speed();
    surface.travel += dt * surface.speed;
    grain.min_J = 1e300;
    for (const Mat<Dim>& F : grain.updated->deformation_gradients())
        grain.min_J = std::min(grain.min_J, F.determinant());
    return complaint;
}

template void predict_updated<2>(Grain<2>&, double, const Vec<2>&);
template std::string correct_updated<2>(Grain<2>&, double);
template std::string take_updated<2>(Grain<2>&, double);

} // namespace softgrain
