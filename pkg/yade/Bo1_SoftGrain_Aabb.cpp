// SPDX-License-Identifier: GPL-2.0-or-later
#include "Bo1_SoftGrain_Aabb.hpp"

#include "Problems.hpp"
#include "SoftState.hpp"

#include "contact/narrow_phase.hpp"

namespace yade {

YADE_PLUGIN((Bo1_SoftGrain_Aabb));

void Bo1_SoftGrain_Aabb::go(const shared_ptr<Shape>&, shared_ptr<Bound>& bound, const Se3r& se3, const Body* body)
{
    if (!bound) bound = shared_ptr<Bound>(new Aabb);
    auto* state = softStateOf(*body);
    if (!state) {
        Problems::note(
            "soft grain #" + std::to_string(body->id)
            + ": its shape is a SoftGrain, its state has to be a SoftState; make it with softDisc or softPolygon.");
        bound->min = bound->max = se3.position;
        return;
    }
    if (!Problems::guard([&] { state->prepare(*body); })) {
        bound->min = bound->max = se3.position;
        return;
    }
    const auto& surface = state->grain.surface;
    const Real margin = 0.01 * surface.size + 2 * surface.ahead + softgrain::bulge(surface);
    state->insideUntil = 0;
    bound->min = Vector3r(surface.min[0] - margin, surface.min[1] - margin, se3.position[2] - surface.size);
    bound->max = Vector3r(surface.max[0] + margin, surface.max[1] + margin, se3.position[2] + surface.size);
}

} // namespace yade
