// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/implicit_body.hpp"

#include <algorithm>
#include <map>

namespace softgrain {
namespace {

    template <int Dim> class BatchInStep : public ImplicitBody<Dim> {
    public:
        BatchInStep(Batch<Dim>& batch, const std::vector<Grain<Dim>*>& members,
                    std::shared_ptr<const StiffnessPattern<Dim>> pattern)
            : ImplicitBody<Dim>(batch.lanes, members, batch.parameters.data())
            , batch_(batch)
        {
            this->pattern = std::move(pattern);
        }
        void state(AlignedVector& displacement, AlignedVector& velocity) const override
        {
            to_rows(batch_.displacement.data(), displacement);
            to_rows(batch_.velocity.data(), velocity);
        }
        void forces(const AlignedVector& displacement, AlignedVector& force) override
        {
            const KernelData<Dim> data = displaced(displacement);
            batch_.law.internal_force[batch_.wide()](data, batch_.per_lane.data());
            to_rows(data.force, force);
        }
        void energy(const AlignedVector& displacement, double* energy, double* min_stretch) override
        {
            batch_.law.energy[batch_.wide()](displaced(displacement), energy, min_stretch);
        }
        void leave(const AlignedVector& displacement, const AlignedVector& velocity) override
        {
            displaced(displacement);
            to_masters(velocity, batch_.velocity.data());
        }

    private:
        KernelData<Dim> displaced(const AlignedVector& displacement)
        {
            to_masters(displacement, batch_.displacement.data());
            motion_kernels<Dim>().extend[batch_.wide()](batch_.data());
            return batch_.data();
        }
        void to_rows(const double* masters, AlignedVector& rows) const
        {
            const size_t width = size_t(Dim) * batch_.lanes;
            for (int r = 0; r < this->pattern->rows; ++r)
                std::copy_n(masters + size_t(this->pattern->master[r]) * width, width, rows.data() + size_t(r) * width);
        }
        void to_masters(const AlignedVector& rows, double* masters) const
        {
            const size_t width = size_t(Dim) * batch_.lanes;
            for (int r = 0; r < this->pattern->rows; ++r)
                std::copy_n(rows.data() + size_t(r) * width, width, masters + size_t(this->pattern->master[r]) * width);
        }

        Batch<Dim>& batch_;
    };

    /// Displacements count from the start of the step.
    template <int Dim> class UpdatedInStep : public ImplicitBody<Dim> {
    public:
        explicit UpdatedInStep(Grain<Dim>& grain)
            : ImplicitBody<Dim>(1, { &grain }, grain.parameters.data())
            , grain_(grain)
        {
        }
        void begin() override
        {
            this->pattern = std::make_shared<StiffnessPattern<Dim>>(*grain_.mesh, *grain_.updated);
            grain_.surface.response = &grain_.updated->response();
        }
        void state(AlignedVector& displacement, AlignedVector& velocity) const override
        {
            std::fill(displacement.begin(), displacement.end(), 0.0);
            for (int r = 0; r < this->pattern->rows; ++r)
                std::copy_n(grain_.updated->node_velocity()[size_t(this->pattern->master[size_t(r)])].data(), Dim,
                            &velocity[size_t(r) * Dim]);
        }
        void forces(const AlignedVector& displacement, AlignedVector& force) override
        {
            std::fill(force.begin(), force.end(), 0.0);
            for (const auto& region : this->pattern->regions) {
                Tensor<Dim, double> P[points];
                this->pattern->deform(region, displacement.data(), P);
                grain_.law->region_stress(this->parameters, region.pointwise, -region.volume / points, P);
                const double* gradient = &this->pattern->region_gradient[region.gradient];
                for (int q = 0; q < points; ++q)
                    for (int a = 0; a < region.rows; ++a, gradient += Dim)
                        for (int i = 0; i < Dim; ++i)
                            for (int j = 0; j < Dim; ++j)
                                force[size_t(this->pattern->region_row[region.row + a]) * Dim + i]
                                    += P[q].at[i][j] * gradient[j];
            }
        }
        void energy(const AlignedVector& displacement, double* energy, double* min_stretch) override
        {
            *energy = 0;
            *min_stretch = 1e300;
            for (const auto& region : this->pattern->regions) {
                Tensor<Dim, double> F[points];
                this->pattern->deform(region, displacement.data(), F);
                *energy += grain_.law->region_energy(this->parameters, region.pointwise, region.volume, F, *min_stretch);
            }
        }
        void leave(const AlignedVector& displacement, const AlignedVector& velocity) override
        {
            for (int r = 0; r < this->pattern->rows; ++r)
                grain_.updated->put(this->pattern->master[r],
                                    this->pattern->position[r] + Eigen::Map<const Vec<Dim>>(&displacement[size_t(r) * Dim]),
                                    Eigen::Map<const Vec<Dim>>(&velocity[size_t(r) * Dim]));
        }

    private:
        static constexpr int points = power(2, Dim);

        Grain<Dim>& grain_;
    };

} // namespace

template <int Dim> std::vector<std::unique_ptr<ImplicitBody<Dim>>> implicit_bodies(Assembly<Dim>& assembly)
{
    std::vector<std::unique_ptr<ImplicitBody<Dim>>> bodies;
    std::map<const Discretisation<Dim>*, std::shared_ptr<const StiffnessPattern<Dim>>> patterns;
    Seating<Dim>& seats = assembly.seats();
    for (int b = 0; b < seats.count(); ++b) {
        Batch<Dim>& batch = seats.batch(b);
        auto& pattern = patterns[batch.mesh.get()];
        if (!pattern) pattern = std::make_shared<StiffnessPattern<Dim>>(*batch.mesh);
        if (pattern->most_rows > StiffnessPattern<Dim>::row_limit)
            throw UserError("soft grain #" + std::to_string(seats.members(b)[0]->id)
                            + ": its grid is too coarse for the implicit scheme; give more points.");
        bodies.push_back(std::make_unique<BatchInStep<Dim>>(batch, seats.members(b), pattern));
    }
    for (Grain<Dim>* grain : assembly.updated())
        bodies.push_back(std::make_unique<UpdatedInStep<Dim>>(*grain));
    return bodies;
}

template std::vector<std::unique_ptr<ImplicitBody<2>>> implicit_bodies(Assembly<2>& assembly);

} // namespace softgrain
