// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Facet_SoftGrain_SoftGeom.hpp"

#include "Problems.hpp"
#include "RigidOutline.hpp"
#include "SoftState.hpp"

namespace yade {

YADE_PLUGIN((Ig2_Facet_SoftGrain_SoftGeom));

namespace {
    constexpr Real thickness = 0.02; // [radius of the grain], behind the line

    /// Where the triangle meets the plane of height z above the body's position: none or two points.
    vector<Vector3r> cut(const Facet& facet, const Quaternionr& turn, Real z)
    {
        vector<Vector3r> corners, points;
        for (const Vector3r& vertex : facet.vertices)
            corners.push_back(turn * vertex);
        for (size_t i = 0; i < corners.size(); ++i) {
            const Vector3r &from = corners[i], &to = corners[(i + 1) % corners.size()];
            if ((from[2] >= z) != (to[2] >= z)) points.push_back(from + (z - from[2]) / (to[2] - from[2]) * (to - from));
        }
        return points;
    }
} // namespace

bool Ig2_Facet_SoftGrain_SoftGeom::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>&, const State& state1,
                                      const State& state2, const Vector3r&, const bool&,
                                      const shared_ptr<Interaction>& interaction)
{
    const auto& soft = static_cast<const SoftState&>(state2);
    if (!SoftState::ready(state2)) return false;
    if (!state1.pos.allFinite() || !state1.vel.allFinite() || !state1.angVel.allFinite()) {
        Problems::note("facet #" + std::to_string(interaction->id1)
                       + ": its position, velocity or angVel is not finite; give finite numbers.");
        return interaction->isReal();
    }
    const auto ends = cut(static_cast<const Facet&>(*shape1), state1.ori, state2.pos[2] - state1.pos[2]);
    RigidOutline line;
    if (ends.size() < 2 || (ends[1] - ends[0]).norm() == 0) return line.meet(state1, state2, interaction, scene->dt);
    const auto& grain = soft.grain;
    Vector3r start = ends[0], along = ends[1] - ends[0], normal = Vector3r(along[1], -along[0], 0).normalized();
    const Vector3r& middle = state2.pos;
    const bool behind = normal.dot(middle - state1.pos - start) < 0;
    if (behind) { // the line shows its other face
        start = ends[1];
        along = -along;
        normal = -normal;
    }
    const Vector3r back = -thickness * grain.radius * normal;
    line.kind = softgrain::Surface<2>::Kind::line;
    line.arms = { start, start + along, start + along + back, start + back };
    line.size = back.norm() / 2;
    return line.meet(state1, state2, interaction, scene->dt);
}

} // namespace yade
