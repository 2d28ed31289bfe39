// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftLoads.hpp"

#include <exception>
#include <utility>

namespace yade {

namespace {
    /// Velocity of the centre of mass, and spin.
    Vector3r rates(const softgrain::Motion<2>& motion)
    {
        return Vector3r(motion.velocity[0], motion.velocity[1], motion.angular_momentum[0] / motion.second_moment.trace());
    }
} // namespace

void SoftLoads::gather(Scene& scene, const Vector3r& gravity, int threads)
{
    scene.forces.sync();
    const int count = int(soft_.states.size());
    loads_.resize(count);
    constexpr size_t grains_of_a_thread = 50;
    std::exception_ptr problem; // must not leave the parallel loop
#pragma omp parallel for num_threads(softgrain::team(threads, size_t(count) / grains_of_a_thread)) schedule(static)
    for (int i = 0; i < count; ++i) {
        const Body::id_t id = soft_.states[i]->grain.id;
        try {
            gather(loads_[i], *soft_.states[i], gravity, scene.forces.getForce(id), scene.forces.getTorque(id));
        } catch (...) {
#pragma omp critical
            problem = std::current_exception();
        }
    }
    if (problem) std::rethrow_exception(problem);
}

void SoftLoads::gather(Load& load, SoftState& state, const Vector3r& gravity, const Vector3r& force, const Vector3r& torque)
{
    auto& grain = state.grain;
    if (state.touched()) state.heed();
    load.work += std::exchange(state.workByHand, 0);
    if (!force.allFinite() || !torque.allFinite() || force[2] != 0 || torque[0] != 0 || torque[1] != 0)
        throw std::runtime_error("soft grain #" + std::to_string(grain.id)
                                 + ": the force on it in O.forces has to be finite and in the xy-plane, the torque about z; "
                                   "soft grains stay in the plane.");
    load.on = state.mass * gravity + Vector3r(force[0], force[1], torque[2]);
    grain.acceleration = force.head<2>() / state.mass;
    grain.spin_acceleration = softgrain::rotation_rate(torque[2] / grain.motion.second_moment.trace());
    const auto held = state.held();
    grain.surface.near |= held[0] || held[1] || held[2]; // what holds them gives impulses, as contacts do
    for (int d = 0; d < 2; ++d)
        if (held[d]) {
            load.on[d] = -state.contactLoad[d];
            grain.acceleration[d] = load.on[d] / state.mass - gravity[d];
        }
    if (held[2]) {
        load.on[2] = -state.contactLoad[2];
        grain.spin_acceleration = softgrain::rotation_rate(load.on[2] / grain.motion.second_moment.trace());
    }
}

/// By a force on the whole grain: that of the contacts in the last step, which the solver has seen, and what lacks after
/// this one.
void SoftLoads::hold(int index, double dt)
{
    SoftState& state = *soft_.states[index];
    const auto held = state.held();
    state.contactLoad.setZero();
    if (!held[0] && !held[1] && !held[2]) return;
    auto& grain = state.grain;
    const auto& motion = grain.motion;
    Vector3r impulse = Vector3r::Zero();
    for (int p = 0; p < grain.surface.count; ++p) {
        const softgrain::Vec<2> arm = grain.surface.x(p) - motion.position;
        const Real x = grain.surface.impulse[2 * p], y = grain.surface.impulse[2 * p + 1];
        impulse += Vector3r(x, y, arm[0] * y - arm[1] * x);
    }
    const Vector3r inertias(state.mass, state.mass, motion.second_moment.trace());
    Vector3r lacking = Vector3r(state.vel[0], state.vel[1], state.angVel[2]) - rates(motion)
        - (dt * loads_[index].on + impulse).cwiseQuotient(inertias);
    for (int k = 0; k < 3; ++k)
        if (held[k])
            state.contactLoad[k] = impulse[k] / dt;
        else
            lacking[k] = 0;
    loads_[index].on += inertias.cwiseProduct(lacking) / dt;
    if (lacking != Vector3r::Zero()) grain.add_velocity(lacking.head<2>(), softgrain::rotation_rate(lacking[2]));
}

void SoftLoads::work(int index, double dt)
{
    Load& load = loads_[index];
    if (load.on != Vector3r::Zero()) load.work += dt / 2 * load.on.dot(rates(soft_.states[index]->grain.motion));
}

Real SoftLoads::takeWork()
{
    Real sum = 0;
    for (Load& load : loads_)
        sum += std::exchange(load.work, 0);
    return sum;
}

} // namespace yade
