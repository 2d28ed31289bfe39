// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftIntegrator.hpp"

#include "Bytes.hpp"
#include "Ip2_FrictMat_SoftMat_SoftPhys.hpp"
#include "Law2_ScGeom_FrictPhys_ContactDynamics.hpp"
#include "Law2_SoftGeom_SoftPhys_ContactDynamics.hpp"
#include "Problems.hpp"
#include "SceneCheck.hpp"
#include "SoftTimeStepper.hpp"
#include "Stopwatch.hpp"

#include "contact/polyline.hpp"
#include "solver/adhesion.hpp"
#include "solver/matrix_form.hpp"

#include <pkg/common/Wall.hpp>

#include <core/InteractionLoop.hpp>
#include <core/Omega.hpp>

#include <set>
#include <utility>

namespace yade {

YADE_PLUGIN((SoftIntegrator));

SoftIntegrator::~SoftIntegrator() = default;

int SoftIntegrator::threads() const
{
    return ompThreads > 0 ? std::min(ompThreads, omp_get_max_threads()) : omp_get_max_threads();
}

void SoftIntegrator::postLoad(SoftIntegrator&) { stageSeconds.resize(4, 0); }

namespace {
    /// Calls visit(functor) for every Law2 functor of this class.
    template <class Law, class Visit> void eachLaw(const Scene& scene, const Visit& visit)
    {
        for (const auto& engine : scene.engines)
            if (auto* loop = dynamic_cast<InteractionLoop*>(engine.get()))
                for (const auto& functor : loop->lawDispatcher->functors)
                    if (auto* law = dynamic_cast<Law*>(functor.get())) visit(*law);
    }

    /// Python ends with the last owner of a body that a script has made, and wants its lock for it. Not to be called under
    /// guard_: a script may hold the one and wait for the other.
    void letGo(std::vector<shared_ptr<Body>>&& bodies)
    {
        if (bodies.empty()) return;
        const PyGILState_STATE state = PyGILState_Ensure();
        bodies.clear();
        PyGILState_Release(state);
    }
} // namespace

void SoftIntegrator::action()
{
    std::vector<shared_ptr<Body>> left;
    {
        const std::lock_guard<std::recursive_mutex> lock(guard_);
        left.swap(left_);
    }
    letGo(std::move(left));
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Problems::raise();
    requireSaneAttributes();
    adopt();
    if (!assembly_) return;
    moved_ = scene->dt;
    requireStableStep();
    try {
        advance(scene->dt);
    } catch (const softgrain::SimulationError& error) {
        throw std::runtime_error("step " + std::to_string(scene->iter) + " (t = " + softgrain::shown(scene->time)
                                 + " s): " + error.what());
    }
}

/// Symplectic Euler whose velocities belong to the middles of steps: a kick lasts from the middle of the last step to that of
/// this one. With the step alone each change of it would feed energy in, as steps shrink with the grains.
void SoftIntegrator::advance(double dt)
{
    Stopwatch watch(stageSeconds);
    const double kick = lastStep > 0 ? (lastStep + dt) / 2 : dt;

    pairs_.collect(*scene, touchingPairs());
    pairs_.rigid.collect(rigidPairs());
    pairs_.wantSurfaces();
    watch.stage(1);

    loads_.gather(*scene, gravity, threads());
    assembly_->predict(kick, gravity.head<2>(), threads());
    watch.stage(0);

    pairs_.pose(*scene, kick, recovery, moved_);
    if (fresh_)
        pairs_.refuseOverlaps();
    else
        pairs_.refuseLeaksAtPoints(0.1);
    refuseStrangersNowAndThen();
    watch.stage(1);

    if (!pairs_.pulls.contacts.empty()) softgrain::give(pairs_.pulls);
    solver_.tolerance = tolerance;
    solver_.max_sweeps = maxSweeps;
    solver_.threads = threads();
    iterations = solver_.solve(pairs_.problem);
    totalIterations += iterations;
    contactCount = int(pairs_.problem.contacts.size());
    contactIterations += Real(iterations) * contactCount;
    watch.stage(2);

    softgrain::EnergyBalance balance;
    softgrain::Assembly<2>::account(pairs_.problem, balance);
    if (!pairs_.pulls.contacts.empty()) countPulls();
    pairs_.load();
    pairs_.add(kick, 1);
    pairs_.rigid.deliver(*scene, pairs_.problem, kick);
    pairs_.deliver(*scene);
    pairs_.moveFree(*scene, dt);
    const auto hold = [&](softgrain::Grain<2>& grain) {
        loads_.hold(soft_.of(grain.id), kick);
        loads_.work(soft_.of(grain.id), kick);
    };
    const auto finish = [&](softgrain::Grain<2>& grain) {
        loads_.work(soft_.of(grain.id), kick);
        settle(soft_.of(grain.id), dt);
    };
    assembly_->correct(dt, threads(), hold, finish);
    lastStep = dt;
    if (std::exchange(fresh_, false))
        for (SoftState* state : soft_.states)
            state->justPlaced = false;
    frictionDissipation += balance.friction;
    contactDissipation += balance.contact_dissipation;
    countDissipation();
    externalWork += balance.external_work + loads_.takeWork();
    if (scene->iter % checkInterval == 0) {
        requireSoftEngines(*scene);
        pairs_.refuseLeaks(0.5); // between the contact points some is let pass
        if (evaluatedStep_ != scene->iter) evaluate();
    } else if (minJ() < 0.9 * evaluatedJ_) // an impact shortens the stable step within a few steps
        evaluate();
    if (evaluatedStep_ == scene->iter) refuseCollapse();
    if (scene->trackEnergy) trackEnergies();
    watch.stage(3);
}

void SoftIntegrator::countDissipation()
{
    const auto dissipated = assembly_->dissipated();
    viscousDissipation += dissipated.viscous;
    plasticDissipation += dissipated.plastic;
}

void SoftIntegrator::countPulls()
{
    softgrain::EnergyBalance balance;
    softgrain::Assembly<2>::account(pairs_.pulls, balance);
    adhesionWork += balance.contact_dissipation;
    externalWork += balance.external_work;
}

/// The stable step shrinks with the smallest stretch: without end, the run would seem to hang. A boundary that has folded over
/// itself, a dent or a corner, meets others on the wrong side.
void SoftIntegrator::refuseCollapse() const
{
    constexpr Real least = 1e-3, folds = 0.3; // stretches; at larger ones boundaries do not fold
    const std::string causes
        = "; likely causes: grains pressed beyond what their resolution can follow, or an impact near the "
          "wave speed.";
    for (const SoftState* state : soft_.states) {
        const Real stretch = state->grain.min_stretch;
        const std::string whose = "soft grain #" + std::to_string(state->grain.id) + ": ";
        if (!(stretch > least))
            throw softgrain::SimulationError(whose
                                             + "somewhere it is pressed to less than a thousandth of its size, or turned "
                                               "inside out (smallest stretch "
                                             + softgrain::shown(stretch, 2) + ")" + causes);
        if (stretch < folds && softgrain::crosses_itself(state->surface()))
            throw softgrain::SimulationError(whose + "its boundary has folded over itself (smallest stretch "
                                             + softgrain::shown(stretch, 2) + ")" + causes);
    }
}

/// What comes of a grain after it moved.
void SoftIntegrator::settle(int grain, double dt)
{
    SoftState& state = *soft_.states[grain];
    state.publish();
    // the collider looks at centres only; grains also change shape
    const auto& surface = state.grain.surface;
    if (const auto& bound = soft_.bodies[grain]->bound; bound && surface.travel >= state.insideUntil) {
        const Real ahead = softgrain::reach(surface, surface.speed, dt) + softgrain::bulge(surface);
        Real room = std::numeric_limits<Real>::max();
        for (int d = 0; d < 2; ++d)
            room = std::min({ room, surface.min[d] - ahead - bound->min[d], bound->max[d] - surface.max[d] - ahead });
        if (room < 0) scene->doSort = true;
        state.insideUntil = surface.travel + room / 2; // what it looks ahead may grow
    }
}

bool SoftIntegrator::knowsAllBodies()
{
    if (!assembly_) return false;
    size_t seen = 0;
    for (const auto& body : *scene->bodies) {
        if (seen == known_.size() || known_[seen].first != body || known_[seen].second != body->state.get()) return false;
        ++seen;
        const int grain = soft_.of(body->id);
        if (grain < 0) continue;
        if (soft_.states[grain]->outdated(*body)) return false;
        fresh_ |= soft_.states[grain]->justPlaced; // moved by hand
    }
    return seen == known_.size();
}

/// Takes in the soft bodies of the scene; rebuilds the assembly when they are others than in the last step.
void SoftIntegrator::adopt()
{
    if (knowsAllBodies()) return;
    requireSoftEngines(*scene);
    takeOver();
    assembly_.reset();
    pairs_.clear();
    soft_ = {};
    for (const auto& [body, state] : known_)
        left_.push_back(body);
    known_.clear();
    for (const auto& body : *scene->bodies) {
        known_.push_back({ body, body->state.get() });
        if (softStateOf(*body)) takeIn(body);
    }
    bool rigid = false; // bodies have contacts with each other
    eachLaw<Law2_ScGeom_FrictPhys_ContactDynamics>(*scene, [&](auto&) { rigid = true; });
    if (soft_.states.empty() && !rigid) return;
    for (const auto& body : *scene->bodies) {
        const std::string kind = body->shape ? body->shape->getClassName() : "";
        if ((kind == "Wall" || kind == "Box" || kind == "Sphere" || kind == "Facet") && !body->bound)
            throw std::runtime_error("body #" + std::to_string(body->id) + ", a " + kind
                                     + ", has no bounding box, so grains would pass through it; put Bo1_" + kind
                                     + "_Aabb() into InsertionSortCollider.");
    }
    std::vector<softgrain::Grain<2>*> grains;
    for (SoftState* state : soft_.states)
        grains.push_back(&state->grain);
    for (auto* grain : grains)
        grain->surface.ahead = std::max(lookAhead() * grain->radius, adhesionRange());
    assembly_ = std::make_unique<softgrain::Assembly<2>>(grains);
    assembled();
    evaluate();
}

void SoftIntegrator::takeIn(const shared_ptr<Body>& body)
{
    SoftState* state = softStateOf(*body);
    state->prepare(*body);
    if (state->outdated(*body)) state->renew(*body);
    fresh_ |= state->justPlaced;
    if (body->clumpId >= 0)
        throw std::runtime_error("soft grain #" + std::to_string(body->id)
                                 + ": it belongs to a clump, and clumps are rigid; release it from the clump.");
    if (!body->bound)
        throw std::runtime_error("soft grain #" + std::to_string(body->id)
                                 + " has no bounding box, so contacts would be missed; put Bo1_SoftGrain_Aabb() into "
                                   "InsertionSortCollider, and that before SoftIntegrator.");
    soft_.place.resize(size_t(body->id) + 1, -1);
    soft_.place[body->id] = int(soft_.states.size());
    soft_.bodies.push_back(body);
    soft_.states.push_back(state);
}

/// The limit is renewed every checkInterval steps; a SoftTimeStepper may be behind it.
void SoftIntegrator::requireStableStep()
{
    if (scene->dt <= criticalStep) return;
    for (const auto& engine : scene->engines)
        if (const auto* stepper = dynamic_cast<const SoftTimeStepper*>(engine.get());
            stepper && stepper->active && !stepper->dead) {
            scene->dt = stepper->stepAt(criticalStep);
            return;
        }
    throw std::runtime_error(
        "O.dt = " + softgrain::shown(scene->dt) + " s is over the largest stable time step of the soft grains, "
        + softgrain::shown(criticalStep) + " s; set O.dt below it, or put SoftTimeStepper() into O.engines.");
}

/// Attributes may be changed at any time.
void SoftIntegrator::requireSaneAttributes() const
{
    const auto demand = [](bool sane, const char* name, Real value, const char* range) {
        if (!sane)
            throw std::runtime_error("SoftIntegrator: " + std::string(name) + " = " + softgrain::shown(value) + " has to "
                                     + range + ".");
    };
    demand(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "lie between 0 and 1");
    demand(maxSweeps > 0, "maxSweeps", maxSweeps, "be 1 or more");
    demand(recovery >= 0 && recovery <= 1, "recovery", recovery, "lie between 0 and 1");
    demand(checkInterval > 0, "checkInterval", checkInterval, "be 1 or more");
    demand(gravity.allFinite() && gravity[2] == 0, "gravity z component", gravity[2],
           "be 0 and the others finite: grains stay in the xy-plane");
}

void SoftIntegrator::refuseStrangersNowAndThen()
{
    if (std::exchange(interactionCount_, scene->interactions->size()) != scene->interactions->size()
        || scene->iter % checkInterval == 0)
        refuseStrangers();
}

/// Two rigid bodies, one of them free to move, that would pass through each other; walls cross anyway.
void SoftIntegrator::refuseStrangers(Body::id_t id1, Body::id_t id2) const
{
    if (soft_.of(id1) >= 0 || soft_.of(id2) >= 0) return;
    const auto &one = (*scene->bodies)[id1], &two = (*scene->bodies)[id2];
    if (!one || !two || !one->shape || !two->shape) return;
    if (dynamic_cast<const Wall*>(one->shape.get()) && dynamic_cast<const Wall*>(two->shape.get())) return;
    if (!FreeBodies::mover(*scene, one) && !FreeBodies::mover(*scene, two)) return;
    throw std::runtime_error(
        "bodies #" + std::to_string(id1) + " and #" + std::to_string(id2) + ", a " + one->shape->getClassName() + " and a "
        + two->shape->getClassName()
        + ", are rigid, at least one is free to move, and no functor knows their contact; give the functors of one of "
          "YADE's laws, as in softEngines(functors=[...]), or take one of the two out by a mask.");
}

/// Bodies that no functor brings into contact with soft grains.
void SoftIntegrator::refuseStrangers() const
{
    for (const auto& interaction : *scene->interactions) {
        if (interaction->isReal() || interaction->functorCache.geomExists) continue;
        refuseStrangers(interaction->id1, interaction->id2);
        const bool first = soft_.of(interaction->id1) >= 0;
        const Body::id_t grain = first ? interaction->id1 : interaction->id2,
                         otherId = first ? interaction->id2 : interaction->id1;
        const auto& other = (*scene->bodies)[otherId];
        if (soft_.of(grain) < 0 || !other || !other->shape) continue;
        throw std::runtime_error(
            "soft grain #" + std::to_string(grain) + " meets body #" + std::to_string(otherId) + ", a "
            + other->shape->getClassName()
            + ", and no functor knows their contact; soft grains touch soft grains, walls, boxes, spheres and facets.");
    }
}

/// Interactions keep the functors of the engines that made them, and those of engines that have been replaced hand pairs over
/// to nobody: the present ones take over.
void SoftIntegrator::takeOver()
{
    std::vector<InteractionLoop*> loops;
    std::set<LawFunctor*> laws;
    for (const auto& engine : scene->engines)
        if (auto* loop = dynamic_cast<InteractionLoop*>(engine.get())) {
            loops.push_back(loop);
            for (const auto& functor : loop->lawDispatcher->functors)
                laws.insert(functor.get());
        }
    bool taken = false;
    for (const auto& interaction : *scene->interactions) {
        auto& cache = interaction->functorCache;
        if (!cache.constLaw || laws.count(cache.constLaw.get())) continue;
        cache.geomExists = true;
        cache.geom.reset();
        cache.phys.reset();
        cache.constLaw.reset();
        taken = true;
    }
    if (!taken) return;
    touchingPairs(); // of interactions that are new: all come again
    rigidPairs();
    for (InteractionLoop* loop : loops)
        loop->action();
    Problems::raise();
}

/// What the Law2 functors were called for in this step.
std::vector<TouchingPair> SoftIntegrator::touchingPairs() const
{
    std::vector<TouchingPair> pairs;
    eachLaw<Law2_SoftGeom_SoftPhys_ContactDynamics>(*scene, [&](auto& law) { law.handOver(scene->iter, pairs); });
    return pairs;
}

std::vector<RigidPair> SoftIntegrator::rigidPairs() const
{
    std::vector<RigidPair> pairs;
    eachLaw<Law2_ScGeom_FrictPhys_ContactDynamics>(*scene, [&](auto& law) { law.handOver(scene->iter, pairs); });
    return pairs;
}

/// How far the adhesion of any pair reaches [m].
Real SoftIntegrator::adhesionRange() const
{
    Real range = 0;
    for (const auto& engine : scene->engines)
        if (const auto* loop = dynamic_cast<const InteractionLoop*>(engine.get()))
            for (const auto& functor : loop->physDispatcher->functors)
                if (const auto* physics = dynamic_cast<const Ip2_FrictMat_SoftMat_SoftPhys*>(functor.get()))
                    range = std::max(range, physics->farthest());
    return range;
}

void SoftIntegrator::evaluate()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    scene = Omega::instance().getScene().get(); // a loaded engine still points to the scene before, until it runs
    for (const auto& body : *scene->bodies)
        if (softStateOf(*body) && !body->bound) return; // the first step has still to come
    adopt();
    if (!assembly_) return;
    assembly_->evaluate_stretch(threads());
    evaluatedJ_ = minJ();
    evaluatedStep_ = scene->iter;
    criticalStep = soft_.states.empty() ? std::numeric_limits<Real>::infinity()
                                        : smallestCriticalStep_(assembly_->grains(), threads());
}

void SoftIntegrator::trackEnergies()
{
    auto& energy = *scene->energy;
    energy.set(elasticEnergy(), "softElastic", elasticId_);
    energy.set(kineticEnergy(), "softKinetic", kineticId_);
    energy.set(frictionDissipation, "softFriction", frictionId_);
    energy.set(contactDissipation, "softContact", contactId_);
    if (viscousDissipation > 0) energy.set(viscousDissipation, "softViscous", viscousId_);
    if (plasticDissipation > 0) energy.set(plasticDissipation, "softPlastic", plasticId_);
    energy.set(-externalWork, "softExternalWork", workId_);
    if (adhesionWork != 0) energy.set(adhesionWork, "softAdhesion", adhesionId_);
}

Real SoftIntegrator::elasticEnergy()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    evaluate();
    if (!assembly_) return 0;
    assembly_->evaluate_energy(2 * velocitiesBehind(), threads());
    Real sum = 0;
    for (const SoftState* state : soft_.states)
        sum += state->grain.elastic;
    return sum;
}

Real SoftIntegrator::kineticEnergy()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Real sum = 0;
    for (const SoftState* state : soft_.states)
        sum += state->grain.motion.kinetic;
    return sum;
}

Real SoftIntegrator::solidArea()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Real sum = 0;
    for (SoftState* state : soft_.states)
        sum += state->area();
    return sum;
}

Real SoftIntegrator::minJ() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    return assembly_ ? assembly_->min_J() : 1;
}

Real SoftIntegrator::residual() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    return pairs_.problem.residual();
}

boost::python::tuple SoftIntegrator::contactProblem() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    const auto form = softgrain::matrix_form(pairs_.problem);
    const auto& W = form.W;
    return boost::python::make_tuple(asBytes(W.outerIndexPtr(), W.outerSize() + 1), asBytes(W.innerIndexPtr(), W.nonZeros()),
                                     asBytes(W.valuePtr(), W.nonZeros()), asBytes(form.q.data(), form.q.size()),
                                     asBytes(form.mu.data(), form.mu.size()), asBytes(form.r.data(), form.r.size()),
                                     asBytes(form.u.data(), form.u.size()));
}

boost::python::list SoftIntegrator::contacts() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    return pairs_.withForce();
}

} // namespace yade
