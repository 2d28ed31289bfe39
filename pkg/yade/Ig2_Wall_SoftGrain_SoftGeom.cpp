// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Wall_SoftGrain_SoftGeom.hpp"

#include "Problems.hpp"
#include "RigidOutline.hpp"
#include "SoftGeom.hpp"
#include "SoftState.hpp"

namespace yade {

YADE_PLUGIN((Ig2_Wall_SoftGrain_SoftGeom));

bool Ig2_Wall_SoftGrain_SoftGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>&, const State& state1,
                                     const State& state2, const Vector3r&, const bool&,
                                     const shared_ptr<Interaction>& interaction)
{
    if (!SoftState::ready(state2)) return false;
    const auto& wall = static_cast<const Wall&>(*shape1);
    const auto& soft = static_cast<const SoftState&>(state2);
    const auto& grain = soft.grain;
    if (wall.axis > 1) return false;
    if (!state1.pos.allFinite() || !state1.vel.allFinite()) {
        Problems::note("wall #" + std::to_string(interaction->id1)
                       + ": its position or velocity is not finite; give finite numbers.");
        return interaction->isReal();
    }
    if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new SoftGeom);
    auto& geom = static_cast<SoftGeom&>(*interaction->geom);
    geom.withPlane = true;
    geom.axis = wall.axis;
    geom.side = wall.sense != 0 ? wall.sense : grain.motion.position[wall.axis] >= state1.pos[wall.axis] ? 1 : -1;
    if (state1.blockedDOFs != State::DOF_ALL)
        RigidOutline { { Vector3r::Zero() } }.show(state1, scene->dt, geom.rigid); // for its velocity alone
    Problems::guard([&] {
        const double place = state1.pos[wall.axis], speed = std::abs(state1.vel[wall.axis]);
        const bool apart = geom.plane.apart(grain.surface, wall.axis, place, geom.side, speed, scene->dt);
        geom.plane.update(apart ? grain.surface : soft.surface(), wall.axis, place, geom.side, speed, scene->dt);
    });
    return interaction->isReal() || !geom.plane.points.empty();
}

} // namespace yade
