// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/local_damping.hpp"

namespace softgrain {
namespace {

    using Vectors = std::vector<Vec<2>>;

    /// Nodes in a lane.
    Vectors lane_of(const AlignedVector& field, int count, int lanes, int lane)
    {
        Vectors values(static_cast<size_t>(count));
        for (int i = 0; i < count; ++i)
            values[size_t(i)] = Vec<2>(field[size_t(2 * i * lanes + lane)], field[size_t((2 * i + 1) * lanes + lane)]);
        return values;
    }

    struct Rigid {
        Vec<2> velocity;
        double spin;
        Vec<2> at(const Vec<2>& arm) const { return velocity + spin * Vec<2>(-arm.y(), arm.x()); }
    };

    /// The nodes of a grain: arms from its centre, masses, and the rigid part of a field of velocities on them.
    class Nodes {
    public:
        Nodes(const std::vector<double>& mass, Vectors position)
            : mass_(mass)
            , arm_(std::move(position))
        {
            Vec<2> centre = Vec<2>::Zero();
            for (size_t i = 0; i < arm_.size(); ++i) {
                total_ += mass_[i];
                centre += mass_[i] * arm_[i];
            }
            for (size_t i = 0; i < arm_.size(); ++i) {
                arm_[i] -= centre / total_;
                inertia_ += mass_[i] * arm_[i].squaredNorm();
            }
        }
        Rigid rigid(const Vectors& v) const
        {
            Rigid sum { Vec<2>::Zero(), 0 };
            for (size_t i = 0; i < arm_.size(); ++i) {
                sum.velocity += mass_[i] * v[i];
                sum.spin += mass_[i] * (arm_[i].x() * v[i].y() - arm_[i].y() * v[i].x());
            }
            return { sum.velocity / total_, sum.spin / inertia_ };
        }
        void subtract(const Rigid& rigid, Vectors& v) const
        {
            for (size_t i = 0; i < arm_.size(); ++i)
                v[i] -= rigid.at(arm_[i]);
        }
        const Vec<2>& arm(size_t i) const { return arm_[i]; }

    private:
        const std::vector<double>& mass_;
        Vectors arm_;
        double total_ = 0, inertia_ = 0;
    };

} // namespace

template <int Dim> double LocalDamping<Dim>::damp(Batch<Dim>& batch, int lane, double damping)
{
    const auto& mesh = *batch.mesh;
    const int count = mesh.master_count, lanes = batch.lanes;
    Vectors position = lane_of(batch.displacement, count, lanes, lane);
    for (int i = 0; i < count; ++i)
        position[size_t(i)] += mesh.node_position[size_t(i)];
    const Nodes nodes(mesh.node_mass, std::move(position));
    const Vectors before = lane_of(start_, count, lanes, lane), kicked = lane_of(kicked_, count, lanes, lane),
                  v = lane_of(batch.velocity, count, lanes, lane);
    const Rigid whole = nodes.rigid(v), earlier = nodes.rigid(before);

    Vectors relative = v, gain = v, change(v.size());
    for (size_t i = 0; i < v.size(); ++i)
        gain[i] -= before[i];
    nodes.subtract(whole, relative);
    nodes.subtract({ whole.velocity - earlier.velocity, whole.spin - earlier.spin }, gain);
    for (size_t i = 0; i < v.size(); ++i)
        change[i] = -lost_share(damping, gain[i].dot(relative[i]), relative[i].squaredNorm()) * relative[i];
    nodes.subtract(nodes.rigid(change), change);
    const Rigid slowed {
        -lost_share(damping, (whole.velocity - earlier.velocity).dot(whole.velocity), whole.velocity.squaredNorm())
            * whole.velocity,
        -lost_share(damping, (whole.spin - earlier.spin) * whole.spin, whole.spin * whole.spin) * whole.spin
    };

    double lost = 0;
    for (size_t i = 0; i < v.size(); ++i) {
        change[i] += slowed.at(nodes.arm(i));
        lost -= mesh.node_mass[i] / 2 * change[i].dot(before[i] + (v[i] + change[i]) + (v[i] - kicked[i]));
        for (int d = 0; d < Dim; ++d)
            batch.velocity[(Dim * i + size_t(d)) * size_t(lanes) + size_t(lane)] += change[i][d];
    }
    return lost;
}

template class LocalDamping<2>;

} // namespace softgrain
