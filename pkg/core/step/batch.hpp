// SPDX-License-Identifier: GPL-2.0-or-later
// Grains that share a discretisation and a material law, side by side in lanes, and the kernels that advance
// them. Lengths are in units of each grain's radius; arrays are [node or surface point][Dim][lane]. A grain's
// current node positions are X + u: rotation and translation are part of u.
#pragma once

#include "base/aligned.hpp"
#include "base/tensor.hpp"
#include "grid/discretisation.hpp"

#include <memory>
#include <string>

namespace softgrain {

constexpr int max_parameters = 7;

/// What a kernel needs, as plain pointers.
template <int Dim> struct KernelData {
    int node_count, master_count, region_count, surface_count;
    double cell_width;
    const Vec<Dim>* node_position;
    const double* node_mass;
    const double* inverse_mass;
    const double* mean_gradient;
    const typename Discretisation<Dim>::Link* links;
    const int* slave_row;
    const typename Discretisation<Dim>::Region* regions;
    const typename Discretisation<Dim>::Block* blocks;
    const double* gradient;
    const typename Discretisation<Dim>::SurfaceStencil* surface_stencil;
    const BoundaryPoint<Dim>* surface_point;

    double* displacement;
    double* velocity;              ///< [radius / s]
    double* force;                 ///< on the masters, per radius^(Dim-1) [Pa]; scratch between the kernels
    double* surface;               ///< values at the surface points, as each kernel says
    const double* parameters;      ///< of the law, [parameter][lane] [Pa]
    const double* inverse_inertia; ///< 1 / (density radius^2), [lane]: from force to acceleration / radius
    double* memory;                ///< what the points remember, [point][number][lane]
};

/// Sums over the masters of a grain, weighted by mass, per lane: where the entries of the array stand.
template <int Dim> struct MotionSums {
    static constexpr int spins = Dim * (Dim - 1) / 2;
    static constexpr int position = 0, velocity = Dim, spin = 2 * Dim, second = spin + spins, kinetic = second + Dim * Dim,
                         gradient = kinetic + 1, count = gradient + Dim * Dim;
};

/// What becomes of the surface of a grain as a whole: where the entries of the array stand.
template <int Dim> struct SurfaceExtent {
    static constexpr int speed2 = 0, low = 1, high = 1 + Dim, count = 1 + 2 * Dim; ///< [radius2/s2], [radius], [radius]
};

/// A kernel for batches of one lane and of eight.
template <int Dim, class... Arguments> using KernelPair = std::array<void (*)(const KernelData<Dim>&, Arguments...), 2>;

template <int Dim> struct StiffnessPattern;

/// Kernels of one law.
template <int Dim> struct LawKernels {
    const char* name;
    int parameter_count;
    const char* const* parameter_names;
    double (*wave_modulus)(const double* parameters);
    double (*shear_modulus)(const double* parameters);
    std::string (*complaint)(const double* parameters);
    /// Internal force on the masters into `force`; smallest J of a point into min_J [lane].
    KernelPair<Dim, double*> internal_force;
    /// Elastic energy per radius^Dim [J/m^Dim] and smallest principal stretch, [lane].
    KernelPair<Dim, double*, double*> energy;
    /// Stiffness under a displacement of the pattern's rows, with an inertia per unit of node mass, [lane] [Pa]: parameters,
    /// displacement, inertia, matrix; see stiffness_kernel.hpp.
    std::array<void (*)(const StiffnessPattern<Dim>*, double*, double*, double*, double*), 2> stiffness;
    /// Cauchy stress at one point, sigma = P F^T / J, from the three-dimensional F and its region's mean J [Pa]; what the point
    /// remembers stands behind the parameters.
    Mat<3> (*cauchy_stress)(const double* parameters, const Mat<3>& F, double mean_J);
    /// The same as in internal_force for the points of one region: first Piola stresses times `scale` in place of their
    /// deformation gradients; returns the smallest J. Null where points remember, as is region_energy.
    double (*region_stress)(const double* parameters, double share, double scale, Tensor<Dim, double>* F) = nullptr;
    /// The same as in energy for one region of this volume; `min_stretch` falls to the smallest stretch.
    double (*region_energy)(const double* parameters, double share, double volume, const Tensor<Dim, double>* F,
                            double& min_stretch)
        = nullptr;
    int memory_count = 0;                 ///< numbers that a point remembers; 0: what follows is not there
    const double* first_memory = nullptr; ///< what they are at the start
    /// Makes the points remember the end of a step; what was dissipated, per radius^Dim [J/m^Dim], [lane].
    KernelPair<Dim, double*> advance {};
    /// Parameters with which nothing is dissipated.
    std::array<double, max_parameters> (*elastic)(std::array<double, max_parameters> parameters) = nullptr;
};

/// Kernels of every law.
template <int Dim> struct MotionKernels {
    /// v at the surface into `surface`, its largest size into `extent`.
    KernelPair<Dim, double*> velocities;
    /// v += dt f / m + gain, gain [Dim][lane]; then as velocities.
    KernelPair<Dim, double, double*, double*> kick;
    /// v += impulses in `surface` [density radius^(Dim+1) / s] over the masses; then as velocities.
    KernelPair<Dim, double*> push;
    /// u += dt v.
    KernelPair<Dim, double> drift;
    /// Displacements of the slaves.
    KernelPair<Dim> extend;
    /// Displacements of the slaves; surface positions into `surface`, their box into `extent`; motion sums [count][lane]
    /// into `sums`.
    KernelPair<Dim, double*, double*> observe;
};

/// The laws there are. Throws UserError, naming them, for another name.
template <int Dim> const LawKernels<Dim>& law_kernels(const std::string& name);
template <int Dim> const MotionKernels<Dim>& motion_kernels();

/// Arrays of up to `lanes` grains (1 or 8).
template <int Dim> class Batch {
public:
    Batch(std::shared_ptr<const Discretisation<Dim>> mesh, const LawKernels<Dim>& law, int lanes);

    const std::shared_ptr<const Discretisation<Dim>> mesh;
    const LawKernels<Dim>& law;
    const int lanes;
    /// Values at the surface and forces, valid until the next batch is worked on: a thread's batches share the
    /// room, which then stays in its cache.
    double* surface();
    double* force();
    AlignedVector displacement, velocity, memory, parameters, inverse_inertia, sums, extent, gain, per_lane;
    AlignedVector viscosity; ///< [lane] [Pa s]; empty where no grain has any, and so is
    AlignedVector viscous;   ///< what viscosity gives in a step, per radius^(Dim-1) [Pa s]

    KernelData<Dim> data();
    /// What the points of the grain in a lane remember, [point][number].
    void set_memory(int lane, const std::vector<double>& values)
    {
        for (size_t k = 0; k < values.size(); ++k)
            memory[k * lanes + lane] = values[k];
    }
    /// Of the law, of the grain in a lane [Pa].
    void set_parameters(int lane, const std::array<double, max_parameters>& values)
    {
        for (int k = 0; k < max_parameters; ++k)
            parameters[size_t(k) * lanes + lane] = values[k];
    }
    /// Of the grain in a lane [Pa s].
    void set_viscosity(int lane, double value)
    {
        viscosity.resize(lanes);
        viscous.resize(displacement.size());
        viscosity[lane] = value;
    }
    /// Index into the kernel tables.
    int wide() const { return lanes == 8; }
};

extern template class Batch<2>;

} // namespace softgrain
