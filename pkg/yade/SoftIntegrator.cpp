// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftIntegrator.hpp"

#include "Bytes.hpp"
#include "Ip2_FrictMat_SoftMat_SoftPhys.hpp"
#include "Law2_ScGeom_FrictPhys_ContactDynamics.hpp"
#include "Law2_SoftGeom_SoftPhys_ContactDynamics.hpp"
#include "Problems.hpp"
#include "SceneCheck.hpp"
#include "Stopwatch.hpp"

#include "solver/adhesion.hpp"
#include "solver/matrix_form.hpp"

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
    /// Calls visit(functor) for every functor of this class in one of the dispatchers of InteractionLoop.
    template <class Functor, class Dispatcher, class Visit>
    void eachFunctor(const Scene& scene, Dispatcher InteractionLoop::*dispatcher, const Visit& visit)
    {
        for (const auto& engine : scene.engines)
            if (auto* loop = dynamic_cast<InteractionLoop*>(engine.get()))
                for (const auto& functor : (loop->*dispatcher)->functors)
                    if (auto* found = dynamic_cast<Functor*>(functor.get())) visit(*found);
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
        const std::lock_guard lock(guard_);
        left.swap(left_);
    }
    letGo(std::move(left));
    const std::lock_guard lock(guard_);
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

    meetThemselves();
    HandedPairs pairs = handedPairs();
    pairs_.collect(*scene, std::move(pairs.soft));
    pairs_.rigid.collect(std::move(pairs.rigid));
    pairs_.wantSurfaces();
    watch.stage(1);

    loads_.gather(*scene, gravity, threads());
    if (damping > 0) refuseUndamped();
    assembly_->damping = damping;
    assembly_->rigid_below = rigidBelow;
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
    rigidCount = assembly_->flying();
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
    dampingDissipation += dissipated.numerical;
}

void SoftIntegrator::countPulls()
{
    softgrain::EnergyBalance balance;
    softgrain::Assembly<2>::account(pairs_.pulls, balance);
    adhesionWork += balance.contact_dissipation;
    externalWork += balance.external_work;
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
    eachFunctor<Law2_ScGeom_FrictPhys_ContactDynamics>(*scene, &InteractionLoop::lawDispatcher,
                                                       [&](auto&) { rigid = true; });
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
    assembly_ = std::make_unique<softgrain::Assembly<2>>(grains, mayFly());
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
    if (state->withItself) soft_.meetingThemselves.push_back(soft_.place[body->id]);
    soft_.bodies.push_back(body);
    soft_.states.push_back(state);
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
    handedPairs(); // of interactions that are new: all come again
    for (InteractionLoop* loop : loops)
        loop->action();
    Problems::raise();
}

SoftIntegrator::HandedPairs SoftIntegrator::handedPairs() const
{
    HandedPairs pairs;
    eachFunctor<LawFunctor>(*scene, &InteractionLoop::lawDispatcher, [&](LawFunctor& functor) {
        if (auto* soft = dynamic_cast<Law2_SoftGeom_SoftPhys_ContactDynamics*>(&functor))
            soft->handOver(scene->iter, pairs.soft);
        else if (auto* rigid = dynamic_cast<Law2_ScGeom_FrictPhys_ContactDynamics*>(&functor))
            rigid->handOver(scene->iter, pairs.rigid);
    });
    return pairs;
}

/// How far the adhesion of any pair reaches [m].
Real SoftIntegrator::adhesionRange() const
{
    Real range = 0;
    eachFunctor<Ip2_FrictMat_SoftMat_SoftPhys>(*scene, &InteractionLoop::physDispatcher,
                                               [&](const auto& physics) { range = std::max(range, physics.farthest()); });
    return range;
}

/// Does for grains that may meet themselves what InteractionLoop does for two bodies, by its functors.
void SoftIntegrator::meetThemselves() const
{
    if (soft_.meetingThemselves.empty()) return;
    Ip2_SoftMat_SoftMat_SoftPhys* friction = nullptr;
    Law2_SoftGeom_SoftPhys_ContactDynamics* law = nullptr;
    eachFunctor<Ip2_SoftMat_SoftMat_SoftPhys>(*scene, &InteractionLoop::physDispatcher,
                                              [&](auto& found) { friction = &found; });
    eachFunctor<Law2_SoftGeom_SoftPhys_ContactDynamics>(*scene, &InteractionLoop::lawDispatcher,
                                                        [&](auto& found) { law = &found; });
    for (int place : soft_.meetingThemselves) {
        const SoftState& state = *soft_.states[size_t(place)];
        const auto& body = soft_.bodies[size_t(place)];
        const auto& surface = state.surface();
        // implicit steps look again within the step, where there is a pair at all
        const Real near = softgrain::reach(surface, surface.speed, scene->dt) + 10 * surface.ahead;
        state.withItself->pair.look(surface, surface, near);
        const shared_ptr<Interaction> interaction(new Interaction(body->id, body->id));
        friction->go(body->material, body->material, interaction);
        static_cast<SoftPhys&>(*interaction->phys).adhesion = 0; // its state would have to last over steps
        shared_ptr<IGeom> geom = state.withItself;
        law->go(geom, interaction->phys, interaction.get());
    }
    Problems::raise();
}

void SoftIntegrator::evaluate()
{
    const std::lock_guard lock(guard_);
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
    if (dampingDissipation > 0) energy.set(dampingDissipation, "softDamping", dampingId_);
    energy.set(-externalWork, "softExternalWork", workId_);
    if (adhesionWork != 0) energy.set(adhesionWork, "softAdhesion", adhesionId_);
}

Real SoftIntegrator::elasticEnergy()
{
    const std::lock_guard lock(guard_);
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
    const std::lock_guard lock(guard_);
    Real sum = 0;
    for (const SoftState* state : soft_.states)
        sum += state->grain.motion.kinetic;
    return sum;
}

Real SoftIntegrator::solidArea()
{
    const std::lock_guard lock(guard_);
    Real sum = 0;
    for (SoftState* state : soft_.states)
        sum += state->area();
    return sum;
}

Real SoftIntegrator::minJ() const
{
    const std::lock_guard lock(guard_);
    return assembly_ ? assembly_->min_J() : 1;
}

Real SoftIntegrator::residual() const
{
    const std::lock_guard lock(guard_);
    return pairs_.problem.residual();
}

boost::python::tuple SoftIntegrator::contactProblem() const
{
    const std::lock_guard lock(guard_);
    const auto form = softgrain::matrix_form(pairs_.problem);
    const auto& W = form.W;
    return boost::python::make_tuple(asBytes(W.outerIndexPtr(), W.outerSize() + 1), asBytes(W.innerIndexPtr(), W.nonZeros()),
                                     asBytes(W.valuePtr(), W.nonZeros()), asBytes(form.q.data(), form.q.size()),
                                     asBytes(form.mu.data(), form.mu.size()), asBytes(form.r.data(), form.r.size()),
                                     asBytes(form.u.data(), form.u.size()));
}

boost::python::object SoftIntegrator::contactPoints() const
{
    const std::lock_guard lock(guard_);
    return asBytes(pairs_.pointForces());
}

boost::python::list SoftIntegrator::contacts() const
{
    const std::lock_guard lock(guard_);
    return pairs_.withForce();
}

} // namespace yade
