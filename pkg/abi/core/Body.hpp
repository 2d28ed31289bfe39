// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Bound.hpp>
#include <core/Material.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

#include <map>

namespace yade {

class Interaction;

class Body : public Serializable {
public:
    using id_t = int;
    using MapId2IntrT = std::map<id_t, shared_ptr<Interaction>>;
    enum { FLAG_BOUNDED = 1, FLAG_ASPHERICAL = 2, FLAG_SUBDOMAIN = 4, FLAG_FLUIDDOMAINBBOX = 8 };

    id_t id;
    mask_t groupMask;
    int flags; // bits FLAG_...
    int subdomain;
    shared_ptr<Material> material;
    shared_ptr<State> state;
    shared_ptr<Shape> shape;
    shared_ptr<Bound> bound;
    MapId2IntrT intrs; // by the other body's id; kept by InteractionContainer
    id_t clumpId;
    long iterBorn;
    Real timeBorn;

    static const id_t ID_NONE;
    static const shared_ptr<Body>& byId(id_t, Scene* = nullptr);

    Body();
    YADE_ABI_STOCK(Body)
    virtual void userForcedDisplacementRedrawHook();

    id_t getId() const { return id; }
    bool isClump() const;
    bool isClumpMember() const;
    bool isStandalone() const;
    bool isDynamic() const; // not all degrees of freedom are blocked
    void setDynamic(bool);
    bool isBounded() const;
    void setBounded(bool);
    bool isAspherical() const;
    void setAspherical(bool);
    bool maskOk(int) const;
    bool maskCompatible(int) const;
};
YADE_ABI_STOCK_END(Body, 176)

} // namespace yade
