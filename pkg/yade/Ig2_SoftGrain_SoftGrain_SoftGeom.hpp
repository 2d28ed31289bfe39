// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

class Ig2_SoftGrain_SoftGrain_SoftGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(SoftGrain, SoftGrain);
    DEFINE_FUNCTOR_ORDER_2D(SoftGrain, SoftGrain);
    YADE_CLASS_BASE_DOC(
            Ig2_SoftGrain_SoftGrain_SoftGeom,
            IGeomFunctor,
            "Contact points of two soft grains: surface points of the smaller against the smoothed outline of the larger, and sharp corners of "
            "the larger against the smaller. Periodic scenes are not supported.");
};
REGISTER_SERIALIZABLE(Ig2_SoftGrain_SoftGrain_SoftGeom);

} // namespace yade
