// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Box_SoftGrain_SoftGeom.hpp"

#include "Problems.hpp"
#include "RigidOutline.hpp"
#include "SoftState.hpp"

namespace yade {

YADE_PLUGIN((Ig2_Box_SoftGrain_SoftGeom));

bool Ig2_Box_SoftGrain_SoftGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>&, const State& state1,
                                    const State& state2, const Vector3r&, const bool&,
                                    const shared_ptr<Interaction>& interaction)
{
    if (!SoftState::ready(state2)) return false;
    const Vector3r axis = state1.ori * Vector3r::UnitZ();
    if (!state1.pos.allFinite() || !state1.vel.allFinite() || !((axis - Vector3r::UnitZ()).norm() < 1e-6)) {
        Problems::note("box #" + std::to_string(interaction->id1)
                       + ": its position and velocity have to be finite and its turn about the z axis only, for soft grains "
                         "to touch it.");
        return interaction->isReal();
    }
    const Vector3r& extents = static_cast<const Box&>(*shape1).extents;
    RigidOutline rectangle;
    for (const auto& [x, y] : { std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1) })
        rectangle.arms.push_back(state1.ori * Vector3r(x * extents[0], y * extents[1], 0));
    rectangle.size = std::min(extents[0], extents[1]);
    return rectangle.meet(state1, state2, interaction, scene->dt);
}

} // namespace yade
