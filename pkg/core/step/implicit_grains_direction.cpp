// SPDX-License-Identifier: GPL-2.0-or-later
// The linear algebra of a search direction.
#include "step/implicit_grains.hpp"

#include <cmath>

namespace softgrain {

/// Adds a share of surface forces [N] to rows.
template <int Dim>
void ImplicitGrains<Dim>::add_surface_forces(const Part& part, const SurfaceField& forces, double share,
                                             AlignedVector& rows) const
{
    const auto& pattern = *part.body->pattern;
    const int lanes = part.lanes();
    double unit[most_lanes];
    for (size_t lane = 0; lane < part.index.size(); ++lane)
        unit[lane] = share * std::pow(part.grain(lane).radius, 1 - Dim);
    for (int p = 0; p < pattern.surface_count(); ++p) {
        double force[Dim][most_lanes] = {};
        bool any = false;
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            for (int d = 0; d < Dim; ++d) {
                force[d][lane] = unit[lane] * forces[part.index[lane]][size_t(Dim) * p + d];
                any |= force[d][lane] != 0;
            }
        }
        for (int k = pattern.surface_start[p]; any && k < pattern.surface_start[p + 1]; ++k) {
            const auto& [row, weight] = pattern.surface[k];
            for (int d = 0; d < Dim; ++d)
                for (int lane = 0; lane < lanes; ++lane)
                    rows[part.at(row, d, lane)] += weight * force[d][lane];
        }
    }
}

/// What rows are at the surfaces [m, m/s]; the largest over its radius.
template <int Dim>
double ImplicitGrains<Dim>::interpolate(const Part& part, const AlignedVector& rows, SurfaceField& field) const
{
    const auto& pattern = *part.body->pattern;
    const int lanes = part.lanes();
    double largest = 0;
    for (int p = 0; p < pattern.surface_count(); ++p) {
        double sum[Dim][most_lanes] = {};
        for (int k = pattern.surface_start[p]; k < pattern.surface_start[p + 1]; ++k) {
            const auto& [row, weight] = pattern.surface[k];
            for (int d = 0; d < Dim; ++d)
                for (int lane = 0; lane < lanes; ++lane)
                    sum[d][lane] += weight * rows[part.at(row, d, lane)];
        }
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            double length = 0;
            for (int d = 0; d < Dim; ++d) {
                field[part.index[lane]][size_t(Dim) * p + d] = part.grain(lane).radius * sum[d][lane];
                length += sum[d][lane] * sum[d][lane];
            }
            largest = std::max(largest, length);
        }
    }
    return std::sqrt(largest);
}

template <int Dim> void ImplicitGrains<Dim>::condense(const std::vector<double>& damping, bool anew)
{
    constexpr double alike = 2.5;
    each_part([&](Part& part) {
        ImplicitBody<Dim>& body = *part.body;
        const int lanes = part.lanes(), points = body.pattern->surface_count();
        bool needed = anew;
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            part.held[lane] = part.inertia[lane] + damping[part.index[lane]];
            const double ratio = part.held[lane] / part.factored[lane];
            needed |= ratio > alike || ratio < 1 / alike;
        }
        if (!needed) return;
        part.factored = part.held;
        thread_local AlignedVector room;
        const size_t size = size_t(points) * part.rows() * Dim * Dim * lanes;
        if (room.size() < size) room.resize(size);
        const auto& kernels = stiffness_kernels();
        body.law().stiffness[body.wide()](body.pattern.get(), body.parameters, part.place.data(), part.held.data(),
                                          part.matrix.data());
        kernels.factorise[body.wide()](body.pattern.get(), part.matrix.data());
        kernels.compliance[body.wide()](body.pattern.get(), part.matrix.data(), room.data(), part.compliance.data());
        for (size_t lane = 0; lane < part.index.size(); ++lane) {
            const double unit = std::pow(part.grain(lane).radius, 2 - Dim);
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
        stiffness_kernels().solve[part.body->wide()](part.body->pattern.get(), part.matrix.data(), part.direction.data());
        interpolate(part, part.direction, way);
    });
}

/// Product of two vectors of rows, a force and a displacement [J].
template <int Dim> double ImplicitGrains<Dim>::dot(const Part& part, const AlignedVector& a, const AlignedVector& b)
{
    double of_lane[most_lanes] = {};
    const size_t lanes = size_t(part.lanes());
    for (size_t k = 0; k < a.size(); k += lanes)
        for (size_t lane = 0; lane < lanes; ++lane)
            of_lane[lane] += a[k + lane] * b[k + lane];
    double sum = 0;
    for (size_t lane = 0; lane < part.index.size(); ++lane)
        sum += of_lane[lane] * std::pow(part.grain(lane).radius, Dim);
    return sum;
}

/// product <- A x without contact forces, as a difference of internal forces.
template <int Dim> void ImplicitGrains<Dim>::multiply(Part& part, const AlignedVector& x)
{
    constexpr double small = 1e-8; // displacement [radius]: squared it has to be small to lambda / mu = 1e4 too
    double largest = 1e-300;
    for (double value : x)
        largest = std::max(largest, std::abs(value));
    const double scale = small / largest, inverse = largest / small;
    for (size_t k = 0; k < x.size(); ++k)
        part.place[k] = part.base[k] + scale * x[k];
    part.body->forces(part.place, part.product);
    part.each_component([&](size_t lane, int r, int, size_t k) {
        part.product[k] = (part.internal[k] - part.product[k]) * inverse + part.mass(r) * part.held[lane] * x[k];
    });
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
        stiffness_kernels().solve[part.body->wide()](part.body->pattern.get(), part.matrix.data(), part.loads.data());
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
        part.step = part.direction;
        part.farthest = interpolate(part, part.direction, way);
    });
    reach_ = 0;
    for (const Part& part : parts_)
        reach_ = std::max(reach_, part.farthest);
}

template class ImplicitGrains<2>;

} // namespace softgrain
