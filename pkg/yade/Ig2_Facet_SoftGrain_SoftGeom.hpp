// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/Facet.hpp>

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

class Ig2_Facet_SoftGrain_SoftGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(Facet, SoftGrain);
    DEFINE_FUNCTOR_ORDER_2D(Facet, SoftGrain);
    YADE_CLASS_BASE_DOC(
            Ig2_Facet_SoftGrain_SoftGeom,
            IGeomFunctor,
            "Contact points of a soft grain with a :yref:`Facet`, seen as the line it cuts from the plane of the grains: fixed or with given "
            "velocities. A line has no thickness; grains meet the face on the side of their centre, and its ends. A facet that lies in the "
            "plane cuts no line and touches nothing.");
};
REGISTER_SERIALIZABLE(Ig2_Facet_SoftGrain_SoftGeom);

} // namespace yade
