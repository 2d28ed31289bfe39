// SPDX-License-Identifier: GPL-2.0-or-later
// The smallest plugin that takes part in every stage of a step: elastic balls, m a = k * overlap, without friction.
//
//   TinyShape, TinyState, TinyMat        a body
//   TinyGeom, TinyPhys                   an interaction
//   Bo1_TinyShape_Aabb, Ig2_TinyShape_TinyShape_TinyGeom, Ig2_Wall_TinyShape_TinyGeom, Ip2_TinyMat_TinyMat_TinyPhys,
//   Law2_TinyGeom_TinyPhys_Spring        its functors
//   Gl1_TinyShape                        which would draw it
//   TinyEngine, TinyPeriodic, TinyPartial, TinyStepper
#include <core/Aabb.hpp>
#include <core/Dispatching.hpp>
#include <core/PartialEngine.hpp>
#include <core/TimeStepper.hpp>
#include <lib/base/Logging.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/GLDrawFunctors.hpp>
#include <pkg/common/PeriodicEngines.hpp>
#include <pkg/common/Wall.hpp>

#include <atomic>

namespace yade {

class TinyShape : public Shape {
public:
    int loads = 0;
    void postLoad(TinyShape&) { loads++; }
    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            TinyShape,
            Shape,
            "A ball.",
            ((Real, radius, NaN, Attr::triggerPostLoad, "Radius [m]"))
            ((vector<Vector3r>, points, , , "Points [m]"))
            ((Vector2r, pair, Vector2r(1, 2), , "Pair"))
            ((Matrix3r, matrix, Matrix3r::Identity(), , "Matrix"))
            ((Quaternionr, turn, Quaternionr::Identity(), , "Rotation"))
            ((Se3r, place, Se3r(Vector3r::Zero(), Quaternionr::Identity()), , "Placement"))
            ((vector<Real>, numbers, , , "Numbers"))
            ((shared_ptr<Shape>, other, , , "Another shape"))
            ((int, secret, 7, Attr::hidden, "Not shown"))
            ((Real, unsaved, 3, Attr::noSave, "Not saved"))
            ((long, fixed, 5, Attr::readonly, "Not changed by assignment")),
            createIndex(),
            .def_readonly("loads", &TinyShape::loads, "Calls of postLoad").def_readonly("hiddenSecret", &TinyShape::secret));
    REGISTER_CLASS_INDEX(TinyShape, Shape);
};
REGISTER_SERIALIZABLE(TinyShape);

class TinyState : public State {
public:
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(TinyState, State, "A state.", ((Real, heat, 0, , "Heat [J]")), createIndex());
    REGISTER_CLASS_INDEX(TinyState, State);
};
REGISTER_SERIALIZABLE(TinyState);

class TinyMat : public FrictMat {
public:
    shared_ptr<State> newAssocState() const override { return shared_ptr<State>(new TinyState); }
    bool stateTypeOk(State* s) const override { return dynamic_cast<TinyState*>(s) != nullptr; }
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(TinyMat, FrictMat, "A material.", ((Real, stiffness, 1000, , "Stiffness k [N/m]")), createIndex());
    REGISTER_CLASS_INDEX(TinyMat, FrictMat);
};
REGISTER_SERIALIZABLE(TinyMat);

class TinyGeom : public IGeom {
public:
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            TinyGeom,
            IGeom,
            "An overlap.",
            ((Real, overlap, 0, , "Overlap [m]"))((Vector3r, normal, Vector3r::Zero(), , "Normal, from body 1 to body 2")),
            createIndex());
    REGISTER_CLASS_INDEX(TinyGeom, IGeom);
};
REGISTER_SERIALIZABLE(TinyGeom);

class TinyPhys : public IPhys {
public:
    YADE_CLASS_BASE_DOC_ATTRS_CTOR(TinyPhys, IPhys, "A spring.", ((Real, k, 0, , "Stiffness [N/m]")), createIndex());
    REGISTER_CLASS_INDEX(TinyPhys, IPhys);
};
REGISTER_SERIALIZABLE(TinyPhys);

class Bo1_TinyShape_Aabb : public BoundFunctor {
public:
    void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body*) override
    {
        if (!bound) bound = shared_ptr<Bound>(new Aabb);
        const Vector3r half = Vector3r::Constant(static_cast<TinyShape*>(shape.get())->radius);
        bound->min = se3.position - half;
        bound->max = se3.position + half;
    }
    FUNCTOR1D(TinyShape);
    YADE_CLASS_BASE_DOC(Bo1_TinyShape_Aabb, BoundFunctor, "Bound of a ball.");
};
REGISTER_SERIALIZABLE(Bo1_TinyShape_Aabb);

namespace {
    bool setGeom(const shared_ptr<Interaction>& interaction, Real overlap, const Vector3r& normal)
    {
        if (overlap < 0 && !interaction->isReal()) return false;
        if (!interaction->geom) interaction->geom = shared_ptr<IGeom>(new TinyGeom);
        TinyGeom& geom = static_cast<TinyGeom&>(*interaction->geom);
        geom.overlap = overlap;
        geom.normal = normal;
        return true;
    }
}

class Ig2_TinyShape_TinyShape_TinyGeom : public IGeomFunctor {
public:
    std::atomic<int> preSteps { 0 };
    void preStep() override { preSteps++; }
    bool go(const shared_ptr<Shape>& shape1, const shared_ptr<Shape>& shape2, const State& state1, const State& state2,
            const Vector3r& shift, const bool&, const shared_ptr<Interaction>& interaction) override
    {
        const Vector3r line = state2.pos + shift - state1.pos;
        const Real reach = static_cast<TinyShape&>(*shape1).radius + static_cast<TinyShape&>(*shape2).radius;
        return setGeom(interaction, reach - line.norm(), line.normalized());
    }
    FUNCTOR2D(TinyShape, TinyShape);
    DEFINE_FUNCTOR_ORDER_2D(TinyShape, TinyShape);
    YADE_CLASS_BASE_DOC(Ig2_TinyShape_TinyShape_TinyGeom, IGeomFunctor, "Overlap of two balls.");
};
REGISTER_SERIALIZABLE(Ig2_TinyShape_TinyShape_TinyGeom);

class Ig2_Wall_TinyShape_TinyGeom : public IGeomFunctor {
public:
    bool go(const shared_ptr<Shape>& wall, const shared_ptr<Shape>& ball, const State& wallState, const State& ballState,
            const Vector3r&, const bool&, const shared_ptr<Interaction>& interaction) override
    {
        const int axis = static_cast<Wall&>(*wall).axis;
        const Real distance = ballState.pos[axis] - wallState.pos[axis];
        return setGeom(interaction, static_cast<TinyShape&>(*ball).radius - std::abs(distance),
                       Vector3r::Unit(axis) * (distance < 0 ? -1 : 1));
    }
    bool goReverse(const shared_ptr<Shape>& ball, const shared_ptr<Shape>& wall, const State& ballState,
                   const State& wallState, const Vector3r& shift, const bool& force,
                   const shared_ptr<Interaction>& interaction) override
    {
        interaction->swapOrder();
        return go(wall, ball, wallState, ballState, -shift, force, interaction);
    }
    FUNCTOR2D(Wall, TinyShape);
    DEFINE_FUNCTOR_ORDER_2D(Wall, TinyShape);
    YADE_CLASS_BASE_DOC(Ig2_Wall_TinyShape_TinyGeom, IGeomFunctor, "Overlap of a wall and a ball.");
};
REGISTER_SERIALIZABLE(Ig2_Wall_TinyShape_TinyGeom);

class Ip2_TinyMat_TinyMat_TinyPhys : public IPhysFunctor {
public:
    void go(const shared_ptr<Material>& m1, const shared_ptr<Material>& m2,
            const shared_ptr<Interaction>& interaction) override
    {
        if (interaction->phys) return;
        shared_ptr<TinyPhys> phys(new TinyPhys);
        phys->k = std::min(static_cast<TinyMat&>(*m1).stiffness, static_cast<TinyMat&>(*m2).stiffness);
        interaction->phys = phys;
    }
    FUNCTOR2D(TinyMat, TinyMat);
    YADE_CLASS_BASE_DOC(Ip2_TinyMat_TinyMat_TinyPhys, IPhysFunctor, "Softer of two stiffnesses.");
};
REGISTER_SERIALIZABLE(Ip2_TinyMat_TinyMat_TinyPhys);

class Law2_TinyGeom_TinyPhys_Spring : public LawFunctor {
public:
    bool go(shared_ptr<IGeom>& geom, shared_ptr<IPhys>& phys, Interaction* interaction) override
    {
        const TinyGeom& g = static_cast<TinyGeom&>(*geom);
        if (g.overlap < 0) return false;
        const Vector3r force = static_cast<TinyPhys&>(*phys).k * g.overlap * g.normal;
        scene->forces.addForce(interaction->getId1(), -force);
        scene->forces.addForce(interaction->getId2(), force);
        return true;
    }
    FUNCTOR2D(TinyGeom, TinyPhys);
    YADE_CLASS_BASE_DOC(Law2_TinyGeom_TinyPhys_Spring, LawFunctor, "Spring that only pushes.");
};
REGISTER_SERIALIZABLE(Law2_TinyGeom_TinyPhys_Spring);

class Gl1_TinyShape : public GlShapeFunctor {
public:
    RENDERS(TinyShape);
    YADE_CLASS_BASE_DOC_STATICATTRS(Gl1_TinyShape, GlShapeFunctor, "Draws nothing.",
                                    ((int, slices, 12, , "Shared by all"))((Vector2r, range, Vector2r(3, 4), ,
                                                                            "Shared too"))((string, fixed, "text",
                                                                                            Attr::readonly, "As it is")));
};
REGISTER_SERIALIZABLE(Gl1_TinyShape);
int Gl1_TinyShape::slices;
Vector2r Gl1_TinyShape::range;
string Gl1_TinyShape::fixed;

class TinyEngine : public GlobalEngine {
public:
    int energyId = -1;
    void action() override
    {
        if (fail) throw std::runtime_error("TinyEngine was told to fail");
        runs++;
        LOG_DEBUG("run " << runs);
        if (!scene->trackEnergy) return;
        scene->energy->add(0, "tiny", energyId);
#pragma omp parallel
        scene->energy->add(1.5, "tiny", energyId);
    }
    YADE_CLASS_BASE_DOC_ATTRS(
            TinyEngine,
            GlobalEngine,
            "Counts its runs; adds 1.5 J a thread to the energy 'tiny'.",
            ((int, runs, 0, Attr::readonly, "Runs so far"))((bool, fail, false, , "Throw at the next run")));
    DECLARE_LOGGER;
};
REGISTER_SERIALIZABLE(TinyEngine);
CREATE_LOGGER(TinyEngine);

class TinyPeriodic : public PeriodicEngine {
public:
    void action() override { runs++; }
    YADE_CLASS_BASE_DOC_ATTRS(TinyPeriodic, PeriodicEngine, "Counts its runs.", ((int, runs, 0, , "Runs so far")));
};
REGISTER_SERIALIZABLE(TinyPeriodic);

class TinyPartial : public PartialEngine {
public:
    void action() override
    {
        for (const int id : ids)
            scene->forces.addForce(id, push);
    }
    YADE_CLASS_BASE_DOC_ATTRS(TinyPartial, PartialEngine, "Pushes its bodies.", ((Vector3r, push, Vector3r::Zero(), , "Force [N]")));
};
REGISTER_SERIALIZABLE(TinyPartial);

class TinyStepper : public TimeStepper {
public:
    void computeTimeStep(Scene* s) override { s->dt = wanted; }
    YADE_CLASS_BASE_DOC_ATTRS(TinyStepper, TimeStepper, "Sets dt.", ((Real, wanted, 1e-5, , "Time step [s]")));
};
REGISTER_SERIALIZABLE(TinyStepper);

YADE_PLUGIN((
    TinyShape)(TinyState)(TinyMat)(TinyGeom)(TinyPhys)(Bo1_TinyShape_Aabb)(Ig2_TinyShape_TinyShape_TinyGeom)(Ig2_Wall_TinyShape_TinyGeom)(Ip2_TinyMat_TinyMat_TinyPhys)(Law2_TinyGeom_TinyPhys_Spring)(Gl1_TinyShape)(TinyEngine)(TinyPeriodic)(TinyPartial)(TinyStepper));

} // namespace yade
