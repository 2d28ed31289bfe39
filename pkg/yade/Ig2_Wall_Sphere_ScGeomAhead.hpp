// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/ScGeom.hpp>

#include <core/Dispatching.hpp>

namespace yade {

class Ig2_Wall_Sphere_ScGeomAhead : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift2, const bool& force, const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(Wall, Sphere);
    DEFINE_FUNCTOR_ORDER_2D(Wall, Sphere);
    YADE_CLASS_BASE_DOC_ATTRS(
            Ig2_Wall_Sphere_ScGeomAhead,
            IGeomFunctor,
            "A sphere near a :yref:`Wall`, on its ``sense`` side, or with sense 0 on the side where its centre is, before it touches: contact by "
            "Contact Dynamics looks ahead, and YADE's own functor finds a wall when a sphere is in it. For "
            ":yref:`Law2_ScGeom_FrictPhys_ContactDynamics` alone, since increments of shear are not kept.",
            ((Real, interactionDetectionFactor, 1.1, , "Distance of the centre from which on a pair is made [radius].")));
};
REGISTER_SERIALIZABLE(Ig2_Wall_Sphere_ScGeomAhead);

} // namespace yade
