// SPDX-License-Identifier: GPL-2.0-or-later
// Grains that share a discretisation are advanced eight at a time, one grain a lane; a grain alone uses
// one lane. Kernels are templates over the value type T: Lanes8 or double.
#pragma once

#include <cmath>
#include <cstdint>

/// Kernels are inlined into one function for every instruction set, to be compiled for it.
#define SOFTGRAIN_INLINE inline __attribute__((always_inline))

namespace softgrain {

/// Values of 2, 4 or 8 grains: the native vectors of SSE2, AVX2 and AVX-512. (Wider vectors than native ones are
/// taken to pieces by the compiler, number by number.)
template <int Count> struct Lanes {
    typedef double Value __attribute__((vector_size(8 * Count), aligned(8 * Count)));
    typedef std::int64_t Bits __attribute__((vector_size(8 * Count), aligned(8 * Count)));
};
template <> struct Lanes<1> {
    typedef double Value;
};

template <class T> constexpr int lane_count = int(sizeof(T) / sizeof(double));

template <class T> SOFTGRAIN_INLINE T broadcast(double value) { return T {} + value; }
template <class T> SOFTGRAIN_INLINE T smaller(const T& a, const T& b) { return a < b ? a : b; }
template <class T> SOFTGRAIN_INLINE T larger(const T& a, const T& b) { return a > b ? a : b; }

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

template <class T> SOFTGRAIN_INLINE T square_root(const T& x)
{
    if constexpr (lane_count<T> == 1)
        return std::sqrt(x);
    else {
        T root;
        for (int l = 0; l < lane_count<T>; ++l)
            root[l] = __builtin_sqrt(x[l]);
        return root;
    }
}

/// Natural logarithm of positive normal numbers, good to 2 units in the last place; anything else gives a
/// number without meaning, so callers test their argument.
///
/// x = m 2^e with m in [sqrt(1/2), sqrt(2)); ln m = 2 atanh(s), s = (m - 1) / (m + 1), by its series in s^2.
template <class T> SOFTGRAIN_INLINE T logarithm(const T& x)
{
    using Bits = typename Lanes<lane_count<T>>::Bits;
    const Bits bits = (Bits)x;
    const Bits exponent = ((bits - 0x3fe6a09e667f3bcdLL) >> 52);
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
    // ln 2 in two parts, the first with zeros at its end, so that its product with e is exact
    return e * 0.693147180369123816490 + (2.0 * s + (2.0 * s * z * p + e * 1.90821492927058770002e-10));
}

template <> SOFTGRAIN_INLINE double logarithm(const double& x) { return std::log(x); }

/// Exponential of numbers between -700 and 700, good to 2 units in the last place.
///
/// exp x = 2^n exp r, n the integer nearest to x / ln 2, so that |r| <= ln 2 / 2, by its series.
template <class T> SOFTGRAIN_INLINE T exponential(const T& x)
{
    using Bits = typename Lanes<lane_count<T>>::Bits;
    const T shifted = x * 1.44269504088896340736 + 6755399441055744.0; // holds n in its last bits
    const T n = shifted - 6755399441055744.0;
    const T r = (x - n * 0.693147180369123816490) - n * 1.90821492927058770002e-10;
    T p = T {} + 1.0 / 6227020800;
    p = p * r + 1.0 / 479001600;
    p = p * r + 1.0 / 39916800;
    p = p * r + 1.0 / 3628800;
    p = p * r + 1.0 / 362880;
    p = p * r + 1.0 / 40320;
    p = p * r + 1.0 / 5040;
    p = p * r + 1.0 / 720;
    p = p * r + 1.0 / 120;
    p = p * r + 1.0 / 24;
    p = p * r + 1.0 / 6;
    p = p * r + 0.5;
    p = p * r + 1.0;
    p = p * r + 1.0;
    return p * (T)(((Bits)shifted + 1023) << 52);
}

template <> SOFTGRAIN_INLINE double exponential(const double& x) { return std::exp(x); }

} // namespace softgrain
