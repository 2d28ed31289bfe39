// SPDX-License-Identifier: GPL-2.0-or-later
// Functors and the dispatchers that call them.
//
//   BoundFunctor   Bo1_...    go(shape, bound, placement, body)            BoundDispatcher, in the collider
//   IGeomFunctor   Ig2_...    go(shapes, states, shift, force, interaction) IGeomDispatcher, in InteractionLoop
//   IPhysFunctor   Ip2_...    go(materials, interaction)                    IPhysDispatcher, in InteractionLoop
//   LawFunctor     Law2_...   go(geom, phys, interaction)                   LawDispatcher, in InteractionLoop
#pragma once

#include <core/Aabb.hpp>
#include <core/Dispatcher.hpp>
#include <core/Functor.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

class BoundFunctor
    : public Functor1D<Shape, void,
                       boost::mpl::vector<const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*>> {
public:
    BoundFunctor() { }
    YADE_ABI_STOCK(BoundFunctor)
};
YADE_ABI_STOCK_END(BoundFunctor, 88)

class IGeomFunctor
    : public Functor2D<Shape, Shape, bool,
                       boost::mpl::vector<const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&,
                                          const Vector3r&, const bool&, const shared_ptr<Interaction>&>> {
public:
    IGeomFunctor() { }
    YADE_ABI_STOCK(IGeomFunctor)
    virtual void preStep(); // once before every interaction loop
};
YADE_ABI_STOCK_END(IGeomFunctor, 88)

class IPhysFunctor
    : public Functor2D<
          Material, Material, void,
          boost::mpl::vector<const shared_ptr<Material>&, const shared_ptr<Material>&, const shared_ptr<Interaction>&>> {
public:
    IPhysFunctor() { }
    YADE_ABI_STOCK(IPhysFunctor)
};
YADE_ABI_STOCK_END(IPhysFunctor, 88)

class LawFunctor
    : public Functor2D<IGeom, IPhys, bool, boost::mpl::vector<shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*>> {
public:
    LawFunctor() { }
    YADE_ABI_STOCK(LawFunctor)
    void addForce(Body::id_t id, const Vector3r& f, Scene* s) { s->forces.addForce(id, f); }
    void addTorque(Body::id_t id, const Vector3r& t, Scene* s) { s->forces.addTorque(id, t); }
};
YADE_ABI_STOCK_END(LawFunctor, 88)

// Room of the dispatch matrices, which only YADE touches.
template <class FunctorT> class DispatchMatrices {
    vector<shared_ptr<FunctorT>> callBacks;
    vector<int> callBacksInfo;
};

class BoundDispatcher : public Dispatcher, public DispatchMatrices<BoundFunctor> {
public:
    vector<shared_ptr<BoundFunctor>> functors;
    bool activated;
    Real sweepDist;
    Real minSweepDistFactor;
    Real updatingDispFactor;
    Real targetInterv;
    BoundDispatcher() = delete;
    YADE_ABI_STOCK(BoundDispatcher)
};
YADE_ABI_STOCK_END(BoundDispatcher, 216)

class IGeomDispatcher : public Dispatcher, public DispatchMatrices<IGeomFunctor> {
    bool alreadyWarnedNoCollider;

public:
    vector<shared_ptr<IGeomFunctor>> functors;
    IGeomDispatcher() = delete;
    YADE_ABI_STOCK(IGeomDispatcher)
    shared_ptr<Interaction> explicitAction(const shared_ptr<Body>&, const shared_ptr<Body>&, bool force);
};
YADE_ABI_STOCK_END(IGeomDispatcher, 184)

class IPhysDispatcher : public Dispatcher, public DispatchMatrices<IPhysFunctor> {
public:
    vector<shared_ptr<IPhysFunctor>> functors;
    IPhysDispatcher() = delete;
    YADE_ABI_STOCK(IPhysDispatcher)
};
YADE_ABI_STOCK_END(IPhysDispatcher, 176)

class LawDispatcher : public Dispatcher, public DispatchMatrices<LawFunctor> {
public:
    vector<shared_ptr<LawFunctor>> functors;
    LawDispatcher() = delete;
    YADE_ABI_STOCK(LawDispatcher)
};
YADE_ABI_STOCK_END(LawDispatcher, 176)

} // namespace yade
