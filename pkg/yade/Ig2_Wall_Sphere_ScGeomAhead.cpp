// SPDX-License-Identifier: GPL-2.0-or-later
#include "Ig2_Wall_Sphere_ScGeomAhead.hpp"

namespace yade {

YADE_PLUGIN((Ig2_Wall_Sphere_ScGeomAhead));

bool Ig2_Wall_Sphere_ScGeomAhead::go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1,
                                     const State& state2, const Vector3r& shift2, const bool& force,
                                     const shared_ptr<Interaction>& interaction)
{
    const auto& wall = static_cast<const Wall&>(*shape1);
    const Real radius = static_cast<const Sphere&>(*shape2).radius;
    const Vector3r centre = state2.pos + shift2;
    const Real way = centre[wall.axis] - state1.pos[wall.axis];
    if (!interaction->isReal() && !force && std::abs(way) > interactionDetectionFactor * radius) return false;
    if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new ScGeom);
    auto& geom = static_cast<ScGeom&>(*interaction->geom);
    const int side = wall.sense != 0 ? wall.sense : way > 0 ? 1 : -1;
    geom.normal = side * Vector3r::Unit(wall.axis);
    geom.contactPoint = centre;
    geom.contactPoint[wall.axis] = state1.pos[wall.axis];
    geom.penetrationDepth = radius - side * way;
    geom.refR1 = geom.refR2 = radius;
    return true;
}

} // namespace yade
