// SPDX-License-Identifier: GPL-2.0-or-later
// Second-order tensors over lanes, and the few operations that finite elasticity needs.
#pragma once

#include "base/lanes.hpp"

namespace softgrain {

template <int Dim, class T> struct Tensor {
    T at[Dim][Dim];
};

template <class T> SOFTGRAIN_INLINE T determinant(const Tensor<2, T>& F)
{
    return F.at[0][0] * F.at[1][1] - F.at[0][1] * F.at[1][0];
}

template <class T> SOFTGRAIN_INLINE T determinant(const Tensor<3, T>& F)
{
    return F.at[0][0] * (F.at[1][1] * F.at[2][2] - F.at[1][2] * F.at[2][1])
        - F.at[0][1] * (F.at[1][0] * F.at[2][2] - F.at[1][2] * F.at[2][0])
        + F.at[0][2] * (F.at[1][0] * F.at[2][1] - F.at[1][1] * F.at[2][0]);
}

/// Cofactor, the derivative of the determinant: J F^-T.
template <class T> SOFTGRAIN_INLINE Tensor<2, T> cofactor(const Tensor<2, T>& F)
{
    return { { { F.at[1][1], -F.at[1][0] }, { -F.at[0][1], F.at[0][0] } } };
}

template <class T> SOFTGRAIN_INLINE Tensor<3, T> cofactor(const Tensor<3, T>& F)
{
    Tensor<3, T> C;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            C.at[i][j] = F.at[a][c] * F.at[b][d] - F.at[a][d] * F.at[b][c];
        }
    return C;
}

/// C = F^T F.
template <int Dim, class T> SOFTGRAIN_INLINE Tensor<Dim, T> right_cauchy_green(const Tensor<Dim, T>& F)
{
    Tensor<Dim, T> C;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j) {
            C.at[i][j] = F.at[0][i] * F.at[0][j];
            for (int k = 1; k < Dim; ++k)
                C.at[i][j] += F.at[k][i] * F.at[k][j];
        }
    return C;
}

/// tr C of the three-dimensional C: plane strain adds C33 = 1.
template <int Dim, class T> SOFTGRAIN_INLINE T first_invariant(const Tensor<Dim, T>& F)
{
    T sum = broadcast<T>(3 - Dim);
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
            sum += F.at[i][j] * F.at[i][j];
    return sum;
}

/// A lower bound of the smallest principal stretch of F, J / (the product of the others); exact in 2D.
template <class T> SOFTGRAIN_INLINE T smallest_stretch(const Tensor<2, T>& F)
{
    const T J = determinant(F), trace = first_invariant(F) - 1.0; // tr C in the plane
    return J / square_root(0.5 * (trace + square_root(larger(trace * trace - 4.0 * J * J, T {}))));
}

template <class T> SOFTGRAIN_INLINE T smallest_stretch(const Tensor<3, T>& F)
{
    return determinant(F) / square_root(first_invariant(cofactor(F)));
}

} // namespace softgrain
