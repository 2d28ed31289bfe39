// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/viscosity.hpp"

#include "step/kernels.hpp"
#include "step/spectrum.hpp"
#include "step/versions.hpp"

namespace softgrain {
namespace kernels {

    template <int Dim> struct ViscousForce {
        template <class T, int L>
        static SOFTGRAIN_INLINE void run(const KernelData<Dim>& data, double* viscosity, double* power)
        {
            constexpr int points = power_of_two;
            const T eta = item<T, L>(viscosity, 0);
            extend<Dim, T, L>(data, data.velocity);
            const auto f = field<T, L>(data.force);
            for (int i = Dim * data.master_count; i < Dim * data.node_count; ++i)
                f[i] = T {}; // slaves have handed over what they held
            KernelData<Dim> moving = data;
            moving.displacement = data.velocity;
            T sum {};
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
                    T trace {}, square {};
                    for (int i = 0; i < Dim; ++i)
                        trace += D.at[i][i];
                    for (int i = 0; i < Dim; ++i)
                        for (int j = 0; j < Dim; ++j) {
                            square += D.at[i][j] * D.at[i][j];
                            stress.at[i][j] = 2.0 * eta * D.at[i][j];
                            if (i == j) stress.at[i][j] -= 2.0 / 3 * eta * trace;
                        }
                    sum += volume * J * 2.0 * eta * (square - trace * trace * (1.0 / 3));
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
            field<T, L>(power)[0] = sum;
        }

        static constexpr int power_of_two = softgrain::power(2, Dim);
    };

} // namespace kernels

template <int Dim> void add_viscous_force(Batch<Dim>& batch, const KernelData<Dim>& data, double* power)
{
    static const auto kernel = Versions<kernels::ViscousForce<Dim>, const KernelData<Dim>&, double*, double*>::table();
    kernel[batch.wide()](data, batch.viscosity.data(), power);
}

template <int Dim> double highest_viscous_eigenvalue(const std::shared_ptr<const Discretisation<Dim>>& mesh)
{
    constexpr int steps = 40;
    Batch<Dim> batch(mesh, law_kernels<Dim>("Neo-Hookean"), 1); // any law
    batch.viscosity.assign(1, 1);
    double highest, power;
    lanczos<Dim>(batch, steps, &highest, [&](const AlignedVector& velocity, AlignedVector& response) {
        std::copy(velocity.begin(), velocity.end(), batch.velocity.begin());
        const KernelData<Dim> data = batch.data();
        std::fill_n(data.force, batch.velocity.size(), 0.0);
        add_viscous_force(batch, data, &power);
        for (size_t at = 0; at < response.size(); ++at)
            response[at] = -data.force[at];
    });
    return highest;
}

template void add_viscous_force<2>(Batch<2>&, const KernelData<2>&, double*);
template double highest_viscous_eigenvalue<2>(const std::shared_ptr<const Discretisation<2>>&);

} // namespace softgrain
