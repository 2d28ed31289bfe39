// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/dem/ScGeom.hpp>

#include "contact/narrow_phase.hpp"

namespace yade {

class SoftGeom : public GenericSpheresContact {
public:
    /// Contact points of a grain with another grain or a rigid polygon.
    softgrain::PairContacts<2> pair;
    /// Contact points of a grain with a wall.
    softgrain::PlaneContacts<2> plane;
    /// The rigid body's boundary, if it has one of its own.
    softgrain::Surface<2> rigid;
    bool withPlane = false;
    int axis = 0, side = 1; ///< of the wall: its normal, and where the grain is

    std::vector<softgrain::ContactPoint<2>>& points() { return withPlane ? plane.points : pair.points; }
    /// The bodies are so near that the interaction is worth keeping.
    bool near() const { return withPlane ? plane.near() : pair.near(); }
    void preSave(SoftGeom&);
    void postLoad(SoftGeom&);
    int pointCount() { return int(points().size()); }

    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            SoftGeom,
            GenericSpheresContact,
            "Contact points of two bodies at least one of which is a :yref:`SoftGrain`: surface points of the one near the boundary of the "
            "other. normal (from id1 to id2) and contactPoint are means over them, weighted with forces in the last step; refR1 and refR2 the radii of "
            "discs of equal area, both the grain's where the other body is rigid.",
            ((vector<int>, savedPoints, , Attr::hidden, "Surface point and side of each contact point, in pairs [-]."))(
                    (vector<int>, savedNear, , Attr::hidden, "List, surface point and face of each near point, in threes [-]."))(
                    (vector<Real>, savedClear, , Attr::hidden, "Travel until which each near point is out of touch [m]."))(
                    (Real, savedValid, -1, Attr::hidden, "Travel until which the near points are complete [m]."))(
                    (Real, savedTravel, 0, Attr::hidden, "Travel of the rigid body [m]."))(
                    (vector<Vector2r>, savedForces, , Attr::hidden, "Force on each contact point's side in the last step [N/m]."))(
                    (vector<Real>, savedCreep, , Attr::hidden, "How far each contact point is off the place that it sticks to [m].")),
            createIndex(),
            .def("pointCount", &SoftGeom::pointCount, "Number of contact points looked at in the last step, touching or about to [-]."));
    REGISTER_CLASS_INDEX(SoftGeom, GenericSpheresContact);
};
REGISTER_SERIALIZABLE(SoftGeom);

} // namespace yade
