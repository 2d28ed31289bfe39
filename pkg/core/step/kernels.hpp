// SPDX-License-Identifier: GPL-2.0-or-later
// The inner loops over the points and nodes of a batch. A kernel is a struct with a static run<T, L>: T holds as
// many grains as the instruction set has lanes, L is how many the arrays hold side by side.
#pragma once

#include "base/tensor.hpp"
#include "step/batch.hpp"
#include "step/point_tangent.hpp"

namespace softgrain::kernels {

/// An array of lanes seen through T, item by item.
template <class T, int L> class Field {
public:
    explicit SOFTGRAIN_INLINE Field(double* array)
        : array_(array)
    {
    }
    SOFTGRAIN_INLINE T& operator[](long item) const { return *reinterpret_cast<T*>(array_ + item * L); }

private:
    double* array_;
};

template <class T, int L> SOFTGRAIN_INLINE Field<T, L> field(double* array) { return Field<T, L>(array); }
template <class T, int L> SOFTGRAIN_INLINE const T& item(const double* array, long index)
{
    return *reinterpret_cast<const T*>(array + index * L);
}

/// F += sum over the stencil of u grad N, at `Points` neighbours among the `count` points of a block.
template <int Dim, int Points, class T, class U, class Nodes>
SOFTGRAIN_INLINE void add_gradients(const Nodes& node, const double* gradient, int count, const U& u, Tensor<Dim, T>* F)
{
    for (int k = 0; k < power(3, Dim); ++k) {
        const double* slope = gradient + k * Dim * count;
#pragma GCC unroll 8
        for (int p = 0; p < Points; ++p)
#pragma GCC unroll 3
            for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
                for (int j = 0; j < Dim; ++j)
                    F[p].at[i][j] += slope[p * Dim + j] * u[Dim * node[k] + i];
    }
}

/// f += sum over the points of Q grad N, the transpose of add_gradients.
template <int Dim, int Points, class T, class U, class Nodes>
SOFTGRAIN_INLINE void add_forces(const Nodes& node, const double* gradient, int count, const Tensor<Dim, T>* Q, const U& f)
{
    for (int k = 0; k < power(3, Dim); ++k) {
        const double* slope = gradient + k * Dim * count;
#pragma GCC unroll 3
        for (int i = 0; i < Dim; ++i) {
            T sum = f[Dim * node[k] + i];
#pragma GCC unroll 8
            for (int p = 0; p < Points; ++p)
#pragma GCC unroll 3
                for (int j = 0; j < Dim; ++j)
                    sum += slope[p * Dim + j] * Q[p].at[i][j];
            f[Dim * node[k] + i] = sum;
        }
    }
}

/// The same two in a full cell of the plane by sum factorisation (Orszag 1980): one axis after the other, and on
/// an axis the even and odd parts of the three nodal values apart, since the Gauss points stand at -+a. Half the
/// multiplications of the general form.
struct FullCell {
    static constexpr double a = 0.28867513459481288, p = 1.0 / 6, q = a / 2; // a = 1 / sqrt(12) cell widths
    double half, slope;                                                      ///< 1/2 and a over the cell width

    explicit SOFTGRAIN_INLINE FullCell(double width)
        : half(0.5 / width)
        , slope(a / width)
    {
    }
    template <class T> SOFTGRAIN_INLINE void values(const T& f0, const T& f1, const T& f2, T* at) const
    {
        const T odd = f2 - f0, even = f0 + f2 - 2.0 * f1, middle = f1 + p * even;
        at[0] = middle - q * odd;
        at[1] = middle + q * odd;
    }
    template <class T> SOFTGRAIN_INLINE void slopes(const T& f0, const T& f1, const T& f2, T* at) const
    {
        const T odd = half * (f2 - f0), even = f0 + f2 - 2.0 * f1;
        at[0] = odd - slope * even;
        at[1] = odd + slope * even;
    }
    template <class T, class U, class Nodes>
    SOFTGRAIN_INLINE void add_gradients(const Nodes& node, const U& u, Tensor<2, T>* F) const
    {
#pragma GCC unroll 2
        for (int c = 0; c < 2; ++c) {
            T value[3][2], along[3][2], result[2];
#pragma GCC unroll 3
            for (int j = 0; j < 3; ++j) {
                const T &f0 = u[2 * node[3 * j] + c], &f1 = u[2 * node[3 * j + 1] + c], &f2 = u[2 * node[3 * j + 2] + c];
                values(f0, f1, f2, value[j]);
                slopes(f0, f1, f2, along[j]);
            }
#pragma GCC unroll 2
            for (int x = 0; x < 2; ++x) {
                values(along[0][x], along[1][x], along[2][x], result);
                F[x].at[c][0] += result[0];
                F[x + 2].at[c][0] += result[1];
                slopes(value[0][x], value[1][x], value[2][x], result);
                F[x].at[c][1] += result[0];
                F[x + 2].at[c][1] += result[1];
            }
        }
    }
    template <class T, class U, class Nodes>
    SOFTGRAIN_INLINE void add_forces(const Nodes& node, const Tensor<2, T>* Q, const U& f) const
    {
#pragma GCC unroll 2
        for (int c = 0; c < 2; ++c) {
            T value[3][2], along[3][2]; // what goes to the rows as value and as slope along x
#pragma GCC unroll 2
            for (int x = 0; x < 2; ++x) {
                const T sum = Q[x].at[c][0] + Q[x + 2].at[c][0], change = q * (Q[x + 2].at[c][0] - Q[x].at[c][0]);
                along[0][x] = p * sum - change;
                along[1][x] = (1 - 2 * p) * sum;
                along[2][x] = p * sum + change;
                const T odd = half * (Q[x].at[c][1] + Q[x + 2].at[c][1]), even = slope * (Q[x + 2].at[c][1] - Q[x].at[c][1]);
                value[0][x] = even - odd;
                value[1][x] = -2.0 * even;
                value[2][x] = even + odd;
            }
#pragma GCC unroll 3
            for (int j = 0; j < 3; ++j) {
                const T bend = slope * (along[j][1] - along[j][0]), sum = value[j][0] + value[j][1];
                const T common = bend + p * sum,
                        change = half * (along[j][0] + along[j][1]) + q * (value[j][1] - value[j][0]);
                f[2 * node[3 * j] + c] += common - change;
                f[2 * node[3 * j + 1] + c] += (1 - 2 * p) * sum - 2.0 * bend;
                f[2 * node[3 * j + 2] + c] += common + change;
            }
        }
    }
};

/// Deformation gradients at the 2^Dim points of a region.
template <int Dim, int L, class T>
SOFTGRAIN_INLINE void deform(const KernelData<Dim>& data, const typename Discretisation<Dim>::Region& region,
                             Tensor<Dim, T>* F)
{
    constexpr int points = power(2, Dim);
    const auto u = field<T, L>(data.displacement);
#pragma GCC unroll 8
    for (int p = 0; p < points; ++p)
#pragma GCC unroll 3
        for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
            for (int j = 0; j < Dim; ++j)
                F[p].at[i][j] = broadcast<T>(i == j ? 1 : 0);
    const auto* block = data.blocks + region.first_block;
    if constexpr (Dim == 2)
        if (region.full) return FullCell(data.cell_width).add_gradients(block->node, u, F);
    if (region.block_count == 1)
        return add_gradients<Dim, points>(block->node, data.gradient + block->gradient, points, u, F);
    for (int b = 0, p = 0; b < region.block_count; ++b, ++block)
        for (int k = 0; k < block->point_count; ++k, ++p)
            add_gradients<Dim, 1>(block->node, data.gradient + block->gradient + k * Dim, block->point_count, u, F + p);
}

/// Q grad N of the points of a region on their nodes.
template <int Dim, int L, class T>
SOFTGRAIN_INLINE void load(const KernelData<Dim>& data, const typename Discretisation<Dim>::Region& region,
                           const Tensor<Dim, T>* Q)
{
    constexpr int points = power(2, Dim);
    const auto f = field<T, L>(data.force);
    const auto* block = data.blocks + region.first_block;
    if constexpr (Dim == 2)
        if (region.full) return FullCell(data.cell_width).add_forces(block->node, Q, f);
    if (region.block_count == 1) return add_forces<Dim, points>(block->node, data.gradient + block->gradient, points, Q, f);
    for (int b = 0, p = 0; b < region.block_count; ++b, ++block)
        for (int k = 0; k < block->point_count; ++k, ++p)
            add_forces<Dim, 1>(block->node, data.gradient + block->gradient + k * Dim, block->point_count, Q + p, f);
}

template <int Dim, class T, int L> SOFTGRAIN_INLINE void clear(const KernelData<Dim>& data, double* array)
{
    const auto f = field<T, L>(array);
    for (int i = 0; i < Dim * data.node_count; ++i)
        f[i] = T {};
}

/// Slaves hand what they hold to their masters.
template <int Dim, class T, int L> SOFTGRAIN_INLINE void fold(const KernelData<Dim>& data, double* array)
{
    const auto f = field<T, L>(array);
    for (int s = 0; s < data.node_count - data.master_count; ++s) {
        T held[Dim];
        for (int d = 0; d < Dim; ++d)
            held[d] = f[Dim * (data.master_count + s) + d];
        for (int k = data.slave_row[s]; k < data.slave_row[s + 1]; ++k)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                f[Dim * data.links[k].master + d] += data.links[k].weight * held[d];
    }
}

/// Slaves take the extrapolation of their masters. A slave at X carries X + u, so that u is extrapolated as it is:
/// the extrapolation reproduces linear fields, X among them.
template <int Dim, class T, int L> SOFTGRAIN_INLINE void extend(const KernelData<Dim>& data, double* array)
{
    const auto f = field<T, L>(array);
    for (int s = 0; s < data.node_count - data.master_count; ++s) {
        T sum[Dim] {};
        for (int k = data.slave_row[s]; k < data.slave_row[s + 1]; ++k)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                sum[d] += data.links[k].weight * f[Dim * data.links[k].master + d];
        for (int d = 0; d < Dim; ++d)
            f[Dim * (data.master_count + s) + d] = sum[d];
    }
}

template <int Dim, class T, int L> SOFTGRAIN_INLINE void interpolate(const KernelData<Dim>& data, double* array)
{
    const auto f = field<T, L>(array), s = field<T, L>(data.surface);
    constexpr int last = power(3, Dim) - 1;
    for (int p = 0; p < data.surface_count; ++p) {
        const auto& entry = data.surface_stencil[p];
        T even[Dim] {}, odd[Dim] {}; // two sums, so that one need not wait for the other
        for (int k = 0; k < last; k += 2)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d) {
                even[d] += entry.weight[k] * f[Dim * entry.node[k] + d];
                odd[d] += entry.weight[k + 1] * f[Dim * entry.node[k + 1] + d];
            }
        for (int d = 0; d < Dim; ++d)
            s[Dim * p + d] = even[d] + odd[d] + entry.weight[last] * f[Dim * entry.node[last] + d];
    }
}

/// What the points of a region remember, [point][number][lane].
template <int Dim, class Law, int L> SOFTGRAIN_INLINE double* memory_of(const KernelData<Dim>& data, int region)
{
    return data.memory + long(region) * power(2, Dim) * long(Law::memory.size()) * L;
}

/// Puts what a point of a region remembers behind the constants; laws without memory have nothing to put.
template <class Law, int L, class T> SOFTGRAIN_INLINE void recall(const double* memory, int point, T* p)
{
    for (size_t k = 0; k < Law::memory.size(); ++k)
        p[Law::parameters.size() + k] = item<T, L>(memory, long(point * Law::memory.size() + k));
}

/// Points of a cut cell lie where the nodes are held by little mass; a share of the volumetric stiffness keeps their J near
/// the mean of the region [Pa]. It is a stiffness against pointwise volume change, so it may not grow with the volumetric
/// one: over some 50 shear moduli (a Poisson ratio of 0.49) it would lock the rim. Full cells need none. With the whole
/// share there is no mean dilatation: U(mean J) + U''(1) / 2 (J_p - mean J)^2 has the mean of U(J_p), but for third powers.
template <class Law, class T> SOFTGRAIN_INLINE T stabilisation(double share, const T* p)
{
    const T stiffness = Law::volumetric_modulus(p);
    return share < 1 ? share * smaller(stiffness, 50.0 * Law::shear_modulus(p)) : stiffness;
}

/// Stresses of the points of a region in place of their deformation gradients, times `scale`:
///     scale [dw/dF + (U'(mean J) + k (J_p - mean J)) cof F_p],    k the stabilisation.
/// `smallest` falls to the smallest J.
template <int Dim, class Law, int L, class T>
SOFTGRAIN_INLINE void region_stress(T* p, const double* memory, double share, double scale, Tensor<Dim, T>* F, T& smallest)
{
    constexpr int points = power(2, Dim);
    T J[points + 1], inverse_J[points + 1], sum {}; // the last: mean J of the region
#pragma GCC unroll 8
    for (int q = 0; q < points; ++q) {
        J[q] = determinant(F[q]);
        sum += J[q];
        smallest = smaller(J[q], smallest);
    }
    J[points] = sum * (1.0 / points);
    reciprocals<points + 1>(J, inverse_J);
    const T slope = Law::volumetric_slope(p, J[points], inverse_J[points]);
    const T stiff = stabilisation<Law>(share, p);
#pragma GCC unroll 8
    for (int q = 0; q < points; ++q) {
        const Tensor<Dim, T> cof = cofactor(F[q]);
        Tensor<Dim, T> P;
        recall<Law, L>(memory, q, p);
        Law::template stress<Dim, T>(p, F[q], cof, inverse_J[q], P);
#pragma GCC unroll 3
        for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
            for (int j = 0; j < Dim; ++j)
                F[q].at[i][j] = scale * (P.at[i][j] + (slope + stiff * (J[q] - J[points])) * cof.at[i][j]);
    }
}

/// Adds the elastic energy of a region to `sum`; `smallest` falls to the smallest bounding_stretch.
template <int Dim, class Law, int L, class T>
SOFTGRAIN_INLINE void region_energy(T* p, const double* memory, double share, double volume, const Tensor<Dim, T>* F, T& sum,
                                    T& smallest)
{
    constexpr int points = power(2, Dim);
    T J[points], mean {}, spread {};
    for (int q = 0; q < points; ++q) {
        J[q] = determinant(F[q]);
        mean += J[q];
        recall<Law, L>(memory, q, p);
        smallest = smaller(bounding_stretch<Law>(p, F[q]), smallest);
        sum += volume / points * Law::template energy<Dim, T>(p, F[q]);
    }
    mean *= 1.0 / points;
    for (int q = 0; q < points; ++q)
        spread += (J[q] - mean) * (J[q] - mean) * (1.0 / points);
    sum += volume * (Law::volumetric_energy(p, mean) + 0.5 * stabilisation<Law>(share, p) * spread);
}

/// f_i = - sum_p V_p P_p grad N_i (Vu et al. 2017, eq. 6, in the reference configuration) with the mean dilatation
/// of each region in the volumetric part: the gradient of
///     sum over regions of V U(mean J) + sum over points of V_p [ w(F_p) + k / 2 (J_p - mean J)^2 ],
/// k the stabilisation.
template <int Dim, class Law> struct InternalForce {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* min_J)
    {
        constexpr int points = power(2, Dim);
        T p[Law::parameters.size() + Law::memory.size()], smallest = broadcast<T>(1e300);
        for (size_t k = 0; k < Law::parameters.size(); ++k)
            p[k] = item<T, L>(data.parameters, k);
        clear<Dim, T, L>(data, data.force);
        for (int r = 0; r < data.region_count; ++r) {
            const auto& region = data.regions[r];
            Tensor<Dim, T> F[points];
            deform<Dim, L>(data, region, F);
            region_stress<Dim, Law, L>(p, memory_of<Dim, Law, L>(data, r), region.pointwise, -region.volume / points, F,
                                       smallest);
            load<Dim, L>(data, region, F);
        }
        fold<Dim, T, L>(data, data.force);
        field<T, L>(min_J)[0] = smallest;
    }
};

template <int Dim, class Law> struct Energy {
    template <class T, int L>
    static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* energy, double* min_stretch)
    {
        T p[Law::parameters.size() + Law::memory.size()], sum {}, smallest = broadcast<T>(1e300);
        for (size_t k = 0; k < Law::parameters.size(); ++k)
            p[k] = item<T, L>(data.parameters, k);
        for (int r = 0; r < data.region_count; ++r) {
            const auto& region = data.regions[r];
            Tensor<Dim, T> F[power(2, Dim)];
            deform<Dim, L>(data, region, F);
            region_energy<Dim, Law, L>(p, memory_of<Dim, Law, L>(data, r), region.pointwise, region.volume, F, sum,
                                       smallest);
        }
        field<T, L>(energy)[0] = sum;
        field<T, L>(min_stretch)[0] = smallest;
    }
};

/// Velocities at the surface, and the largest.
template <int Dim, class T, int L> SOFTGRAIN_INLINE void surface_velocity(const KernelData<Dim>& data, double* extent)
{
    extend<Dim, T, L>(data, data.velocity);
    interpolate<Dim, T, L>(data, data.velocity);
    const auto s = field<T, L>(data.surface);
    T fastest {};
    for (int p = 0; p < data.surface_count; ++p) {
        T square {};
#pragma GCC unroll 3
        for (int d = 0; d < Dim; ++d)
            square += s[Dim * p + d] * s[Dim * p + d];
        fastest = larger(square, fastest);
    }
    field<T, L>(extent)[SurfaceExtent<Dim>::speed2] = fastest;
}

template <int Dim> struct Velocities {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* extent)
    {
        surface_velocity<Dim, T, L>(data, extent);
    }
};

template <int Dim> struct Kick {
    template <class T, int L>
    static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double dt, double* gain, double* extent)
    {
        const auto v = field<T, L>(data.velocity), f = field<T, L>(data.force), g = field<T, L>(gain);
        const T scale = dt * item<T, L>(data.inverse_inertia, 0);
        for (int i = 0; i < data.master_count; ++i) {
            const T k = scale * data.inverse_mass[i];
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                v[Dim * i + d] += k * f[Dim * i + d] + g[d];
        }
        surface_velocity<Dim, T, L>(data, extent);
    }
};

template <int Dim> struct Push {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* extent)
    {
        clear<Dim, T, L>(data, data.force);
        const auto f = field<T, L>(data.force), s = field<T, L>(data.surface), v = field<T, L>(data.velocity);
        for (int p = 0; p < data.surface_count; ++p) {
            const auto& entry = data.surface_stencil[p];
            for (int k = 0; k < power(3, Dim); ++k)
#pragma GCC unroll 3
                for (int d = 0; d < Dim; ++d)
                    f[Dim * entry.node[k] + d] += entry.weight[k] * s[Dim * p + d];
        }
        fold<Dim, T, L>(data, data.force);
        for (int i = 0; i < data.master_count; ++i)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                v[Dim * i + d] += data.inverse_mass[i] * f[Dim * i + d];
        surface_velocity<Dim, T, L>(data, extent);
    }
};

template <int Dim> struct Drift {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double dt)
    {
        const auto u = field<T, L>(data.displacement), v = field<T, L>(data.velocity);
        for (int i = 0; i < Dim * data.master_count; ++i)
            u[i] += dt * v[i];
    }
};

template <int Dim> struct Extend {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data)
    {
        extend<Dim, T, L>(data, data.displacement);
    }
};

template <int Dim> struct Observe {
    template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* sums, double* extent)
    {
        using Sums = MotionSums<Dim>;
        T total[Sums::count] {};
        const auto u = field<T, L>(data.displacement), v = field<T, L>(data.velocity), s = field<T, L>(data.surface);
        for (int i = 0; i < data.master_count; ++i) {
            const double m = data.node_mass[i];
            T x[Dim], mv[Dim];
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d) {
                x[d] = data.node_position[i][d] + u[Dim * i + d];
                mv[d] = m * v[Dim * i + d];
                total[Sums::position + d] += m * x[d];
                total[Sums::velocity + d] += mv[d];
                total[Sums::kinetic] += mv[d] * v[Dim * i + d];
            }
            for (int a = 0, k = 0; a < Dim; ++a)
                for (int b = a + 1; b < Dim; ++b, ++k)
                    total[Sums::spin + k] += x[a] * mv[b] - x[b] * mv[a];
            for (int a = 0; a < Dim; ++a)
                for (int b = 0; b < Dim; ++b) {
                    total[Sums::second + Dim * a + b] += m * x[a] * x[b];
                    total[Sums::gradient + Dim * a + b] += data.mean_gradient[Dim * i + b] * u[Dim * i + a];
                }
        }
        const auto out = field<T, L>(sums);
        for (int k = 0; k < Sums::count; ++k)
            out[k] = total[k];

        extend<Dim, T, L>(data, data.displacement);
        interpolate<Dim, T, L>(data, data.displacement);
        T low[Dim], high[Dim];
        for (int d = 0; d < Dim; ++d) {
            low[d] = broadcast<T>(1e300);
            high[d] = broadcast<T>(-1e300);
        }
        for (int p = 0; p < data.surface_count; ++p)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d) {
                const T x = s[Dim * p + d] + data.surface_point[p].position[d];
                s[Dim * p + d] = x;
                low[d] = smaller(x, low[d]);
                high[d] = larger(x, high[d]);
            }
        const auto box = field<T, L>(extent);
        for (int d = 0; d < Dim; ++d) {
            box[SurfaceExtent<Dim>::low + d] = low[d];
            box[SurfaceExtent<Dim>::high + d] = high[d];
        }
    }
};

} // namespace softgrain::kernels
