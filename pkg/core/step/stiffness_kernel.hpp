// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness of the grains of a batch, its Cholesky factor, and solutions with it. Matrices are [block][row][column][lane],
// vectors [row of the pattern][Dim][lane].
#pragma once

#include "step/kernels.hpp"
#include "step/point_tangent.hpp"
#include "step/stiffness_pattern.hpp"

namespace softgrain::kernels {

/// The second derivative of the energy of InternalForce, made positive semi-definite, plus `inertia` [lane] times the node
/// masses. A point's share is that of point_tangent.hpp with U'(mean J) + k (J - mean J) as the factor of d2J/dF2. The mean J
/// adds (U'' - k) times its own gradient squared for each region.
template <int Dim, class Law> struct Stiffness {
    static_assert(Dim == 2, "the spectrum of d2J/dF2 is that of the plane");
    template <class T, int L>
    static SOFTGRAIN_INLINE void run(const StiffnessPattern<Dim>* pattern, double* parameters, double* displacement,
                                     double* inertia, double* matrix)
    {
        constexpr int points = power(2, Dim);
        constexpr int most = StiffnessPattern<Dim>::row_limit;
        T p[Law::parameters.size()];
        for (size_t k = 0; k < Law::parameters.size(); ++k)
            p[k] = item<T, L>(parameters, k);
        const auto K = field<T, L>(matrix);
        for (long i = 0; i < long(pattern->start[pattern->rows]) * Dim * Dim; ++i)
            K[i] = T {};
        for (const auto& region : pattern->regions) {
            const int* row = &pattern->region_row[region.row];
            Tensor<Dim, T> F[points];
            pattern->deform(region, field<T, L>(displacement), F);
            T J[points + 1], inverse_J[points + 1], sum {};
            for (int q = 0; q < points; ++q)
                sum += J[q] = determinant(F[q]);
            J[points] = sum * (1.0 / points);
            reciprocals<points + 1>(J, inverse_J);
            const T slope = Law::volumetric_slope(p, J[points], inverse_J[points]);
            const T curvature = larger(Law::volumetric_curvature(p, J[points], inverse_J[points]), T {});
            const T stiff = stabilisation<Law>(region.pointwise, p);
            const double volume = region.volume / points;
            using Point = decltype(point_tangent<Law>(p, F[0], J[0], inverse_J[0], slope, stiff, sum));
            Point point[points];
            T h[points][Point::ranks][most][Dim], mean[most][Dim]; // directions and cof F times the gradients
            for (int a = 0; a < region.rows; ++a)
                mean[a][0] = mean[a][1] = T {};
            for (int q = 0; q < points; ++q) {
                point[q] = point_tangent<Law>(p, F[q], J[q], inverse_J[q], slope, stiff, J[q] - J[points]);
                point[q].scale(volume);
                const Tensor<Dim, T> cof = cofactor(F[q]);
                const double* gradient = &pattern->region_gradient[region.gradient + size_t(q) * region.rows * Dim];
                for (int a = 0; a < region.rows; ++a)
                    for (int i = 0; i < Dim; ++i) {
                        const auto along = [&](const Tensor<Dim, T>& A) {
                            return A.at[i][0] * gradient[2 * a] + A.at[i][1] * gradient[2 * a + 1];
                        };
                        for (int r = 0; r < Point::ranks; ++r)
                            h[q][r][a][i] = along(point[q].direction[r]);
                        mean[a][i] += (1.0 / points) * along(cof);
                    }
            }
            const T common = region.volume * (curvature - stiff);
            const double* gradient = &pattern->region_gradient[region.gradient];
            for (int a = 0; a < region.rows; ++a) {
                T weighted[points][Point::ranks][Dim];
                for (int i = 0; i < Dim; ++i)
                    for (int q = 0; q < points; ++q)
                        for (int r = 0; r < Point::ranks; ++r) {
                            T sum = point[q].outer[r][0] * h[q][0][a][i];
                            for (int s = 1; s < Point::ranks; ++s)
                                sum += point[q].outer[r][s] * h[q][s][a][i];
                            weighted[q][r][i] = sum;
                        }
                for (int b = 0; b <= a; ++b) {
                    T same {}, cross {};
                    T entry[Dim][Dim];
                    for (int i = 0; i < Dim; ++i)
                        for (int j = 0; j < Dim; ++j)
                            entry[i][j] = common * mean[a][i] * mean[b][j];
#pragma GCC unroll 4
                    for (int q = 0; q < points; ++q) {
                        const double *ga = gradient + (q * region.rows + a) * Dim,
                                     *gb = gradient + (q * region.rows + b) * Dim;
                        same += point[q].even * (ga[0] * gb[0] + ga[1] * gb[1]);
                        cross += point[q].odd * (ga[0] * gb[1] - ga[1] * gb[0]);
                        for (int r = 0; r < Point::ranks; ++r)
                            for (int i = 0; i < Dim; ++i)
                                for (int j = 0; j < Dim; ++j)
                                    entry[i][j] += weighted[q][r][i] * h[q][r][b][j];
                    }
                    const long block = long(pattern->block(row[a], row[b])) * Dim * Dim;
                    K[block] += entry[0][0] + same;
                    K[block + 1] += entry[0][1] + cross;
                    K[block + 2] += entry[1][0] - cross;
                    K[block + 3] += entry[1][1] + same;
                }
            }
        }
        const T per_mass = item<T, L>(inertia, 0);
        for (int r = 0; r < pattern->rows; ++r)
            for (int d = 0; d < Dim; ++d)
                K[long(pattern->block(r, r)) * Dim * Dim + d * (Dim + 1)] += pattern->mass[r] * per_mass;
    }
};

/// Two rows of a matrix of 2 x 2 blocks multiplied, A -= sum of B C^T.
template <class T, class Field> SOFTGRAIN_INLINE void subtract_product(T* A, const Field& M, long b, long c, int count)
{
    for (int k = 0; k < count; ++k, b += 4, c += 4) {
        A[0] -= M[b] * M[c] + M[b + 1] * M[c + 1];
        A[1] -= M[b] * M[c + 2] + M[b + 1] * M[c + 3];
        A[2] -= M[b + 2] * M[c] + M[b + 3] * M[c + 1];
        A[3] -= M[b + 2] * M[c + 2] + M[b + 3] * M[c + 3];
    }
}

/// K = L L^T in place (George and Liu 1981, envelope method). Of a diagonal block (a 0; b c) stand 1/a, b and 1/c.
struct Factorise {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const StiffnessPattern<2>* pattern, double* matrix)
    {
        const auto K = field<T, L>(matrix);
        for (int r = 0; r < pattern->rows; ++r) {
            for (int c = pattern->first[r]; c <= r; ++c) {
                const long here = 4L * pattern->block(r, c);
                const int from = std::max(pattern->first[r], pattern->first[c]);
                T A[4] = { K[here], K[here + 1], K[here + 2], K[here + 3] };
                subtract_product(A, K, 4L * pattern->block(r, from), 4L * pattern->block(c, from), c - from);
                if (c < r) {
                    const long diagonal = 4L * pattern->block(c, c);
                    const T &a = K[diagonal], &b = K[diagonal + 2], &d = K[diagonal + 3];
                    K[here] = A[0] * a;
                    K[here + 2] = A[2] * a;
                    K[here + 1] = (A[1] - K[here] * b) * d;
                    K[here + 3] = (A[3] - K[here + 2] * b) * d;
                } else {
                    const T a = 1.0 / square_root(A[0]), b = A[2] * a;
                    K[here] = a;
                    K[here + 1] = T {};
                    K[here + 2] = b;
                    K[here + 3] = 1.0 / square_root(A[3] - b * b);
                }
            }
        }
    }
};

/// x <- K^-1 x.
struct Solve {
    template <class T, int L>
    static SOFTGRAIN_INLINE void run(const StiffnessPattern<2>* pattern, double* matrix, double* vector)
    {
        const auto K = field<T, L>(matrix), x = field<T, L>(vector);
        for (int r = 0; r < pattern->rows; ++r) {
            T s0 = x[2 * r], s1 = x[2 * r + 1];
            long k = 4L * pattern->start[r];
            for (int c = pattern->first[r]; c < r; ++c, k += 4) {
                s0 -= K[k] * x[2 * c] + K[k + 1] * x[2 * c + 1];
                s1 -= K[k + 2] * x[2 * c] + K[k + 3] * x[2 * c + 1];
            }
            x[2 * r] = s0 * K[k];
            x[2 * r + 1] = (s1 - K[k + 2] * x[2 * r]) * K[k + 3];
        }
        for (int r = pattern->rows - 1; r >= 0; --r) {
            long k = 4L * pattern->block(r, r);
            const T x1 = x[2 * r + 1] * K[k + 3], x0 = (x[2 * r] - K[k + 2] * x1) * K[k];
            x[2 * r] = x0;
            x[2 * r + 1] = x1;
            k = 4L * pattern->start[r];
            for (int c = pattern->first[r]; c < r; ++c, k += 4) {
                x[2 * c] -= K[k] * x0 + K[k + 2] * x1;
                x[2 * c + 1] -= K[k + 1] * x0 + K[k + 3] * x1;
            }
        }
    }
};

/// Compliance of the surface, C = N K^-1 N^T, [point][point][Dim][Dim][lane], by X = L^-1 N^T and C = X^T X; `room` holds X,
/// [point][row][Dim][Dim][lane].
struct Compliance {
    template <class T, int L>
    static SOFTGRAIN_INLINE void run(const StiffnessPattern<2>* pattern, double* matrix, double* room, double* compliance)
    {
        const auto K = field<T, L>(matrix), X = field<T, L>(room), C = field<T, L>(compliance);
        const int n = pattern->rows, points = pattern->surface_count();
        for (int p = 0; p < points; ++p) {
            const long at = 4L * n * p;
            const auto* share = &pattern->surface[pattern->surface_start[p]];
            const int begin = share->row;
            for (int r = begin; r < n; ++r)
                X[at + 4 * r] = X[at + 4 * r + 1] = X[at + 4 * r + 2] = X[at + 4 * r + 3] = T {};
            for (int k = pattern->surface_start[p]; k < pattern->surface_start[p + 1]; ++k, ++share)
                X[at + 4 * share->row] = X[at + 4 * share->row + 3] = broadcast<T>(share->weight);
            for (int r = begin; r < n; ++r) {
                T* x = &X[at + 4 * r];
                constexpr int s = L / lane_count<T>; // distance of neighbouring items, in T
                T x00 = x[0], x01 = x[s], x10 = x[2 * s], x11 = x[3 * s];
                const int from = std::max(begin, pattern->first[r]);
                long k = 4L * pattern->block(r, from);
                for (int c = from; c < r; ++c, k += 4) {
                    const T* y = &X[at + 4 * c];
                    x00 -= K[k] * y[0] + K[k + 1] * y[2 * s];
                    x01 -= K[k] * y[s] + K[k + 1] * y[3 * s];
                    x10 -= K[k + 2] * y[0] + K[k + 3] * y[2 * s];
                    x11 -= K[k + 2] * y[s] + K[k + 3] * y[3 * s];
                }
                x[0] = x00 * K[k];
                x[s] = x01 * K[k];
                x[2 * s] = (x10 - K[k + 2] * x[0]) * K[k + 3];
                x[3 * s] = (x11 - K[k + 2] * x[s]) * K[k + 3];
            }
        }
        for (int p = 0; p < points; ++p)
            for (int q = 0; q <= p; ++q) {
                const int begin = std::max(pattern->surface[pattern->surface_start[p]].row,
                                           pattern->surface[pattern->surface_start[q]].row);
                T c00 {}, c01 {}, c10 {}, c11 {};
                long x = 4L * (long(n) * p + begin), y = 4L * (long(n) * q + begin);
                for (int r = begin; r < n; ++r, x += 4, y += 4) {
                    c00 += X[x] * X[y] + X[x + 2] * X[y + 2];
                    c01 += X[x] * X[y + 1] + X[x + 2] * X[y + 3];
                    c10 += X[x + 1] * X[y] + X[x + 3] * X[y + 2];
                    c11 += X[x + 1] * X[y + 1] + X[x + 3] * X[y + 3];
                }
                const long at = 4L * (long(points) * p + q), mirrored = 4L * (long(points) * q + p);
                C[at] = C[mirrored] = c00;
                C[at + 3] = C[mirrored + 3] = c11;
                C[at + 1] = C[mirrored + 2] = c01;
                C[at + 2] = C[mirrored + 1] = c10;
            }
    }
};

} // namespace softgrain::kernels
