// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/Wall.hpp>

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

class Ig2_Wall_SoftGrain_SoftGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(Wall, SoftGrain);
    DEFINE_FUNCTOR_ORDER_2D(Wall, SoftGrain);
    YADE_CLASS_BASE_DOC(
            Ig2_Wall_SoftGrain_SoftGeom,
            IGeomFunctor,
            "Contact points of a soft grain with a :yref:`Wall` of axis 0 or 1. The grain is on the wall's ``sense`` side; with sense 0 on the "
            "side where its centre was when they met. Walls of axis 2 lie in the plane of the grains and do not touch them.");
};
REGISTER_SERIALIZABLE(Ig2_Wall_SoftGrain_SoftGeom);

} // namespace yade
