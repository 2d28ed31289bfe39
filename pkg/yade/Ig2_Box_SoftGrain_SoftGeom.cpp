// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Box_SoftGrain_SoftGeom.hpp"

#include "Problems.hpp"
#include "SoftGeom.hpp"
#include "SoftState.hpp"

namespace yade {

YADE_PLUGIN((Ig2_Box_SoftGrain_SoftGeom));

namespace {
    /// The rectangle's corners, with their velocities.
    void outlineBox(const Box& box, const State& state, double dt, softgrain::Surface<2>& surface)
    {
        if (surface.count == 0) surface.resize(4);
        constexpr int sign[4][2] { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
        surface.size = std::min(box.extents[0], box.extents[1]);
        surface.speed = 0;
        for (int i = 0; i < 4; ++i) {
            const Vector3r arm = state.ori * Vector3r(sign[i][0] * box.extents[0], sign[i][1] * box.extents[1], 0);
            const Vector3r velocity = state.vel + state.angVel.cross(arm);
            for (int d = 0; d < 2; ++d) {
                surface.position[2 * i + d] = state.pos[d] + arm[d];
                surface.velocity[2 * i + d] = surface.velocity_before[2 * i + d] = velocity[d];
            }
            surface.corner[i] = 1;
            surface.speed = std::max(surface.speed, velocity.norm());
        }
        surface.travel += dt * surface.speed;
        surface.bound();
    }
} // namespace

bool Ig2_Box_SoftGrain_SoftGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>&, const State& state1,
                                    const State& state2, const Vector3r&, const bool&,
                                    const shared_ptr<Interaction>& interaction)
{
    if (!static_cast<const SoftState&>(state2).prepared()) return false;
    const Vector3r axis = state1.ori * Vector3r::UnitZ();
    if (!state1.pos.allFinite() || !state1.vel.allFinite() || !((axis - Vector3r::UnitZ()).norm() < 1e-6)) {
        Problems::note("box #" + std::to_string(interaction->id1)
                       + ": its position and velocity have to be finite and its turn about the z axis only, for soft grains "
                         "to touch it.");
        return interaction->isReal();
    }
    if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new SoftGeom);
    auto& geom = static_cast<SoftGeom&>(*interaction->geom);
    Problems::guard([&] {
        outlineBox(static_cast<const Box&>(*shape1), state1, scene->dt, geom.rigid);
        const auto& grain = static_cast<const SoftState&>(state2);
        if (!geom.pair.apart(geom.rigid, grain.grain.surface, scene->dt))
            geom.pair.update(geom.rigid, grain.surface(), scene->dt);
    });
    return interaction->isReal() || !geom.pair.points.empty();
}

} // namespace yade
