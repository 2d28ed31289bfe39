// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_SoftGrain_SoftGrain_SoftGeom.hpp"

#include "Problems.hpp"
#include "SoftGeom.hpp"
#include "SoftState.hpp"

namespace yade {

YADE_PLUGIN((Ig2_SoftGrain_SoftGrain_SoftGeom));

bool Ig2_SoftGrain_SoftGrain_SoftGeom::go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State& state1,
                                          const State& state2, const Vector3r&, const bool&,
                                          const shared_ptr<Interaction>& interaction)
{
    const auto &first = static_cast<const SoftState&>(state1), &second = static_cast<const SoftState&>(state2);
    if (!SoftState::ready(state1) || !SoftState::ready(state2)) return false;
    if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new SoftGeom);
    auto& geom = static_cast<SoftGeom&>(*interaction->geom);
    if (geom.pair.apart(first.grain.surface, second.grain.surface, scene->dt)) return interaction->isReal();
    Problems::guard([&] { geom.pair.update(first.surface(), second.surface(), scene->dt); });
    return interaction->isReal() || !geom.pair.points.empty();
}

} // namespace yade
