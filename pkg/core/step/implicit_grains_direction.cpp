// SPDX-License-Identifier: GPL-2.0-or-later
// The linear algebra of a search direction.
#include "step/implicit_grains.hpp"

#include <cmath>

namespace softgrain {
namespace {

    constexpr int most_lanes = 8;

} // namespace

/// Adds a share of surface forces [N] to rows.
template <int Dim>
void ImplicitGrains<Dim>::add_surface_forces(const Part& part, const SurfaceField& forces, double share,
                                             AlignedVector& rows) const
{
    const int lanes = part.batch->lanes;
    double unit[most_lanes];
    for (size_t lane = 0; lane < part.members->size(); ++lane)
        unit[lane] = share * std::pow((*part.members)[lane]->radius, 1 - Dim);
    for (int p = 0; p < part.batch->mesh->surface_count(); ++p) {
        double force[Dim][most_lanes] = {};
        bool any = false;
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            for (int d = 0; d < Dim; ++d) {
                force[d][lane] = unit[lane] * forces[part.index[lane]][size_t(Dim) * p + d];
                any |= force[d][lane] != 0;
            }
        }
        for (int k = part.pattern->surface_start[p]; any && k < part.pattern->surface_start[p + 1]; ++k) {
            const auto& [row, weight] = part.pattern->surface[k];
            for (int d = 0; d < Dim; ++d)
                for (int lane = 0; lane < lanes; ++lane)
                    rows[(size_t(row) * Dim + d) * lanes + lane] += weight * force[d][lane];
        }
    }
}

/// Way of the surfaces under a displacement of rows, and the longest over its radius.
template <int Dim> void ImplicitGrains<Dim>::interpolate(Part& part, const AlignedVector& rows, SurfaceField& way) const
{
    const int lanes = part.batch->lanes;
    part.farthest = 0;
    for (int p = 0; p < part.batch->mesh->surface_count(); ++p) {
        double sum[Dim][most_lanes] = {};
        for (int k = part.pattern->surface_start[p]; k < part.pattern->surface_start[p + 1]; ++k) {
            const auto& [row, weight] = part.pattern->surface[k];
            for (int d = 0; d < Dim; ++d)
                for (int lane = 0; lane < lanes; ++lane)
                    sum[d][lane] += weight * rows[(size_t(row) * Dim + d) * lanes + lane];
        }
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            double length = 0;
            for (int d = 0; d < Dim; ++d) {
                way[part.index[lane]][size_t(Dim) * p + d] = (*part.members)[lane]->radius * sum[d][lane];
                length += sum[d][lane] * sum[d][lane];
            }
            part.farthest = std::max(part.farthest, length);
        }
    }
    part.farthest = std::sqrt(part.farthest);
}

template <int Dim> void ImplicitGrains<Dim>::condense(const std::vector<double>& damping, bool anew)
{
    constexpr double alike = 2.5;
    each_part([&](Part& part) {
        Batch<Dim>& batch = *part.batch;
        const int lanes = batch.lanes, points = batch.mesh->surface_count();
        bool needed = anew;
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            part.held[lane] = part.inertia[lane] + damping[part.index[lane]];
            const double ratio = part.held[lane] / part.factored[lane];
            needed |= ratio > alike || ratio < 1 / alike;
        }
        if (!needed) return;
        part.factored = part.held;
        thread_local AlignedVector room;
        const size_t size = size_t(points) * part.pattern->rows * Dim * Dim * lanes;
        if (room.size() < size) room.resize(size);
        const auto& kernels = stiffness_kernels();
        KernelData<Dim> data = batch.data();
        batch.law.stiffness[batch.wide()](data, part.pattern, part.held.data(), part.matrix.data());
        kernels.factorise[batch.wide()](data, part.pattern, part.matrix.data());
        kernels.compliance[batch.wide()](data, part.pattern, part.matrix.data(), room.data(), part.compliance.data());
        for (size_t lane = 0; lane < part.members->size(); ++lane) {
            const double unit = std::pow((*part.members)[lane]->radius, 2 - Dim);
            auto& own = compliance_[part.index[lane]];
            own.resize(size_t(points) * points * Dim * Dim);
            for (size_t k = 0; k < own.size(); ++k)
                own[k] = unit * part.compliance[k * lanes + lane];
            compliance_view_[part.index[lane]] = own.data();
        }
    });
}

template <int Dim> void ImplicitGrains<Dim>::solve(SurfaceField& way, const SurfaceField* further)
{
    each_part([&](Part& part) {
        part.direction = part.rhs;
        if (further) add_surface_forces(part, *further, 1, part.direction);
        stiffness_kernels().solve[part.batch->wide()](part.batch->data(), part.pattern, part.matrix.data(),
                                                      part.direction.data());
        interpolate(part, part.direction, way);
    });
}

/// Product of two vectors of rows, a force and a displacement [J].
template <int Dim> double ImplicitGrains<Dim>::dot(const Part& part, const AlignedVector& a, const AlignedVector& b)
{
    double of_lane[most_lanes] = {};
    const size_t lanes = size_t(part.batch->lanes);
    for (size_t k = 0; k < a.size(); k += lanes)
        for (size_t lane = 0; lane < lanes; ++lane)
            of_lane[lane] += a[k + lane] * b[k + lane];
    double sum = 0;
    for (size_t lane = 0; lane < part.members->size(); ++lane)
        sum += of_lane[lane] * std::pow((*part.members)[lane]->radius, Dim);
    return sum;
}

/// product <- A x without contact forces, as a difference of internal forces.
template <int Dim> void ImplicitGrains<Dim>::multiply(Part& part, const AlignedVector& x)
{
    constexpr double small = 1e-8; // displacement [radius]: squared it has to be small to lambda / mu = 1e4 too
    Batch<Dim>& batch = *part.batch;
    const size_t width = size_t(Dim) * batch.lanes;
    double largest = 1e-300;
    for (double value : x)
        largest = std::max(largest, std::abs(value));
    const double scale = small / largest, inverse = largest / small;
    for (int r = 0; r < part.pattern->rows; ++r) {
        const size_t node = size_t(part.pattern->master[r]) * width, row = size_t(r) * width;
        for (size_t i = 0; i < width; ++i)
            batch.displacement[node + i] = part.base[node + i] + scale * x[row + i];
    }
    KernelData<Dim> data = batch.data();
    motion_kernels<Dim>().extend[batch.wide()](data);
    batch.law.internal_force[batch.wide()](data, batch.per_lane.data());
    for (int r = 0; r < part.pattern->rows; ++r) {
        const size_t node = size_t(part.pattern->master[r]) * width, row = size_t(r) * width;
        const double mass = batch.mesh->node_mass[part.pattern->master[r]];
        for (size_t d = 0; d < width; d += size_t(batch.lanes))
            for (size_t lane = 0; lane < size_t(batch.lanes); ++lane) {
                const size_t i = d + lane;
                part.product[row + i]
                    = (part.internal[row + i] - data.force[node + i]) * inverse + mass * part.held[lane] * x[row + i];
            }
    }
}

template <int Dim> double ImplicitGrains<Dim>::begin_conjugate(const SurfaceField& forces)
{
    return sum_over_parts([&](Part& part) {
        multiply(part, part.direction);
        for (size_t k = 0; k < part.rhs.size(); ++k)
            part.residual[k] = part.rhs[k] - part.product[k];
        add_surface_forces(part, forces, 1, part.residual);
        std::fill(part.conjugate.begin(), part.conjugate.end(), 0.0);
        return dot(part, part.rhs, part.direction);
    });
}

template <int Dim> double ImplicitGrains<Dim>::precondition(SurfaceField& way, const SurfaceField* further)
{
    return sum_over_parts([&](Part& part) {
        part.loads = part.residual;
        if (further) add_surface_forces(part, *further, 1, part.loads);
        stiffness_kernels().solve[part.batch->wide()](part.batch->data(), part.pattern, part.matrix.data(),
                                                      part.loads.data());
        interpolate(part, part.loads, way);
        return dot(part, part.residual, part.loads);
    });
}

template <int Dim> void ImplicitGrains<Dim>::turn_conjugate(double share)
{
    each_part([&](Part& part) {
        for (size_t k = 0; k < part.conjugate.size(); ++k)
            part.conjugate[k] = part.loads[k] + share * part.conjugate[k];
    });
}

template <int Dim> double ImplicitGrains<Dim>::curvature(const SurfaceField& forces)
{
    return sum_over_parts([&](Part& part) {
        multiply(part, part.conjugate);
        add_surface_forces(part, forces, -1, part.product);
        return dot(part, part.product, part.conjugate);
    });
}

template <int Dim> void ImplicitGrains<Dim>::go_conjugate(double share)
{
    each_part([&](Part& part) {
        for (size_t k = 0; k < part.conjugate.size(); ++k) {
            part.direction[k] += share * part.conjugate[k];
            part.residual[k] -= share * part.product[k];
        }
    });
}

template <int Dim> void ImplicitGrains<Dim>::take_direction(SurfaceField& way)
{
    each_part([&](Part& part) {
        const size_t width = size_t(Dim) * part.batch->lanes;
        for (int r = 0; r < part.pattern->rows; ++r)
            std::copy_n(&part.direction[size_t(r) * width], width, &part.step[size_t(part.pattern->master[r]) * width]);
        interpolate(part, part.direction, way);
    });
    reach_ = 0;
    for (const Part& part : parts_)
        reach_ = std::max(reach_, part.farthest);
}

template class ImplicitGrains<2>;

} // namespace softgrain
