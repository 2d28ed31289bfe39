// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/rigid_flight.hpp"

#include "step/local_damping.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

    /// Of a grain as a rigid body, in the plane.
    template <int Dim> double inertia(const Grain<Dim>& grain) { return grain.motion.second_moment.trace(); }
    template <int Dim> double spin(const Grain<Dim>& grain) { return grain.motion.angular_momentum[0] / inertia(grain); }
    template <int Dim> double energy_of_spin(const Grain<Dim>& grain)
    {
        return grain.motion.angular_momentum[0] * spin(grain) / 2;
    }
    template <int Dim> double kinetic(const Grain<Dim>& grain)
    {
        return grain.mass() / 2 * grain.motion.velocity.squaredNorm() + energy_of_spin(grain);
    }

    Mat<2> turned(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }

    /// Of a grain that holds its displacements, with the centre of mass there.
    template <int Dim> Flight<Dim> flight_from(const Grain<Dim>& grain, const Vec<Dim>& centre)
    {
        Flight<Dim> flight { grain.displacement, centre, {}, 0, 0 };
        Batch<Dim> batch = grain.alone();
        for (int p = 0; p < grain.surface.count; ++p) {
            const Eigen::Map<const Vec<Dim>> x(batch.surface() + Dim * p);
            flight.arms.push_back(grain.radius * (x - centre));
            flight.outer = std::max(flight.outer, flight.arms.back().norm());
        }
        return flight;
    }

    /// A bound on the speed of its surface.
    template <int Dim> double fastest(const Grain<Dim>& grain)
    {
        return grain.motion.velocity.norm() + std::abs(spin(grain)) * grain.flight->outer;
    }

} // namespace

template <int Dim> void energy_over_step(Batch<Dim>& batch, double dt, std::vector<double>& energy)
{
    KernelData<Dim> data = batch.data();
    std::copy(batch.displacement.begin(), batch.displacement.end(), data.force);
    data.displacement = data.force;
    energy.assign(size_t(batch.lanes), 0);
    for (double share : { -0.5, 2.0, -0.5 }) { // at the end of the step, in its middle, at its start
        motion_kernels<Dim>().extend[batch.wide()](data);
        batch.law.energy[batch.wide()](data, batch.per_lane.data(), batch.per_lane.data() + batch.lanes);
        for (size_t lane = 0; lane < energy.size(); ++lane)
            energy[lane] += share * batch.per_lane[lane];
        motion_kernels<Dim>().drift[batch.wide()](data, -dt / 2);
    }
}

template <int Dim> bool only_translates(const Grain<Dim>& grain)
{
    constexpr double round_off = 1e-12; // of the modulus, over all points of a node
    for (size_t i = Dim; i < grain.velocity.size(); ++i)
        if (grain.velocity[i] != grain.velocity[i - Dim]) return false;
    Batch<Dim> batch = grain.alone();
    const KernelData<Dim> data = batch.data();
    batch.law.internal_force[0](data, batch.per_lane.data());
    const double most = round_off * batch.law.wave_modulus(grain.parameters.data());
    return std::all_of(data.force, data.force + Dim * data.master_count, [most](double f) { return std::abs(f) <= most; });
}

template <int Dim> bool is_nearly_rigid(Grain<Dim>& grain, double tolerance)
{
    const double modulus = grain.law->shear_modulus(grain.parameters.data()) * grain.reference_volume(),
                 most = tolerance * tolerance * modulus / 2, vibration = grain.motion.kinetic - kinetic(grain);
    if (vibration > most || 2 * energy_of_spin(grain) > tolerance * modulus) return false;
    const Mat<Dim>& F = grain.motion.mean_gradient;
    const double strain2 = (F.transpose() * F - Mat<Dim>::Identity()).squaredNorm() / 4;
    if (strain2 > tolerance * tolerance) return false; // cheaper than the energy, and rarely passed without it
    grain.pull();
    return vibration + grain.elastic_energy() <= most;
}

template <int Dim> void take_off(Grain<Dim>& grain)
{
    grain.flight = flight_from<Dim>(grain, (grain.motion.position - grain.origin) / grain.radius);
    grain.motion.kinetic = kinetic(grain);
    grain.elastic_energy(); // which the grain remembers
}

template <int Dim> double accelerate(Grain<Dim>& grain, double dt, const Vec<Dim>& gravity, double damping)
{
    Motion<Dim>& motion = grain.motion;
    const Vec<Dim> before = motion.velocity;
    const double spin_before = spin(grain);
    motion.velocity += dt * (gravity + grain.acceleration);
    motion.angular_momentum[0] += dt * grain.spin_acceleration(1, 0) * inertia(grain);
    double lost = 0;
    if (damping > 0) {
        const Vec<Dim> v = motion.velocity, slowed = -lost_share(damping, (v - before).dot(v), v.squaredNorm()) * v;
        const double turn = spin(grain), turn_slowed = -lost_share(damping, (turn - spin_before) * turn, turn * turn) * turn;
        motion.velocity += slowed;
        motion.angular_momentum[0] += inertia(grain) * turn_slowed;
        lost = -grain.mass() / 2 * slowed.dot(before + motion.velocity)
            - inertia(grain) / 2 * turn_slowed * (spin_before + spin(grain));
    }
    motion.kinetic = kinetic(grain);
    return lost;
}

template <int Dim> bool fly(Grain<Dim>& grain, double dt)
{
    Motion<Dim>& motion = grain.motion;
    if (motion.kinetic == 0) return false;
    Surface<Dim>& surface = grain.surface;
    const double rate = spin(grain), outer = grain.flight->outer;
    if (rate != 0) {
        const Mat<Dim> Q = turned(dt * rate);
        grain.flight->angle += dt * rate;
        motion.second_moment = Q * motion.second_moment * Q.transpose();
        motion.mean_gradient = Q * motion.mean_gradient;
    }
    const Vec<Dim> way = dt * motion.velocity;
    grain.origin += way;
    motion.position += way;
    surface.min = motion.position.array() - outer;
    surface.max = motion.position.array() + outer;
    surface.speed = fastest(grain);
    surface.travel += dt * surface.speed;
    surface.stale = true;
    if (surface.wanted) write_positions(grain);
    return true;
}

template <int Dim> void write_nodes(Grain<Dim>& grain)
{
    const Vec<Dim> v = grain.motion.velocity / grain.radius, c = grain.flight->centre;
    const Mat<Dim> Q = turned(grain.flight->angle), gradient = rotation_rate(spin(grain));
    for (int i = 0; i < grain.mesh->master_count; ++i) {
        const Eigen::Map<const Vec<Dim>> u(&grain.flight->displacement[size_t(Dim * i)]);
        const Vec<Dim>& X = grain.mesh->node_position[size_t(i)];
        const Vec<Dim> arm = Q * (X + u - c);
        Eigen::Map<Vec<Dim>>(&grain.displacement[size_t(Dim * i)]) = c + arm - X;
        Eigen::Map<Vec<Dim>>(&grain.velocity[size_t(Dim * i)]) = v + gradient * arm;
    }
}

template <int Dim> void write_positions(Grain<Dim>& grain)
{
    const Mat<Dim> Q = turned(grain.flight->angle);
    for (int p = 0; p < grain.surface.count; ++p)
        Eigen::Map<Vec<Dim>>(&grain.surface.position[size_t(Dim * p)])
            = grain.motion.position + Q * grain.flight->arms[size_t(p)];
    grain.surface.stale = false;
}

template <int Dim> std::vector<double> packed_flight(const Grain<Dim>& grain)
{
    const Motion<Dim>& m = grain.motion;
    std::vector<double> values;
    if (!grain.flight) return values;
    const auto append = [&values](const auto& part) { values.insert(values.end(), part.data(), part.data() + part.size()); };
    append(grain.flight->centre);
    append(m.position);
    append(m.velocity);
    append(m.angular_momentum);
    append(m.second_moment);
    append(m.mean_gradient);
    values.insert(values.end(), { grain.elastic, m.kinetic, grain.flight->angle, grain.min_J });
    return values;
}

template <int Dim> bool unpack_flight(const std::vector<double>& values, Grain<Dim>& grain)
{
    if (values.empty()) return true;
    Motion<Dim>& m = grain.motion;
    if (values.size() != size_t(3 * Dim + m.angular_momentum.size() + 2 * Dim * Dim + 4)) return false;
    const double elastic = *(values.end() - 4), modulus = grain.law->shear_modulus(grain.parameters.data());
    if (!(std::abs(grain.elastic_energy() - elastic) <= 1e-6 * elastic + 1e-12 * modulus * grain.reference_volume()))
        return true; // its nodes are others: it deforms
    auto from = values.begin();
    const auto take = [&from](auto& part) {
        std::copy_n(from, part.size(), part.data());
        from += part.size();
    };
    Vec<Dim> centre;
    take(centre);
    take(m.position);
    take(m.velocity);
    take(m.angular_momentum);
    take(m.second_moment);
    take(m.mean_gradient);
    m.kinetic = *++from;
    grain.flight = flight_from(grain, centre);
    grain.flight->angle = *++from;
    grain.min_J = *++from;
    grain.surface.speed = fastest(grain);
    write_positions(grain);
    grain.surface.bound();
    return true;
}

template <int Dim> void land(Grain<Dim>& grain)
{
    write_nodes(grain);
    grain.renew_positions();
    grain.flight.reset();
}

template void energy_over_step<2>(Batch<2>&, double, std::vector<double>&);
template bool only_translates<2>(const Grain<2>&);
template bool is_nearly_rigid<2>(Grain<2>&, double);
template void take_off<2>(Grain<2>&);
template double accelerate<2>(Grain<2>&, double, const Vec<2>&, double);
template bool fly<2>(Grain<2>&, double);
template void write_nodes<2>(Grain<2>&);
template void write_positions<2>(Grain<2>&);
template std::vector<double> packed_flight<2>(const Grain<2>&);
template bool unpack_flight<2>(const std::vector<double>&, Grain<2>&);
template void land<2>(Grain<2>&);

} // namespace softgrain
