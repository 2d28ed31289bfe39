// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/Box.hpp>

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

class Ig2_Box_SoftGrain_SoftGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(Box, SoftGrain);
    DEFINE_FUNCTOR_ORDER_2D(Box, SoftGrain);
    YADE_CLASS_BASE_DOC(
            Ig2_Box_SoftGrain_SoftGeom,
            IGeomFunctor,
            "Contact points of a soft grain with a :yref:`Box`, seen as the rectangle it cuts from the plane of the grains: turned about the z "
            "axis only, fixed or with given velocities.");
};
REGISTER_SERIALIZABLE(Ig2_Box_SoftGrain_SoftGeom);

} // namespace yade
