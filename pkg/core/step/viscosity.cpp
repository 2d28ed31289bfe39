// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/viscosity.hpp"

#include "step/kernels.hpp"
#include "step/spectrum.hpp"
#include "step/versions.hpp"

#include <utility>

namespace softgrain {
namespace kernels {

    template <int Dim> struct ViscousForce {
        template <class T, int L> static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* viscosity)
        {
            constexpr int points = power(2, Dim);
            const T eta = item<T, L>(viscosity, 0);
            clear<Dim, T, L>(data, data.force);
            extend<Dim, T, L>(data, data.velocity);
            KernelData<Dim> moving = data;
            moving.displacement = data.velocity;
            for (int r = 0; r < data.region_count; ++r) {
                const auto& region = data.regions[r];
                const double volume = region.volume / points;
                Tensor<Dim, T> F[points], rate[points];
                deform<Dim, L>(data, region, F);
                deform<Dim, L>(moving, region, rate);
                for (int q = 0; q < points; ++q) {
                    const Tensor<Dim, T> cof = cofactor(F[q]);
                    const T J = determinant(F[q]), inverse_J = 1.0 / J;
                    Tensor<Dim, T> D, stress;
                    for (int i = 0; i < Dim; ++i)
                        for (int j = 0; j < Dim; ++j) {
                            D.at[i][j] = T {};
                            for (int k = 0; k < Dim; ++k)
                                D.at[i][j] += 0.5 * inverse_J
                                    * ((rate[q].at[i][k] - (i == k ? 1.0 : 0.0)) * cof.at[j][k]
                                       + (rate[q].at[j][k] - (j == k ? 1.0 : 0.0)) * cof.at[i][k]);
                        }
                    T trace {};
                    for (int i = 0; i < Dim; ++i)
                        trace += D.at[i][i];
                    for (int i = 0; i < Dim; ++i)
                        for (int j = 0; j < Dim; ++j) {
                            stress.at[i][j] = 2.0 * eta * D.at[i][j];
                            if (i == j) stress.at[i][j] -= 2.0 / 3 * eta * trace;
                        }
                    for (int i = 0; i < Dim; ++i)
                        for (int j = 0; j < Dim; ++j) {
                            F[q].at[i][j] = T {};
                            for (int k = 0; k < Dim; ++k)
                                F[q].at[i][j] -= volume * stress.at[i][k] * cof.at[k][j];
                        }
                }
                load<Dim, L>(data, region, F);
            }
            fold<Dim, T, L>(data, data.force);
        }
    };

} // namespace kernels

template <int Dim> void add_viscous_force(Batch<Dim>& batch, double dt)
{
    static const auto kernel = Versions<kernels::ViscousForce<Dim>, const KernelData<Dim>&, double*>::table();
    KernelData<Dim> data = batch.data();
    double* force = std::exchange(data.force, batch.viscous.data());
    kernel[batch.wide()](data, batch.viscosity.data());
    for (int i = 0; i < Dim * data.master_count * batch.lanes; ++i) {
        force[i] += batch.viscous[i];
        batch.viscous[i] *= dt;
    }
}

template <int Dim> double viscous_loss(const Batch<Dim>& batch, int lane)
{
    double sum = 0;
    for (size_t i = lane; i < size_t(Dim) * batch.mesh->master_count * batch.lanes; i += batch.lanes)
        sum -= batch.viscous[i] * batch.velocity[i];
    return sum;
}

template <int Dim> double highest_viscous_eigenvalue(const std::shared_ptr<const Discretisation<Dim>>& mesh)
{
    constexpr int steps = 40;
    Batch<Dim> batch(mesh, law_kernels<Dim>("Neo-Hookean"), 1); // any law
    batch.set_viscosity(0, 1);
    double highest;
    lanczos<Dim>(batch, steps, &highest, [&](const AlignedVector& velocity, AlignedVector& response) {
        std::copy(velocity.begin(), velocity.end(), batch.velocity.begin());
        add_viscous_force(batch, -1);
        std::copy_n(batch.viscous.begin(), response.size(), response.begin());
    });
    return highest;
}

template void add_viscous_force<2>(Batch<2>&, double);
template double viscous_loss<2>(const Batch<2>&, int);
template double highest_viscous_eigenvalue<2>(const std::shared_ptr<const Discretisation<2>>&);

} // namespace softgrain
