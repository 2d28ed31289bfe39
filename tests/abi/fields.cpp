// SPDX-License-Identifier: GPL-2.0-or-later
#include "fields.hpp"

#include <core/Clump.hpp>
#include <core/InteractionLoop.hpp>
#include <core/PartialEngine.hpp>
#include <core/TimeStepper.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/GLDrawFunctors.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/ScGeom.hpp>

namespace yade::probe {

// Sizes that no object of YADE's Python shows.
static_assert(sizeof(Factorable) == 24 && sizeof(Serializable) == 24 && sizeof(Indexable) == 8
              && sizeof(ClassFactory) == 168);
static_assert(sizeof(DynlibDescriptor) == 56 && sizeof(TimingInfo) == 16 && sizeof(ForceContainer) == 304
              && sizeof(Se3r) == 56);
static_assert(sizeof(OpenMPArrayAccumulator<Real>) == 64 && sizeof(InteractionContainer) == 192);

// CLASS(name, size in YADE 2023.02a, (members)...); FIELD names a member otherwise than C++ does.
#define FIELD(K, name, member) t[#K].fields[name] = field<K>([](K & o) -> auto& { return o.member; });
#define MEMBER(r, K, m) FIELD(K, BOOST_PP_STRINGIZE(m), m)
#define CLASS(K, bytes, members)                                                                                            \
    static_assert(sizeof(K) == bytes);                                                                                      \
    t[#K].size = bytes;                                                                                                     \
    BOOST_PP_SEQ_FOR_EACH(MEMBER, K, members)

namespace {

    void engines(Table& t)
    {
        CLASS(Engine, 104, (dead)(ompThreads)(label))
        FIELD(Engine, "execTime", timingInfo.nsec)
        FIELD(Engine, "execCount", timingInfo.nExec)
        CLASS(GlobalEngine, 104, )
        CLASS(PartialEngine, 128, (ids))
        CLASS(PeriodicEngine, 184,
              (virtPeriod)(realPeriod)(iterPeriod)(nDo)(initRun)(firstIterRun)(virtLast)(realLast)(iterLast)(nDone))
        CLASS(TimeStepper, 112, (active)(timeStepUpdateInterval))
        CLASS(Dispatcher, 104, )
        CLASS(BoundDispatcher, 216, (functors)(activated)(sweepDist)(minSweepDistFactor)(updatingDispFactor)(targetInterv))
        CLASS(IGeomDispatcher, 184, (functors))
        CLASS(IPhysDispatcher, 176, (functors))
        CLASS(LawDispatcher, 176, (functors))
        CLASS(InteractionLoop, 216, (geomDispatcher)(physDispatcher)(lawDispatcher)(loopOnSortedInteractions))
    }

    void functors(Table& t)
    {
        CLASS(Functor, 80, (label))
        CLASS(BoundFunctor, 88, )
        CLASS(IGeomFunctor, 88, )
        CLASS(IPhysFunctor, 88, )
        CLASS(LawFunctor, 88, )
        CLASS(GlShapeFunctor, 88, )
    }

    void bodies(Table& t)
    {
        CLASS(Shape, 96, (color)(wire)(highlight))
        CLASS(Sphere, 104, (radius))
        CLASS(Box, 120, (extents))
        CLASS(Wall, 104, (sense)(axis))
        CLASS(Facet, 328, (vertices)(normal)(area))
        CLASS(Clump, 168, (ids))
        CLASS(Bound, 144, (lastUpdateIter)(refPos)(sweepLength)(color)(min)(max))
        CLASS(Aabb, 144, )
        CLASS(Material, 80, (id)(label)(density))
        CLASS(ElastMat, 96, (young)(poisson))
        CLASS(FrictMat, 104, (frictionAngle))
        CLASS(State, 320,
              (pos)(ori)(se3)(vel)(mass)(angVel)(angMom)(inertia)(refPos)(refOri)(blockedDOFs)(isDamped)(densityScaling))
        CLASS(Body, 176, (id)(groupMask)(flags)(subdomain)(material)(state)(shape)(bound)(clumpId)(iterBorn)(timeBorn))
        CLASS(
            BodyContainer, 200,
            (dirty)(checkedByCollider)(insertedBodies)(erasedBodies)(realBodies)(useRedirection)(enableRedirection)(subdomainBodies))
    }

    void interactions(Table& t)
    {
        CLASS(IGeom, 32, )
        CLASS(GenericSpheresContact, 96, (normal)(contactPoint)(refR1)(refR2))
        CLASS(ScGeom, 192, (penetrationDepth)(shearInc))
        CLASS(IPhys, 32, )
        CLASS(NormPhys, 64, (kn)(normalForce))
        CLASS(NormShearPhys, 96, (ks)(shearForce))
        CLASS(FrictPhys, 104, (tangensOfFrictionAngle))
        CLASS(Interaction, 168, (isActive)(id1)(id2)(iterMadeReal)(iterLastSeen)(geom)(phys)(cellDist)(linIx)(iterBorn))
        CLASS(MatchMaker, 160, (matches)(algo)(val))
    }

    void scene(Table& t)
    {
        CLASS(
            Cell, 1104,
            (trsf)(refHSize)(hSize)(prevHSize)(velGrad)(nextVelGrad)(prevVelGrad)(homoDeform)(velGradChanged)(flipFlippable))
        CLASS(EnergyTracker, 176, )
        CLASS(
            Scene, 752,
            (dt)(iter)(subStepping)(subStep)(time)(speed)(stopAtIter)(stopAtTime)(isPeriodic)(trackEnergy)(doSort)(runInternalConsistencyChecks)(selectedBody)(subdomain)(subD)(tags)(engines)(_nextEngines)(energy)(materials)(bound)(cell)(miscParams))
    }

} // namespace

const Table& table()
{
    static const Table made = [] {
        Table t;
        engines(t);
        functors(t);
        bodies(t);
        interactions(t);
        scene(t);
        return t;
    }();
    return made;
}

} // namespace yade::probe
