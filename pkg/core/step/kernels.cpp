// SPDX-License-Identifier: GPL-2.0-or-later
// The inner loops: everything here is a template over the lanes and is compiled once an instruction set.
#include "material/mooney_rivlin.hpp"
#include "material/neo_hookean.hpp"
#include "step/batch.hpp"

namespace softgrain {
namespace {

    template <class T> SOFTGRAIN_INLINE T* lanes_of(double* array) { return reinterpret_cast<T*>(array); }
    template <class T> SOFTGRAIN_INLINE const T* lanes_of(const double* array) { return reinterpret_cast<const T*>(array); }

    /// F += sum over the stencil of u grad N, at `Points` points that share their nodes.
    template <int Dim, int Points, class T, class Nodes>
    SOFTGRAIN_INLINE void add_gradients(const Nodes& node, const double* gradient, const T* u, Tensor<Dim, T>* F)
    {
        constexpr int stencil = power(3, Dim);
#pragma GCC unroll 1
        for (int k = 0; k < stencil; ++k) {
            const T* uk = u + Dim * node[k];
#pragma GCC unroll 8
            for (int p = 0; p < Points; ++p)
#pragma GCC unroll 3
                for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
                    for (int j = 0; j < Dim; ++j)
                        F[p].at[i][j] += gradient[(p * stencil + k) * Dim + j] * uk[i];
        }
    }

    /// f += sum over the points of Q grad N, the transpose of add_gradients.
    template <int Dim, int Points, class T, class Nodes>
    SOFTGRAIN_INLINE void add_forces(const Nodes& node, const double* gradient, const Tensor<Dim, T>* Q, T* f)
    {
        constexpr int stencil = power(3, Dim);
#pragma GCC unroll 1
        for (int k = 0; k < stencil; ++k) {
            T* fk = f + Dim * node[k];
#pragma GCC unroll 3
            for (int i = 0; i < Dim; ++i) {
                T sum = fk[i];
#pragma GCC unroll 8
                for (int p = 0; p < Points; ++p)
#pragma GCC unroll 3
                    for (int j = 0; j < Dim; ++j)
                        sum += gradient[(p * stencil + k) * Dim + j] * Q[p].at[i][j];
                fk[i] = sum;
            }
        }
    }

    /// Deformation gradients at the 2^Dim points of a region.
    template <int Dim, class T>
    SOFTGRAIN_INLINE void deform(const KernelData<Dim>& data, const typename Discretisation<Dim>::Region& region, Tensor<Dim, T>* F)
    {
        constexpr int points = power(2, Dim), stencil = power(3, Dim);
        const T* u = lanes_of<T>(data.displacement);
#pragma GCC unroll 8
        for (int p = 0; p < points; ++p)
#pragma GCC unroll 3
            for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
                for (int j = 0; j < Dim; ++j)
                    F[p].at[i][j] = broadcast<T>(i == j ? 1 : 0);
        const auto* block = data.blocks + region.first_block;
        if (region.block_count == 1) {
            add_gradients<Dim, points>(block->node, data.gradient + size_t(block->first_point) * stencil * Dim, u, F);
            return;
        }
        for (int b = 0, p = 0; b < region.block_count; ++b, ++block)
            for (int q = 0; q < block->point_count; ++q, ++p)
                add_gradients<Dim, 1>(block->node, data.gradient + size_t(block->first_point + q) * stencil * Dim, u, F + p);
    }

    template <int Dim, class T> SOFTGRAIN_INLINE void clear(const KernelData<Dim>& data, double* field)
    {
        T* f = lanes_of<T>(field);
        for (int i = 0; i < Dim * data.node_count; ++i)
            f[i] = T {};
    }

    /// Slaves hand what they hold to their masters.
    template <int Dim, class T> SOFTGRAIN_INLINE void fold(const KernelData<Dim>& data, double* field)
    {
        T* f = lanes_of<T>(field);
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

    /// Slaves take the extrapolation of their masters. A slave at X carries X + u, so that u is extrapolated
    /// as it is: the extrapolation reproduces linear fields, X among them.
    template <int Dim, class T> SOFTGRAIN_INLINE void extend(const KernelData<Dim>& data, double* field)
    {
        T* f = lanes_of<T>(field);
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

    template <int Dim, class T> SOFTGRAIN_INLINE void interpolate(const KernelData<Dim>& data, const double* field)
    {
        const T* f = lanes_of<T>(field);
        T* s = lanes_of<T>(data.surface);
        for (int p = 0; p < data.surface_count; ++p) {
            const auto& entry = data.surface_stencil[p];
            T even[Dim] {}, odd[Dim] {}; // two sums, so that one need not wait for the other
            for (int k = 0; k < power(3, Dim) - 1; k += 2)
#pragma GCC unroll 3
                for (int d = 0; d < Dim; ++d) {
                    even[d] += entry.weight[k] * f[Dim * entry.node[k] + d];
                    odd[d] += entry.weight[k + 1] * f[Dim * entry.node[k + 1] + d];
                }
            constexpr int last = power(3, Dim) - 1;
            for (int d = 0; d < Dim; ++d)
                s[Dim * p + d] = even[d] + odd[d] + entry.weight[last] * f[Dim * entry.node[last] + d];
        }
    }

    /// f_i = - sum_p V_p P_p grad N_i (Vu et al. 2017, eq. 6, in the reference configuration) with the mean
    /// dilatation of each region in the volumetric part: the gradient of
    ///     sum over regions of V U(mean of J_p) + sum over points of V_p w(F_p).
    template <int Dim, class Law, class T> SOFTGRAIN_INLINE void internal_force(const KernelData<Dim>& data, double* min_J)
    {
        constexpr int points = power(2, Dim), stencil = power(3, Dim);
        T p[Law::parameters.size()], smallest = broadcast<T>(1e300);
        for (size_t k = 0; k < Law::parameters.size(); ++k)
            p[k] = lanes_of<T>(data.parameters)[k];
        clear<Dim, T>(data, data.force);
        T* f = lanes_of<T>(data.force);
        for (int r = 0; r < data.region_count; ++r) {
            const auto& region = data.regions[r];
            Tensor<Dim, T> F[points];
            deform<Dim, T>(data, region, F);
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
            const double volume = -region.volume / points;
#pragma GCC unroll 8
            for (int q = 0; q < points; ++q) {
                const Tensor<Dim, T> cof = cofactor(F[q]);
                Tensor<Dim, T> P;
                Law::template stress<Dim, T>(p, F[q], cof, inverse_J[q], P);
#pragma GCC unroll 3
                for (int i = 0; i < Dim; ++i)
#pragma GCC unroll 3
                    for (int j = 0; j < Dim; ++j)
                        F[q].at[i][j] = volume * (P.at[i][j] + slope * cof.at[i][j]);
            }
            const auto* block = data.blocks + region.first_block;
            if (region.block_count == 1)
                add_forces<Dim, points>(block->node, data.gradient + size_t(block->first_point) * stencil * Dim, F, f);
            else
                for (int b = 0, q = 0; b < region.block_count; ++b, ++block)
                    for (int k = 0; k < block->point_count; ++k, ++q)
                        add_forces<Dim, 1>(block->node, data.gradient + size_t(block->first_point + k) * stencil * Dim, F + q, f);
        }
        fold<Dim, T>(data, data.force);
        *lanes_of<T>(min_J) = smallest;
    }

    template <int Dim, class Law, class T>
    SOFTGRAIN_INLINE void energy(const KernelData<Dim>& data, double* energy, double* min_stretch)
    {
        constexpr int points = power(2, Dim);
        T p[Law::parameters.size()], sum {}, smallest = broadcast<T>(1e300);
        for (size_t k = 0; k < Law::parameters.size(); ++k)
            p[k] = lanes_of<T>(data.parameters)[k];
        for (int r = 0; r < data.region_count; ++r) {
            const auto& region = data.regions[r];
            Tensor<Dim, T> F[points];
            deform<Dim, T>(data, region, F);
            T mean {};
            for (int q = 0; q < points; ++q) {
                mean += determinant(F[q]);
                smallest = smaller(smallest_stretch(F[q]), smallest);
                sum += region.volume / points * Law::template energy<Dim, T>(p, F[q]);
            }
            sum += region.volume * Law::volumetric_energy(p, mean * (1.0 / points));
        }
        *lanes_of<T>(energy) = sum;
        *lanes_of<T>(min_stretch) = smallest;
    }

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

    template <int Dim, class T> SOFTGRAIN_INLINE void kick(const KernelData<Dim>& data, double dt, const double* gain)
    {
        T* v = lanes_of<T>(data.velocity);
        const T* f = lanes_of<T>(data.force);
        const T scale = dt * *lanes_of<T>(data.inverse_inertia);
        for (int i = 0; i < data.master_count; ++i) {
            const T k = scale * data.inverse_mass[i];
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                v[Dim * i + d] += k * f[Dim * i + d] + lanes_of<T>(gain)[d];
        }
        extend<Dim, T>(data, data.velocity);
        interpolate<Dim, T>(data, data.velocity);
    }

    template <int Dim, class T> SOFTGRAIN_INLINE void push(const KernelData<Dim>& data)
    {
        clear<Dim, T>(data, data.force);
        T* f = lanes_of<T>(data.force);
        const T* s = lanes_of<T>(data.surface);
        for (int p = 0; p < data.surface_count; ++p) {
            const auto& entry = data.surface_stencil[p];
            for (int k = 0; k < power(3, Dim); ++k)
#pragma GCC unroll 3
                for (int d = 0; d < Dim; ++d)
                    f[Dim * entry.node[k] + d] += entry.weight[k] * s[Dim * p + d];
        }
        fold<Dim, T>(data, data.force);
        T* v = lanes_of<T>(data.velocity);
        for (int i = 0; i < data.master_count; ++i)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                v[Dim * i + d] += data.inverse_mass[i] * f[Dim * i + d];
    }

    template <int Dim, class T> SOFTGRAIN_INLINE void drift(const KernelData<Dim>& data, double dt)
    {
        T* u = lanes_of<T>(data.displacement);
        const T* v = lanes_of<T>(data.velocity);
        for (int i = 0; i < Dim * data.master_count; ++i)
            u[i] += dt * v[i];
    }

    template <int Dim, class T> SOFTGRAIN_INLINE void observe(const KernelData<Dim>& data, double* sums)
    {
        using Sums = MotionSums<Dim>;
        T total[Sums::count] {};
        const T* u = lanes_of<T>(data.displacement);
        const T* v = lanes_of<T>(data.velocity);
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
        for (int k = 0; k < Sums::count; ++k)
            lanes_of<T>(sums)[k] = total[k];

        extend<Dim, T>(data, data.displacement);
        interpolate<Dim, T>(data, data.displacement);
        T* s = lanes_of<T>(data.surface);
        for (int p = 0; p < data.surface_count; ++p)
#pragma GCC unroll 3
            for (int d = 0; d < Dim; ++d)
                s[Dim * p + d] += data.surface_point[p].position[d];
    }

// A multiversioned function cannot be a template: these name one for every dimension, law and lane count.
#define SOFTGRAIN_MOTION(Dim, lanes, T)                                                                                \
    SOFTGRAIN_MULTIVERSION void kick_##Dim##_##lanes(const KernelData<Dim>& data, double dt, const double* gain)       \
    {                                                                                                                  \
        kick<Dim, T>(data, dt, gain);                                                                                  \
    }                                                                                                                  \
    SOFTGRAIN_MULTIVERSION void push_##Dim##_##lanes(const KernelData<Dim>& data) { push<Dim, T>(data); }              \
    SOFTGRAIN_MULTIVERSION void drift_##Dim##_##lanes(const KernelData<Dim>& data, double dt)                          \
    {                                                                                                                  \
        drift<Dim, T>(data, dt);                                                                                       \
    }                                                                                                                  \
    SOFTGRAIN_MULTIVERSION void extend_##Dim##_##lanes(const KernelData<Dim>& data)                                    \
    {                                                                                                                  \
        extend<Dim, T>(data, data.displacement);                                                                       \
    }                                                                                                                  \
    SOFTGRAIN_MULTIVERSION void observe_##Dim##_##lanes(const KernelData<Dim>& data, double* sums)                     \
    {                                                                                                                  \
        observe<Dim, T>(data, sums);                                                                                   \
    }
#define SOFTGRAIN_LAW_LANES(Law, Dim, lanes, T)                                                                        \
    SOFTGRAIN_MULTIVERSION void force_##Law##_##Dim##_##lanes(const KernelData<Dim>& data, double* min_J)              \
    {                                                                                                                  \
        internal_force<Dim, Law, T>(data, min_J);                                                                      \
    }                                                                                                                  \
    SOFTGRAIN_MULTIVERSION void energy_##Law##_##Dim##_##lanes(const KernelData<Dim>& data, double* e, double* s)      \
    {                                                                                                                  \
        energy<Dim, Law, T>(data, e, s);                                                                               \
    }
#define SOFTGRAIN_LAW(Law, Dim)                                                                                        \
    SOFTGRAIN_LAW_LANES(Law, Dim, 1, double)                                                                           \
    SOFTGRAIN_LAW_LANES(Law, Dim, 8, Lanes8)                                                                           \
    const LawKernels<Dim> Law##_##Dim { Law::name,                                                                     \
                                        int(Law::parameters.size()),                                                   \
                                        Law::parameters.data(),                                                        \
                                        &Law::wave_modulus,                                                            \
                                        &Law::complaint,                                                               \
                                        { force_##Law##_##Dim##_1, force_##Law##_##Dim##_8 },                          \
                                        { energy_##Law##_##Dim##_1, energy_##Law##_##Dim##_8 },                        \
                                        &cauchy_stress<Law> };

    SOFTGRAIN_MOTION(2, 1, double)
    SOFTGRAIN_MOTION(2, 8, Lanes8)
    const MotionKernels<2> motion_2 { { kick_2_1, kick_2_8 },
                                      { push_2_1, push_2_8 },
                                      { drift_2_1, drift_2_8 },
                                      { extend_2_1, extend_2_8 },
                                      { observe_2_1, observe_2_8 } };

    SOFTGRAIN_LAW(NeoHookean, 2)
    SOFTGRAIN_LAW(MooneyRivlin, 2)

    // The register of laws.
    const LawKernels<2>* const laws_2[] { &NeoHookean_2, &MooneyRivlin_2 };

} // namespace

template <> const LawKernels<2>& law_kernels<2>(const std::string& name)
{
    std::string known;
    for (const LawKernels<2>* law : laws_2) {
        if (name == law->name) return *law;
        known += (known.empty() ? "" : ", ") + std::string(law->name);
    }
    throw UserError("material law '" + name + "' is not there; take one of: " + known + ".");
}

template <> const MotionKernels<2>& motion_kernels<2>() { return motion_2; }

} // namespace softgrain
