// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>

namespace yade {

class IGeomFunctor;
class IPhysFunctor;
class LawFunctor;

// Pair of bodies whose bounds overlap; real once it has geom and phys.
class Interaction : public Serializable {
public:
    bool isActive;
    struct {
        bool geomExists;
        shared_ptr<IGeomFunctor> geom;
        shared_ptr<IPhysFunctor> phys;
        shared_ptr<LawFunctor> constLaw;
    } functorCache;
    Body::id_t id1;
    Body::id_t id2;
    long iterMadeReal;
    long iterLastSeen;
    shared_ptr<IGeom> geom;
    shared_ptr<IPhys> phys;
    Vector3i cellDist; // periodic image of id2, in cells
    int linIx;         // place in InteractionContainer
    long iterBorn;

    Interaction();
    Interaction(Body::id_t id1, Body::id_t id2);
    YADE_ABI_STOCK(Interaction)
    py::dict pyDictCustom() const override;

    bool isReal() const;
    bool isFresh(Scene*); // became real in this step
    const Body::id_t& getId1() const { return id1; }
    const Body::id_t& getId2() const { return id2; }
    void swapOrder();
    void reset();
};
YADE_ABI_STOCK_END(Interaction, 168)

} // namespace yade
