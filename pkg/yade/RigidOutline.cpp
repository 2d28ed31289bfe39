// SPDX-License-Identifier: GPL-2.0-or-later
#include "RigidOutline.hpp"

#include "Problems.hpp"
#include "SoftGeom.hpp"
#include "SoftState.hpp"

namespace yade {

void RigidOutline::show(const State& body, Real dt, softgrain::Surface<2>& surface) const
{
    const int count = int(arms.size());
    if (surface.count != count) surface.resize(count);
    surface.kind = kind;
    surface.size = size;
    surface.speed = 0;
    for (int i = 0; i < count; ++i) {
        const Vector3r velocity = body.vel + body.angVel.cross(arms[i]);
        for (int d = 0; d < 2; ++d) {
            surface.position[2 * i + d] = body.pos[d] + arms[i][d];
            surface.velocity[2 * i + d] = surface.velocity_before[2 * i + d] = velocity[d];
        }
        surface.corner[i] = kind != softgrain::Surface<2>::Kind::round;
        surface.speed = std::max(surface.speed, velocity.norm());
    }
    surface.travel += dt * surface.speed;
    surface.bound();
}

bool RigidOutline::meet(const State& body, const State& state, const shared_ptr<Interaction>& interaction, Real dt) const
{
    if (arms.empty()) {
        if (interaction->geom) static_cast<SoftGeom&>(*interaction->geom).pair.points.clear();
        return interaction->isReal();
    }
    if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new SoftGeom);
    auto& geom = static_cast<SoftGeom&>(*interaction->geom);
    const auto& grain = static_cast<const SoftState&>(state);
    Problems::guard([&] {
        show(body, dt, geom.rigid);
        geom.rigid.ahead = grain.grain.surface.ahead;
        if (!geom.pair.apart(geom.rigid, grain.grain.surface, dt)) geom.pair.update(geom.rigid, grain.surface(), dt);
    });
    return interaction->isReal() || !geom.pair.points.empty();
}

} // namespace yade
