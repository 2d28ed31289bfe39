// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/Sphere.hpp>

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

class Ig2_Sphere_SoftGrain_SoftGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(Sphere, SoftGrain);
    DEFINE_FUNCTOR_ORDER_2D(Sphere, SoftGrain);
    YADE_CLASS_BASE_DOC(
            Ig2_Sphere_SoftGrain_SoftGeom,
            IGeomFunctor,
            "Contact points of a soft grain with a :yref:`Sphere`, seen as the disc it cuts from the plane of the grains: fixed or with given "
            "velocities, alone or in a :yref:`Clump`.");
};
REGISTER_SERIALIZABLE(Ig2_Sphere_SoftGrain_SoftGeom);

} // namespace yade
