// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/batch.hpp"

namespace softgrain {
namespace {

    double* at_least(AlignedVector& room, size_t size)
    {
        if (room.size() < size) room.resize(size);
        return room.data();
    }

} // namespace

template <int Dim>
Batch<Dim>::Batch(std::shared_ptr<const Discretisation<Dim>> mesh_, const LawKernels<Dim>& law_, int lanes_)
    : mesh(std::move(mesh_))
    , law(law_)
    , lanes(lanes_)
    , displacement(size_t(mesh->node_count()) * Dim * lanes)
    , velocity(displacement.size())
    , parameters(size_t(max_parameters) * lanes)
    , inverse_inertia(lanes)
    , sums(size_t(MotionSums<Dim>::count) * lanes)
    , extent(size_t(SurfaceExtent<Dim>::count) * lanes)
    , gain(size_t(Dim) * lanes)
    , per_lane(2 * size_t(lanes))
{
    memory.reserve(size_t(mesh->point_count()) * law.memory_count * lanes);
    for (int p = 0; p < mesh->point_count(); ++p)
        for (int k = 0; k < law.memory_count; ++k)
            memory.insert(memory.end(), lanes, law.first_memory[k]);
}

template <int Dim> double* Batch<Dim>::surface()
{
    thread_local AlignedVector room;
    return at_least(room, size_t(mesh->surface_count()) * Dim * lanes);
}

template <int Dim> double* Batch<Dim>::force()
{
    thread_local AlignedVector room;
    return at_least(room, displacement.size());
}

template <int Dim> KernelData<Dim> Batch<Dim>::data()
{
    return { mesh->node_count(),
             mesh->master_count,
             int(mesh->regions.size()),
             mesh->surface_count(),
             mesh->cell_width,
             mesh->node_position.data(),
             mesh->node_mass.data(),
             mesh->inverse_mass.data(),
             mesh->mean_gradient.data(),
             mesh->links.data(),
             mesh->slave_row.data(),
             mesh->regions.data(),
             mesh->blocks.data(),
             mesh->gradient.data(),
             mesh->surface_stencil.data(),
             mesh->surface.data(),
             displacement.data(),
             velocity.data(),
             force(),
             surface(),
             parameters.data(),
             inverse_inertia.data(),
             memory.data() };
}

template class Batch<2>;

} // namespace softgrain
