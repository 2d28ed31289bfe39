// SPDX-License-Identifier: GPL-2.0-or-later
// Compiles every kernel for AVX-512, AVX2 and plain x86-64, and picks by the processor when the program starts.
#include "step/kernels.hpp"

#include "material/mooney_rivlin.hpp"
#include "material/neo_hookean.hpp"

namespace softgrain {
namespace {

    enum class InstructionSet { plain, avx2, avx512 };

    InstructionSet instruction_set()
    {
        __builtin_cpu_init();
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")
            && __builtin_cpu_supports("avx512bw"))
            return InstructionSet::avx512;
        return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? InstructionSet::avx2
                                                                               : InstructionSet::plain;
    }

    // The same arrays from a further lane on.
    double* from_lane(double* array, int lane) { return array + lane; }
    double from_lane(double value, int) { return value; }
    template <int Dim> KernelData<Dim> from_lane(KernelData<Dim> data, int lane)
    {
        for (double** array : { &data.displacement, &data.velocity, &data.force, &data.surface })
            *array += lane;
        data.parameters += lane;
        data.inverse_inertia += lane;
        return data;
    }

    /// One kernel for one lane and for eight, in all its versions.
    template <class Kernel, int Dim, class... Arguments> struct Versions {
        using Function = void (*)(const KernelData<Dim>&, Arguments...);

        __attribute__((target("arch=x86-64-v4"))) static void eight_avx512(const KernelData<Dim>& data,
                                                                           Arguments... arguments)
        {
            Kernel::template run<Lanes<8>::Value, 8>(data, arguments...);
        }
        __attribute__((target("arch=x86-64-v3"))) static void eight_avx2(const KernelData<Dim>& data, Arguments... arguments)
        {
            for (int lane = 0; lane < 8; lane += 4)
                Kernel::template run<Lanes<4>::Value, 8>(from_lane(data, lane), from_lane(arguments, lane)...);
        }
        static void eight_plain(const KernelData<Dim>& data, Arguments... arguments)
        {
            for (int lane = 0; lane < 8; lane += 2)
                Kernel::template run<Lanes<2>::Value, 8>(from_lane(data, lane), from_lane(arguments, lane)...);
        }
        __attribute__((target("arch=x86-64-v3"))) static void one_avx2(const KernelData<Dim>& data, Arguments... arguments)
        {
            Kernel::template run<double, 1>(data, arguments...);
        }
        static void one_plain(const KernelData<Dim>& data, Arguments... arguments)
        {
            Kernel::template run<double, 1>(data, arguments...);
        }
        static std::array<Function, 2> table()
        {
            switch (instruction_set()) {
            case InstructionSet::avx512:
                return { one_avx2, eight_avx512 };
            case InstructionSet::avx2:
                return { one_avx2, eight_avx2 };
            default:
                return { one_plain, eight_plain };
            }
        }
    };

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
        double smallest = 1e300;
        kernels::region_stress<Dim, Law>(p, share, scale, F, smallest);
        return smallest;
    }

    template <int Dim, class Law>
    double region_energy(const double* p, double share, double volume, const Tensor<Dim, double>* F, double& min_stretch)
    {
        double sum = 0;
        kernels::region_energy<Dim, Law>(p, share, volume, F, sum, min_stretch);
        return sum;
    }

    template <int Dim, class Law> LawKernels<Dim> kernels_of()
    {
        return { Law::name,
                 int(Law::parameters.size()),
                 Law::parameters.data(),
                 &Law::wave_modulus,
                 &Law::complaint,
                 Versions<kernels::InternalForce<Dim, Law>, Dim, double*>::table(),
                 Versions<kernels::Energy<Dim, Law>, Dim, double*, double*>::table(),
                 &cauchy_stress<Law>,
                 &region_stress<Dim, Law>,
                 &region_energy<Dim, Law> };
    }

    /// The register of laws.
    template <int Dim> const std::vector<LawKernels<Dim>>& laws()
    {
        static const std::vector<LawKernels<Dim>> all { kernels_of<Dim, NeoHookean>(), kernels_of<Dim, MooneyRivlin>() };
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
    static const MotionKernels<Dim> all { Versions<kernels::Kick<Dim>, Dim, double, double*>::table(),
                                          Versions<kernels::Push<Dim>, Dim>::table(),
                                          Versions<kernels::Drift<Dim>, Dim, double>::table(),
                                          Versions<kernels::Extend<Dim>, Dim>::table(),
                                          Versions<kernels::Observe<Dim>, Dim, double*>::table() };
    return all;
}

template const LawKernels<2>& law_kernels<2>(const std::string&);
template const MotionKernels<2>& motion_kernels<2>();

} // namespace softgrain
