// SPDX-License-Identifier: GPL-2.0-or-later
// Grains that share a discretisation are advanced eight at a time, one grain a lane; a grain alone uses
// one lane. Kernels are templates over the value type T: Lanes8 or double.
#pragma once

#include <cmath>
#include <cstdint>

/// Compiles a function once for every instruction set below and picks one when the program starts.
#define SOFTGRAIN_MULTIVERSION __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
/// What a multiversioned function calls has to be inlined into it to be compiled for its instruction set.
#define SOFTGRAIN_INLINE inline __attribute__((always_inline))

namespace softgrain {

typedef double Lanes8 __attribute__((vector_size(64), aligned(64)));
typedef std::int64_t Integers8 __attribute__((vector_size(64), aligned(64)));

template <class T> constexpr int lane_count = int(sizeof(T) / sizeof(double));

SOFTGRAIN_INLINE double& lane(double& value, int) { return value; }
SOFTGRAIN_INLINE double lane(const double& value, int) { return value; }
SOFTGRAIN_INLINE double lane(const Lanes8& value, int index) { return value[index]; }

template <class T> SOFTGRAIN_INLINE T broadcast(double value) { return T {} + value; }

SOFTGRAIN_INLINE double smaller(double a, double b) { return a < b ? a : b; }
SOFTGRAIN_INLINE double larger(double a, double b) { return a > b ? a : b; }
SOFTGRAIN_INLINE Lanes8 smaller(const Lanes8& a, const Lanes8& b) { return a < b ? a : b; }
SOFTGRAIN_INLINE Lanes8 larger(const Lanes8& a, const Lanes8& b) { return a > b ? a : b; }

/// 1 / x of several values with one division, which costs as much as a dozen multiplications.
template <int Count, class T> SOFTGRAIN_INLINE void reciprocals(const T* x, T* result)
{
    T product[Count];
    product[0] = x[0];
#pragma GCC unroll 16
    for (int i = 1; i < Count; ++i)
        product[i] = product[i - 1] * x[i];
    T rest = 1.0 / product[Count - 1];
#pragma GCC unroll 16
    for (int i = Count - 1; i > 0; --i) {
        result[i] = rest * product[i - 1];
        rest *= x[i];
    }
    result[0] = rest;
}

SOFTGRAIN_INLINE double square_root(double x) { return std::sqrt(x); }
SOFTGRAIN_INLINE Lanes8 square_root(const Lanes8& x)
{
    Lanes8 root;
    for (int l = 0; l < 8; ++l)
        root[l] = __builtin_sqrt(x[l]);
    return root;
}

/// Natural logarithm of positive normal numbers, good to 2 units in the last place; anything else gives a
/// number without meaning, so callers test their argument (see StepMonitor).
///
/// x = m 2^e with m in [sqrt(1/2), sqrt(2)); ln m = 2 atanh(s), s = (m - 1) / (m + 1), by its series in s^2.
template <class T, class I> SOFTGRAIN_INLINE T logarithm_of_positive(const T& x)
{
    const I bits = (I)x;
    const I exponent = ((bits - 0x3fe6a09e667f3bcdLL) >> 52);
    const T m = (T)(bits - (exponent << 52));
    // integers below 2^51 become doubles through the mantissa of 1.5 * 2^52
    const T e = (T)(exponent + 0x4338000000000000LL) - 6755399441055744.0;
    const T s = (m - 1.0) / (m + 1.0), z = s * s;
    T p = T {} + 1.0 / 21;
    p = p * z + 1.0 / 19;
    p = p * z + 1.0 / 17;
    p = p * z + 1.0 / 15;
    p = p * z + 1.0 / 13;
    p = p * z + 1.0 / 11;
    p = p * z + 1.0 / 9;
    p = p * z + 1.0 / 7;
    p = p * z + 1.0 / 5;
    p = p * z + 1.0 / 3;
    return e * 0.69314718055994530942 + 2.0 * (s + s * z * p);
}

SOFTGRAIN_INLINE Lanes8 logarithm(const Lanes8& x) { return logarithm_of_positive<Lanes8, Integers8>(x); }
SOFTGRAIN_INLINE double logarithm(double x) { return std::log(x); }

} // namespace softgrain
