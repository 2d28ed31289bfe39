// SPDX-License-Identifier: GPL-2.0-or-later
// The register of material laws, and the kernels in all their versions.
#include "step/kernels.hpp"

#include "material/mooney_rivlin.hpp"
#include "material/neo_hookean.hpp"
#include "material/ogden.hpp"
#include "material/plastic.hpp"
#include "step/advance_kernel.hpp"
#include "step/stiffness_kernel.hpp"
#include "step/versions.hpp"

#include <algorithm>

namespace softgrain {
namespace {

    template <class Law> Mat<3> cauchy_stress(const double* p, const Mat<3>& deformation, double mean_J)
    {
        Tensor<3, double> F, P;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                F.at[i][j] = deformation(i, j);
        const double J = determinant(F), slope = Law::volumetric_slope(p, mean_J, 1 / mean_J);
        const Tensor<3, double> cof = cofactor(F);
        Law::template stress<3, double>(p, F, cof, 1 / J, P);
        Mat<3> first_piola;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                first_piola(i, j) = P.at[i][j] + slope * cof.at[i][j];
        return first_piola * deformation.transpose() / J;
    }

    template <int Dim, class Law> double region_stress(const double* p, double share, double scale, Tensor<Dim, double>* F)
    {
        double constants[Law::parameters.size()], smallest = 1e300;
        std::copy_n(p, Law::parameters.size(), constants);
        kernels::region_stress<Dim, Law, 1>(constants, nullptr, share, scale, F, smallest);
        return smallest;
    }

    template <int Dim, class Law>
    double region_energy(const double* p, double share, double volume, const Tensor<Dim, double>* F, double& min_stretch)
    {
        double constants[Law::parameters.size()], sum = 0;
        std::copy_n(p, Law::parameters.size(), constants);
        kernels::region_energy<Dim, Law, 1>(constants, nullptr, share, volume, F, sum, min_stretch);
        return sum;
    }

    template <int Dim, class Law> LawKernels<Dim> kernels_of()
    {
        LawKernels<Dim> kernels { Law::name,
                                  int(Law::parameters.size()),
                                  Law::parameters.data(),
                                  &Law::wave_modulus,
                                  &Law::template shear_modulus<double>,
                                  &Law::complaint,
                                  Versions<kernels::InternalForce<Dim, Law>, const KernelData<Dim>&, double*>::table(),
                                  Versions<kernels::Energy<Dim, Law>, const KernelData<Dim>&, double*, double*>::table(),
                                  Versions<kernels::Stiffness<Dim, Law>, const StiffnessPattern<Dim>*, double*, double*,
                                           double*, double*>::table(),
                                  &cauchy_stress<Law> };
        if constexpr (Law::memory.empty()) {
            kernels.region_stress = &region_stress<Dim, Law>;
            kernels.region_energy = &region_energy<Dim, Law>;
        } else {
            kernels.memory_count = int(Law::memory.size());
            kernels.first_memory = Law::memory.data();
            kernels.advance = Versions<kernels::Advance<Dim, Law>, const KernelData<Dim>&, double*>::table();
            kernels.elastic = &Law::template elastic<std::array<double, max_parameters>>;
        }
        return kernels;
    }

    /// The register of laws.
    template <int Dim> const std::vector<LawKernels<Dim>>& laws()
    {
        static const std::vector<LawKernels<Dim>> all {
            kernels_of<Dim, NeoHookean>(), kernels_of<Dim, MooneyRivlin>(), kernels_of<Dim, Plastic>(),
            kernels_of<Dim, Ogden<1>>(),   kernels_of<Dim, Ogden<2>>(),     kernels_of<Dim, Ogden<3>>(),
        };
        return all;
    }

} // namespace

template <int Dim> const LawKernels<Dim>& law_kernels(const std::string& name)
{
    std::string known;
    for (const LawKernels<Dim>& law : laws<Dim>()) {
        if (name == law.name) return law;
        known += (known.empty() ? "" : ", ") + std::string(law.name);
    }
    throw UserError("material law '" + name + "' is not there; take one of: " + known + ".");
}

template <int Dim> const MotionKernels<Dim>& motion_kernels()
{
    static const MotionKernels<Dim> all {
        Versions<kernels::Velocities<Dim>, const KernelData<Dim>&, double*>::table(),
        Versions<kernels::Kick<Dim>, const KernelData<Dim>&, double, double*, double*>::table(),
        Versions<kernels::Push<Dim>, const KernelData<Dim>&, double*>::table(),
        Versions<kernels::Drift<Dim>, const KernelData<Dim>&, double>::table(),
        Versions<kernels::Extend<Dim>, const KernelData<Dim>&>::table(),
        Versions<kernels::Observe<Dim>, const KernelData<Dim>&, double*, double*>::table()
    };
    return all;
}

template const LawKernels<2>& law_kernels<2>(const std::string&);
template const MotionKernels<2>& motion_kernels<2>();

} // namespace softgrain
