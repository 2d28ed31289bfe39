// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "grid/point_grid.hpp"
#include "step/batch.hpp"

#include <optional>

namespace softgrain {

/// State of a grain in the updated-Lagrangian form: the points carry it, and the grid is laid anew under them in every
/// step. Lengths in units of the grain's radius, places relative to its origin, as in a Batch.
template <int Dim> class UpdatedBody {
public:
    // carried from step to step
    std::vector<Vec<Dim>> position, velocity; ///< of the material points [radius], [radius/s]
    std::vector<Mat<Dim>> deformation;        ///< deformation gradients at the points
    std::vector<Vec<Dim>> surface;            ///< positions of the surface points, which move with the grid
    std::optional<double> spin; ///< angular momentum about the centre of mass, per unit density; none: the points'

    /// All fields of the undeformed grain at rest, turned.
    void place(const Discretisation<Dim>& mesh, const Mat<Dim>& rotation);
    /// Lays the grid under the points as they are and brings their velocities to it. Throws SimulationError.
    void settle(const Discretisation<Dim>& mesh);

    /// v += dt f / m + gain at the nodes, dt over the inertia density radius^2 as `scale`; the smallest J of a point.
    double kick(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law, const double* parameters, double scale,
                const Vec<Dim>& gain);
    /// Impulse on a surface point [density radius^(Dim+1) / s].
    void push(int surface_point, const Vec<Dim>& impulse);
    /// Points and surface move with the nodes; deformations follow. False, and nothing is done, when a value is not finite.
    bool drift(double dt);
    /// The same by ways and velocities that another scheme found, node by node, and took this time for.
    void leave(int node, const Vec<Dim>& way, const Vec<Dim>& velocity);
    bool arrive(double dt);
    /// Adds a velocity that is linear in space to points and nodes: at the centre, and its gradient.
    void add_velocity(const Vec<Dim>& centre, const Vec<Dim>& of_centre, const Mat<Dim>& gradient);

    Vec<Dim> velocity_at_surface(int point) const;
    /// Sums of the nodes and of F - 1, as MotionKernels::observe gives them.
    std::array<double, MotionSums<Dim>::count> sums(const Discretisation<Dim>& mesh) const;
    /// Elastic energy [per radius^Dim] `back` before the end of the last step, with the velocity gradients of that step.
    double elastic_energy(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law, const double* parameters, double dt,
                          double back, double& min_stretch) const;
    const SurfaceOperator<Dim>& response() const { return grid_.response; }
    const PointGrid<Dim>& grid() const { return grid_; }
    const std::vector<Vec<Dim>>& node_velocity() const { return node_velocity_; }

    /// What is carried from step to step, one number after the other.
    std::vector<double> packed() const;
    /// The reverse, of a body that was placed; false, and nothing is done, when the size does not fit.
    bool unpack(const std::vector<double>& values);

private:
    Vec<Dim> at_surface(const std::vector<Vec<Dim>>& field, int point) const;
    double spin_of_nodes() const;
    void restore_spin();

    PointGrid<Dim> grid_;
    std::vector<Vec<Dim>> node_velocity_, node_way_, force_;
    std::vector<Mat<Dim>> rate_; ///< velocity gradients at the points in the last step
};

extern template class UpdatedBody<2>;

} // namespace softgrain
