// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Sphere_SoftGrain_SoftGeom.hpp"

#include "Problems.hpp"
#include "RigidOutline.hpp"
#include "SoftState.hpp"

namespace yade {

YADE_PLUGIN((Ig2_Sphere_SoftGrain_SoftGeom));

bool Ig2_Sphere_SoftGrain_SoftGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>&, const State& state1,
                                       const State& state2, const Vector3r&, const bool&,
                                       const shared_ptr<Interaction>& interaction)
{
    const auto& soft = static_cast<const SoftState&>(state2);
    if (!SoftState::ready(state2)) return false;
    if (!state1.pos.allFinite() || !state1.vel.allFinite() || !state1.angVel.allFinite()) {
        Problems::note("sphere #" + std::to_string(interaction->id1)
                       + ": its position, velocity or angVel is not finite; give finite numbers.");
        return interaction->isReal();
    }
    const Real radius = static_cast<const Sphere&>(*shape1).radius, off = state2.pos[2] - state1.pos[2];
    RigidOutline circle;
    if (std::abs(off) >= radius) return circle.meet(state1, state2, interaction, scene->dt);
    circle.kind = softgrain::Surface<2>::Kind::round;
    circle.size = std::sqrt(radius * radius - off * off);
    // as dense as the grain's points where its own points touch; 64 place the outline of a larger one within 3e-6 radii
    const auto& surface = soft.grain.surface;
    const int least = circle.size > surface.size ? 64 : 16;
    const int count = std::max(least, int(std::ceil(surface.count * std::min(circle.size / surface.size, 1e3))));
    const Vector3r towards = state2.pos - state1.pos; // the first point, so that light contacts have the right normal
    const Real first = std::atan2(towards[1], towards[0]);
    for (int i = 0; i < count; ++i) {
        const Real angle = first + 2 * M_PI * i / count;
        circle.arms.emplace_back(circle.size * std::cos(angle), circle.size * std::sin(angle), off);
    }
    return circle.meet(state1, state2, interaction, scene->dt);
}

} // namespace yade
