// SPDX-License-Identifier: GPL-2.0-or-later
// Compiles kernels for AVX-512, AVX2 and plain x86-64, and picks by the processor when the program starts.
#pragma once

#include "step/batch.hpp"

namespace softgrain {

enum class InstructionSet { plain, avx2, avx512 };

inline InstructionSet instruction_set()
{
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")
        && __builtin_cpu_supports("avx512bw"))
        return InstructionSet::avx512;
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? InstructionSet::avx2 : InstructionSet::plain;
}

// The same arrays from a further lane on; what all lanes share stays what it is.
inline double* from_lane(double* array, int lane) { return array + lane; }
inline double from_lane(double value, int) { return value; }
template <class Shared> const Shared* from_lane(const Shared* shared, int) { return shared; }
template <int Dim> KernelData<Dim> from_lane(KernelData<Dim> data, int lane)
{
    for (double** array : { &data.displacement, &data.velocity, &data.force, &data.surface })
        *array += lane;
    data.parameters += lane;
    data.inverse_inertia += lane;
    if (data.memory) data.memory += lane;
    return data;
}

/// One kernel for one lane and for eight, in all its versions.
template <class Kernel, class... Arguments> struct Versions {
    using Function = void (*)(Arguments...);

    __attribute__((target("arch=x86-64-v4"))) static void eight_avx512(Arguments... arguments)
    {
        Kernel::template run<Lanes<8>::Value, 8>(arguments...);
    }
    __attribute__((target("arch=x86-64-v3"))) static void eight_avx2(Arguments... arguments)
    {
        for (int lane = 0; lane < 8; lane += 4)
            Kernel::template run<Lanes<4>::Value, 8>(from_lane(arguments, lane)...);
    }
    static void eight_plain(Arguments... arguments)
    {
        for (int lane = 0; lane < 8; lane += 2)
            Kernel::template run<Lanes<2>::Value, 8>(from_lane(arguments, lane)...);
    }
    __attribute__((target("arch=x86-64-v3"))) static void one_avx2(Arguments... arguments)
    {
        Kernel::template run<double, 1>(arguments...);
    }
    static void one_plain(Arguments... arguments) { Kernel::template run<double, 1>(arguments...); }
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

} // namespace softgrain
