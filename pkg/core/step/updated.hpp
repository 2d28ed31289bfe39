// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "grid/point_grid.hpp"
#include "step/batch.hpp"

namespace softgrain {

/// State of a grain in the updated-Lagrangian form: a grid that is laid under the points where they stand, moves with them, and
/// is laid anew under where they are then, once its cells are out of shape. Its axes are strained like the grain as a mean, so
/// that a squeezed grain is not resolved the worse. The points carry their deformation from grid to grid. Lengths in units of
/// the grain's radius, places relative to its origin, as in a Batch.
template <int Dim> class UpdatedBody {
public:
    /// All fields of the uniformly deformed grain at rest.
    void place(const Discretisation<Dim>& mesh, const Mat<Dim>& deformation_gradient);
    /// Lays the grid anew when cells are out of shape. Throws SimulationError.
    void settle(const Discretisation<Dim>& mesh);

    /// v += dt f / m + gain at the nodes, dt over the inertia density radius^2 as `scale`; the smallest J of a point.
    double kick(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law, const double* parameters, double scale,
                const Vec<Dim>& gain);
    /// Impulse on a surface point [density radius^(Dim+1) / s].
    void push(int surface_point, const Vec<Dim>& impulse);
    /// Nodes move with their velocities; false, and nothing is done, when a value is not finite.
    bool drift(double dt);
    /// Puts a node where another scheme wants it, with its velocity; after all of them, `arrive`.
    void put(int node, const Vec<Dim>& position, const Vec<Dim>& velocity);
    /// Points and surface follow the nodes; false, and nothing is done, when a value is not finite.
    bool arrive();
    /// Adds a velocity that is linear in space: at the centre, and its gradient.
    void add_velocity(const Vec<Dim>& centre, const Vec<Dim>& of_centre, const Mat<Dim>& gradient);

    /// Sums of the nodes and of F - 1, as MotionKernels::observe gives them.
    std::array<double, MotionSums<Dim>::count> sums(const Discretisation<Dim>& mesh) const;
    /// Elastic energy [per radius^Dim] of the place that the nodes had this time ago at their velocities.
    double elastic_energy(const Discretisation<Dim>& mesh, const LawKernels<Dim>& law, const double* parameters, double back,
                          double& min_stretch) const;
    const SurfaceOperator<Dim>& response() const { return grid_.response; }
    const PointGrid<Dim>& grid() const { return grid_; }
    const std::vector<Vec<Dim>>& node_velocity() const { return node_velocity_; }
    const std::vector<Vec<Dim>>& point_positions() const { return position_; }
    std::vector<Vec<Dim>> point_velocities() const;
    /// At the points.
    const std::vector<Mat<Dim>>& deformation_gradients() const { return deformation_; }
    /// The same when the grid was laid.
    const std::vector<Mat<Dim>>& carried() const { return laid_.deformation; }
    const std::vector<Vec<Dim>>& surface() const { return surface_; }
    Vec<Dim> velocity_at_surface(int point) const;

    /// The state, one number after the other.
    std::vector<double> packed() const;
    /// The reverse, of a body that was placed; false when the size does not fit. Throws SimulationError.
    bool unpack(const Discretisation<Dim>& mesh, const std::vector<double>& values);

private:
    /// Of the nodes: mass, motion of the centre of mass, angular momentum and moment of inertia about it, kinetic energy.
    struct Whole {
        double mass = 0, spin = 0, inertia = 0, kinetic = 0;
        Vec<Dim> centre = Vec<Dim>::Zero(), velocity = Vec<Dim>::Zero();
    };
    Whole whole() const;
    void lay(const Discretisation<Dim>& mesh);
    void gather(const std::vector<double>& masses, const std::vector<Vec<Dim>>& velocity, const std::vector<Mat<Dim>>& rate);
    void keep(const Whole& before);
    Mat<Dim> mean_deformation(const Discretisation<Dim>& mesh) const;
    double largest_stretch(const Discretisation<Dim>& mesh) const;
    /// Sum of a field of the nodes times the gradients of their shape functions, as the grid was laid, at a point.
    Mat<Dim> gradient_at(const std::vector<Vec<Dim>>& field, int point) const;
    Vec<Dim> at_point(const std::vector<Vec<Dim>>& field, int point) const;
    Vec<Dim> at_surface(const std::vector<Vec<Dim>>& field, int point) const;

    /// As things stood when the grid was laid.
    struct {
        std::vector<Vec<Dim>> position, surface;
        std::vector<Mat<Dim>> deformation;
        Mat<Dim> mean;
    } laid_;
    PointGrid<Dim> grid_;                         ///< its node positions move
    std::vector<Vec<Dim>> node_velocity_, force_; ///< [radius/s]; scratch
    std::vector<Vec<Dim>> position_, surface_;    ///< of the points and surface points, with the nodes
    std::vector<Mat<Dim>> deformation_;           ///< the same
};

extern template class UpdatedBody<2>;

} // namespace softgrain
