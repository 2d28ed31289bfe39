// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "contact/surface.hpp"
#include "step/batch.hpp"
#include "step/updated.hpp"

#include <memory>
#include <optional>

namespace softgrain {

/// Rigid part of a grain's motion.
template <int Dim> struct Motion {
    static constexpr int spins = MotionSums<Dim>::spins;
    Vec<Dim> position = Vec<Dim>::Zero(), velocity = Vec<Dim>::Zero(); ///< of the centre of mass [m], [m/s]
    Eigen::Matrix<double, spins, 1> angular_momentum = Eigen::Matrix<double, spins, 1>::Zero(); ///< about it [kg m2/s]
    Mat<Dim> second_moment = Mat<Dim>::Zero();                                                  ///< of mass about it [kg m2]
    Mat<Dim> mean_gradient = Mat<Dim>::Identity(); ///< mean deformation gradient F
    double kinetic = 0;                            ///< [J]
};

/// A grain that moves as a rigid body: as it was when it began to, turned by an angle since. The motion has its place and velocities.
template <int Dim> struct Flight {
    std::vector<double> displacement; ///< of the masters [radius]
    Vec<Dim> centre;                  ///< of mass, X + u [radius]
    std::vector<Vec<Dim>> arms;       ///< of the surface points, from there [m]
    double outer = 0;                 ///< the longest of them [m]
    double angle = 0;                 ///< [rad]
};

/// A soft grain: what it is made of, and its state. While it belongs to an Assembly the node fields live there;
/// `pull` brings them here.
template <int Dim> struct Grain {
    int id = -1; ///< what messages call it
    std::shared_ptr<const Discretisation<Dim>> mesh;
    const LawKernels<Dim>* law = nullptr;
    std::array<double, max_parameters> parameters {}; ///< of the law [Pa]
    double density = 0, radius = 0;                   ///< [kg/m3], [m] (equal-volume radius)
    double viscosity = 0;                             ///< [Pa s], see step/viscosity.hpp
    Vec<Dim> origin = Vec<Dim>::Zero();               ///< a node is at origin + radius (X + u) [m]
    std::vector<double> displacement, velocity;       ///< of the masters, [node][Dim] [radius], [radius/s]
    std::vector<double> memory;                       ///< of the points, [point][number]; empty where the law has none
    /// Updated-Lagrangian: its state, instead of the node fields. None, as it is unless set before place(): total-Lagrangian.
    std::optional<UpdatedBody<Dim>> updated;
    Surface<Dim> surface;
    Motion<Dim> motion;
    std::optional<Flight<Dim>> flight;              ///< see step/rigid_flight.hpp
    Vec<Dim> acceleration = Vec<Dim>::Zero();       ///< by forces on the grain as a whole, besides gravity [m/s2]
    Mat<Dim> spin_acceleration = Mat<Dim>::Zero();  ///< by torques on it, rate of a velocity gradient [1/s2]
    double min_J = 1, min_stretch = 1, elastic = 0; ///< elastic energy [J], as of the last evaluation

    double mass() const { return density * mesh->moments.volume * std::pow(radius, Dim); }
    double reference_volume() const { return mesh->moments.volume * std::pow(radius, Dim); }
    /// At rest, undeformed, turned by `rotation`, centre at `centre`; sizes all fields.
    void place(const Vec<Dim>& centre, const Mat<Dim>& rotation, const Vec<Dim>& velocity,
               const Mat<Dim>& velocity_gradient);
    /// The points remember nothing but what they do at the start.
    void forget();
    /// Surface and motion from the node fields held here, or from the points.
    void refresh();
    /// Surface and motion of an updated-Lagrangian grain after its nodes have moved; lays its grid anew where that is due.
    void settle();
    /// Velocities of the surface points of an updated-Lagrangian grain on the grid as it is, [point][Dim] [m/s].
    void read_velocities(std::vector<double>& field) const;
    /// Positions of the surface points, where they are stale.
    void renew_positions();
    /// Moves the grain as it is.
    void translate(const Vec<Dim>& shift);
    /// Adds a rigid motion to the velocities of nodes and surface: of the centre of mass [m/s], and about it [1/s].
    void add_velocity(const Vec<Dim>& of_centre, const Mat<Dim>& gradient);
    /// Current positions of the material points, [point] [m].
    std::vector<Vec<Dim>> point_positions() const;
    /// Deformation gradients at the material points.
    std::vector<Mat<Dim>> deformation_gradients() const;
    /// Cauchy stresses at the material points [Pa]; in 2D plane strain, with the out-of-plane stress.
    std::vector<Mat<3>> cauchy_stresses() const;
    /// Plastic strains that have gathered at the material points; zeros where there is no plasticity.
    std::vector<double> plastic_strains() const;
    /// Elastic energy now [J], from the node fields held here; renews `elastic` and `min_stretch` too.
    double elastic_energy();
    /// Velocities of the material points [m/s].
    std::vector<Vec<Dim>> point_velocities() const;

    int number = 0;              ///< among the grains of its assembly
    Batch<Dim>* batch = nullptr; ///< of the assembly it belongs to; none in flight
    int lane = 0;
    /// Brings the node fields from the batch, if there is one, or from the motion of a flight.
    void pull();
    /// Hands them back.
    void put();

    /// A batch of it alone, with the fields that it holds, and its surface positions.
    Batch<Dim> alone() const;
    /// Positions of the surface points in a batch [radius].
    void take_positions(const double* of_surface);

private:
    void refresh_from_nodes();
    void add_to_nodes(const Vec<Dim>& centre, const Vec<Dim>& of_centre, const Mat<Dim>& gradient);
    std::vector<Vec<Dim>> at_points(const std::vector<double>& field) const;
    std::vector<double> with_slaves(const std::vector<double>& field) const;
};

/// Velocity gradient of a rotation in the plane [1/s].
inline Mat<2> rotation_rate(double spin) { return (Mat<2>() << 0, -spin, spin, 0).finished(); }

/// Motion from the sums of MotionKernels::observe; `stride` apart in the array.
template <int Dim> Motion<Dim> motion_of(const Grain<Dim>& grain, const double* sums, int stride);

extern template struct Grain<2>;

} // namespace softgrain
