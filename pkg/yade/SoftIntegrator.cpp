// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftIntegrator.hpp"

#include "Problems.hpp"
#include "SceneCheck.hpp"
#include "SoftTimeStepper.hpp"

#include "contact/polyline.hpp"

#include <core/Omega.hpp>

#include <chrono>
#include <omp.h>
#include <utility>

namespace yade {

YADE_PLUGIN((SoftIntegrator));

namespace {

    /// Adds the time since the last call to a stage.
    class Stopwatch {
    public:
        explicit Stopwatch(std::vector<Real>& stages)
                : stages_(stages)
                , last_(Clock::now())
        {
        }
        void stage(int index)
        {
            const auto now = Clock::now();
            stages_[index] += std::chrono::duration<Real>(now - last_).count();
            last_ = now;
        }

    private:
        using Clock = std::chrono::steady_clock;
        std::vector<Real>& stages_;
        Clock::time_point last_;
    };

    Vector3r inSpace(const softgrain::Vec<2>& v) { return Vector3r(v[0], v[1], 0); }
    /// Velocity of the centre of mass, and spin.
    Vector3r rates(const softgrain::Motion<2>& motion)
    {
        return Vector3r(motion.velocity[0], motion.velocity[1], motion.angular_momentum[0] / motion.second_moment.trace());
    }

} // namespace

SoftIntegrator::~SoftIntegrator() = default;

int SoftIntegrator::threads() const { return ompThreads > 0 ? std::min(ompThreads, omp_get_max_threads()) : omp_get_max_threads(); }

void SoftIntegrator::postLoad(SoftIntegrator&) { stageSeconds.resize(4, 0); }

void SoftIntegrator::action()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Problems::raise();
    requireSaneAttributes();
    adopt();
    if (states_.empty()) return;
    requireStableStep();
    try {
        advance(scene->dt);
    } catch (const softgrain::SimulationError& error) {
        throw std::runtime_error("step " + std::to_string(scene->iter) + " (t = " + softgrain::shown(scene->time) + " s): " + error.what());
    }
}

void SoftIntegrator::advance(double dt)
{
    Stopwatch watch(stageSeconds);

    gatherLoads();
    assembly_->predict(dt, gravity.head<2>(), threads());
    watch.stage(0);

    gatherPairs();
    pose(dt);
    if (fresh_) {
        refuseOverlaps();
        for (SoftState* state : states_)
            state->justPlaced = false;
        fresh_ = false;
    }
    watch.stage(1);

    solver_.tolerance  = tolerance;
    solver_.max_sweeps = maxSweeps;
    solver_.threads    = threads();
    iterations         = solver_.solve(problem_);
    totalIterations += iterations;
    contactCount = int(problem_.contacts.size());
    contactIterations += Real(iterations) * contactCount;
    watch.stage(2);

    softgrain::EnergyBalance balance;
    softgrain::Assembly<2>::account(problem_, balance);
    for (SoftState* state : states_)
        std::fill(state->grain.surface.impulse.begin(), state->grain.surface.impulse.end(), 0.0);
    frictionDissipation += balance.friction;
    contactDissipation += balance.contact_dissipation;
    deliver(dt);
    hold(dt);
    externalWork += balance.external_work + dt / 2 * powerOfLoads();
    assembly_->correct(dt, threads());
    externalWork += dt / 2 * powerOfLoads();
    for (SoftState* state : states_)
        state->publish();
    requestCollider();
    if (scene->iter % checkInterval == 0) {
        requireSoftEngines(*scene);
        for (const Pair& pair : pairs_)
            refuseLeak(pair, pair.overlap(), 0.5); // between the contact points some is let pass
        evaluate();
    } else if (minJ() < 0.9 * evaluatedJ_) // an impact shortens the stable step within a few steps
        evaluate();
    if (scene->trackEnergy) trackEnergies();
    watch.stage(3);
}

/// Takes in the soft bodies of the scene; rebuilds the assembly when they are others than in the last step.
void SoftIntegrator::adopt()
{
    size_t known   = 0;
    bool unchanged = assembly_ != nullptr;
    for (const auto& body : *scene->bodies) {
        if (!softStateOf(*body)) continue;
        if (unchanged && known < bodies_.size() && bodies_[known] == body && states_[known] == body->state.get() && !states_[known]->outdated(*body)) {
            fresh_ |= states_[known]->justPlaced; // moved by hand
            ++known;
        } else
            unchanged = false;
        if (!unchanged) break;
    }
    if (unchanged && known == bodies_.size()) return;

    requireSoftEngines(*scene);
    assembly_.reset();
    bodies_.clear();
    states_.clear();
    place_.clear();
    std::vector<softgrain::Grain<2>*> grains;
    for (const auto& body : *scene->bodies) {
        SoftState* state = softStateOf(*body);
        if (!state) continue;
        state->prepare(*body);
        if (state->outdated(*body)) state->renew(*body);
        fresh_ |= state->justPlaced;
        if (body->clumpId >= 0)
            throw std::runtime_error("soft grain #" + std::to_string(body->id) + ": it belongs to a clump, and clumps are rigid; release it from the clump.");
        if (!body->bound)
            throw std::runtime_error(
                    "soft grain #" + std::to_string(body->id)
                    + " has no bounding box, so contacts would be missed; put Bo1_SoftGrain_Aabb() into InsertionSortCollider, and that before SoftIntegrator.");
        place_.resize(size_t(body->id) + 1, -1);
        place_[body->id] = int(states_.size());
        bodies_.push_back(body);
        states_.push_back(state);
        grains.push_back(&state->grain);
    }
    if (grains.empty()) return;
    for (const auto& body : *scene->bodies) {
        const std::string kind = body->shape ? body->shape->getClassName() : "";
        if ((kind == "Wall" || kind == "Box") && !body->bound)
            throw std::runtime_error(
                    "body #" + std::to_string(body->id) + ", a " + kind + ", has no bounding box, so grains would pass through it; put Bo1_" + kind
                    + "_Aabb() into InsertionSortCollider.");
    }
    assembly_ = std::make_unique<softgrain::Assembly<2>>(grains);
    problem_  = {};
    pairs_.clear();
    evaluate();
}

/// The limit is renewed every checkInterval steps; a SoftTimeStepper may be behind it by then.
void SoftIntegrator::requireStableStep()
{
    if (scene->dt <= criticalStep) return;
    for (const auto& engine : scene->engines)
        if (const auto* stepper = dynamic_cast<const SoftTimeStepper*>(engine.get()); stepper && stepper->active && !stepper->dead) {
            scene->dt = stepper->safety * criticalStep;
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
        if (!sane) throw std::runtime_error("SoftIntegrator: " + std::string(name) + " = " + softgrain::shown(value) + " has to " + range + ".");
    };
    demand(tolerance > 0 && tolerance < 1, "tolerance", tolerance, "lie between 0 and 1");
    demand(maxSweeps > 0, "maxSweeps", maxSweeps, "be 1 or more");
    demand(recovery >= 0 && recovery <= 1, "recovery", recovery, "lie between 0 and 1");
    demand(checkInterval > 0, "checkInterval", checkInterval, "be 1 or more");
    demand(gravity.allFinite() && gravity[2] == 0, "gravity z component", gravity[2], "be 0 and the others finite: grains stay in the xy-plane");
}

/// A body that no functor brings into contact with soft grains.
void SoftIntegrator::refuseStranger(const Body& grain, Body::id_t otherId) const
{
    const auto& other = (*scene->bodies)[otherId];
    if (!other || !other->shape) return;
    throw std::runtime_error(
            "soft grain #" + std::to_string(grain.id) + " meets body #" + std::to_string(otherId) + ", a " + other->shape->getClassName()
            + ", and no functor knows their contact; soft grains touch soft grains, walls and boxes.");
}

/// Velocities set by hand; gravity and what O.forces holds for the grains.
void SoftIntegrator::gatherLoads()
{
    scene->forces.sync();
    loads_.resize(states_.size());
    for (size_t i = 0; i < states_.size(); ++i) {
        SoftState& state = *states_[i];
        auto& grain      = state.grain;
        if (state.touched()) state.heed();
        externalWork += std::exchange(state.workByHand, 0);
        const Vector3r &force = scene->forces.getForce(grain.id), &torque = scene->forces.getTorque(grain.id);
        if (!force.allFinite() || !torque.allFinite() || force[2] != 0 || torque[0] != 0 || torque[1] != 0)
            throw std::runtime_error(
                    "soft grain #" + std::to_string(grain.id)
                    + ": the force on it in O.forces has to be finite and in the xy-plane, the torque about z; soft grains stay in the plane.");
        loads_[i]               = state.mass * gravity + Vector3r(force[0], force[1], torque[2]);
        grain.acceleration      = force.head<2>() / state.mass;
        grain.spin_acceleration = softgrain::rotation_rate(torque[2] / grain.motion.second_moment.trace());
        const auto held = state.held();
        for (int d = 0; d < 2; ++d)
            if (held[d]) {
                loads_[i][d]          = -state.contactLoad[d];
                grain.acceleration[d] = loads_[i][d] / state.mass - gravity[d];
            }
        if (held[2]) {
            loads_[i][2]            = -state.contactLoad[2];
            grain.spin_acceleration = softgrain::rotation_rate(loads_[i][2] / grain.motion.second_moment.trace());
        }
    }
}

/// Blocked degrees of freedom keep the velocity that the state asks for, by a force on the whole grain: that of the contacts
/// in the last step, which the solver has seen, and what lacks after this one.
void SoftIntegrator::hold(double dt)
{
    for (size_t i = 0; i < states_.size(); ++i) {
        SoftState& state = *states_[i];
        const auto held  = state.held();
        state.contactLoad.setZero();
        if (!held[0] && !held[1] && !held[2]) continue;
        auto& grain        = state.grain;
        const auto& motion = grain.motion;
        Vector3r impulse   = Vector3r::Zero();
        for (int p = 0; p < grain.surface.count; ++p) {
            const softgrain::Vec<2> arm = grain.surface.x(p) - motion.position;
            const Real x = grain.surface.impulse[2 * p], y = grain.surface.impulse[2 * p + 1];
            impulse += Vector3r(x, y, arm[0] * y - arm[1] * x);
        }
        const Vector3r inertias(state.mass, state.mass, motion.second_moment.trace());
        Vector3r lacking = Vector3r(state.vel[0], state.vel[1], state.angVel[2]) - rates(motion) - (dt * loads_[i] + impulse).cwiseQuotient(inertias);
        for (int k = 0; k < 3; ++k)
            if (held[k]) state.contactLoad[k] = impulse[k] / dt;
            else
                lacking[k] = 0;
        loads_[i] += inertias.cwiseProduct(lacking) / dt;
        grain.add_velocity(lacking.head<2>(), softgrain::rotation_rate(lacking[2]));
    }
}

Real SoftIntegrator::powerOfLoads() const
{
    Real sum = 0;
    for (size_t i = 0; i < states_.size(); ++i)
        sum += loads_[i].dot(rates(states_[i]->grain.motion));
    return sum;
}

/// All pairs in touch, by ascending ids of their bodies: the same order for every number of threads.
void SoftIntegrator::gatherPairs()
{
    pairs_.clear();
    problem_.bodies.clear();
    for (SoftState* state : states_)
        problem_.bodies.push_back(&state->grain.surface);
    const int geomIndex = SoftGeom::getClassIndexStatic();
    for (const auto& body : bodies_)
        for (const auto& [otherId, interaction] : body->intrs) {
            if (!interaction->isReal()) {
                if (!interaction->functorCache.geomExists) refuseStranger(*body, otherId);
                continue;
            }
            if (interaction->geom->getClassIndex() != geomIndex) continue;
            auto geom = boost::static_pointer_cast<SoftGeom>(interaction->geom);
            auto phys = boost::static_pointer_cast<SoftPhys>(interaction->phys);
            if (!phys->law) continue;
            const auto& other     = (*scene->bodies)[otherId];
            SoftState* otherState = softStateOf(*other);
            if (otherState && otherId < body->id) continue;
            if (!otherState && other->state->blockedDOFs != State::DOF_ALL)
                throw std::runtime_error(
                        "body #" + std::to_string(otherId) + ", a " + other->shape->getClassName() + ", is free to move and touches soft grain #"
                        + std::to_string(body->id) + "; only fixed or driven ones can (fixed=True, or blockedDOFs='xyzXYZ').");
            auto* state           = static_cast<SoftState*>(body->state.get());
            const bool isFirst    = interaction->id1 == body->id;
            SoftState* const one  = isFirst ? state : otherState;
            SoftState* const two  = isFirst ? otherState : state;
            int body1 = -1;
            if (one) body1 = place_[interaction->id1];
            else if (!geom->withPlane) {
                body1 = int(problem_.bodies.size());
                problem_.bodies.push_back(&geom->rigid);
            }
            pairs_.push_back(
                    { interaction->id1,
                      interaction->id2,
                      std::move(geom),
                      std::move(phys),
                      one,
                      two,
                      otherState ? nullptr : other->state.get(),
                      body1,
                      place_[interaction->id2] });
        }
}

void SoftIntegrator::pose(double dt)
{
    problem_.contacts.clear();
    deepest_ = 0;
    for (const Pair& pair : pairs_)
        for (const auto& point : pair.geom->points()) {
            if (!fresh_) refuseLeak(pair, -point.gap, 0.1);
            deepest_ = std::max(deepest_, -point.gap / pair.size());
            softgrain::Contact<2> contact;
            contact.body      = pair.geom->withPlane || point.on_second ? pair.body2 : pair.body1;
            contact.other     = pair.geom->withPlane || point.on_second ? pair.body1 : pair.body2;
            contact.point     = point.point;
            contact.face      = point.face;
            contact.vertex    = point.vertex;
            contact.weight    = point.weight;
            contact.normal    = point.normal;
            contact.gap_speed = (point.gap > 0 ? point.gap : recovery * point.gap) / dt;
            contact.drive     = softgrain::Vec<2>::Zero();
            if (pair.geom->withPlane) contact.drive = pair.rigid->vel.head<2>();
            contact.friction = pair.phys->friction;
            contact.law      = pair.phys->law;
            contact.impulse  = dt * point.force;
            problem_.contacts.push_back(contact);
        }
}

/// New grains must not overlap: contact would throw them apart. Those of a dense packing may, a little.
void SoftIntegrator::refuseOverlaps() const
{
    for (const Pair& pair : pairs_) {
        if (!pair.second->justPlaced && !(pair.first && pair.first->justPlaced)) continue;
        const auto& second = pair.second->grain.surface;
        Real depth         = 0;
        for (const auto& point : pair.geom->points())
            depth = std::max(depth, -point.gap);
        if (pair.first) { // the smaller may be inside the larger, where its points touch nothing
            const auto& first         = pair.first->grain.surface;
            const auto &larger        = first.size > second.size ? first : second, &smaller = first.size > second.size ? second : first;
            const auto middle         = (first.size > second.size ? pair.second : pair.first)->grain.motion.position;
            const Real inside         = -softgrain::project(larger, middle, softgrain::nearest_segment(larger, middle), 0.5).gap;
            if (inside > 0) depth = std::max(depth, inside + smaller.size);
        }
        if (depth > 1e-3 * second.size)
            throw std::runtime_error(
                    "bodies #" + std::to_string(pair.id1) + " and #" + std::to_string(pair.id2) + " overlap by " + softgrain::shown(depth)
                    + " m where they were put; move them apart or make them smaller.");
    }
}

/// Bodies that got past each other: the answer is worth nothing from here on. `most` in radii.
void SoftIntegrator::refuseLeak(const Pair& pair, Real depth, Real most) const
{
    if (depth <= most * pair.size()) return;
    throw softgrain::SimulationError(
            "soft grain #" + std::to_string(pair.id2) + " and body #" + std::to_string(pair.id1) + " have sunk into each other by "
            + softgrain::shown(depth / pair.size())
            + " radii; likely causes: grains pressed beyond what their resolution can follow, an impact near the wave speed, or a body moved "
              "by hand.");
}

/// Impulses to the surfaces, forces to the interactions and to the rigid bodies.
void SoftIntegrator::deliver(double dt)
{
    size_t index = 0;
    for (const Pair& pair : pairs_) {
        softgrain::Vec<2> normal = softgrain::Vec<2>::Zero(), shear = normal, place = normal;
        Real weight = 0, moment = 0;
        for (auto& point : pair.geom->points()) {
            const auto& contact = problem_.contacts[index++];
            point.force         = contact.impulse / dt;
            if (contact.impulse == softgrain::Vec<2>::Zero()) continue;
            auto& body = *problem_.bodies[contact.body];
            for (int d = 0; d < 2; ++d) {
                body.impulse[2 * contact.point + d] += contact.impulse[d];
                if (contact.other >= 0)
                    for (int k = 0; k < softgrain::face_vertices<2>; ++k)
                        problem_.bodies[contact.other]->impulse[2 * contact.vertex[k] + d] -= contact.weight[k] * contact.impulse[d];
            }
            // on body id2
            const bool onSecond           = contact.body == pair.body2;
            const softgrain::Vec<2> force = onSecond ? point.force : softgrain::Vec<2>(-point.force);
            const softgrain::Vec<2> along = force.dot(point.normal) * point.normal;
            const softgrain::Vec<2> where = body.x(contact.point);
            const Real size               = along.norm();
            normal += along;
            shear += force - along;
            place += size * where;
            weight += size;
            if (pair.rigid) {
                const softgrain::Vec<2> arm = where - pair.rigid->pos.head<2>();
                moment -= arm[0] * force[1] - arm[1] * force[0];
            }
        }
        pair.phys->normalForce  = inSpace(normal);
        pair.phys->shearForce   = inSpace(shear);
        pair.phys->contactPoint = weight > 0 ? inSpace(place / weight) : Vector3r::Zero();
        if (pair.rigid && weight > 0) {
            scene->forces.addForce(pair.id1, -inSpace(normal + shear));
            scene->forces.addTorque(pair.id1, Vector3r(0, 0, moment));
        }
    }
    scene->forces.sync(); // or they would add to those of the next step
}

/// The collider looks at centres only; grains also change shape.
void SoftIntegrator::requestCollider() const
{
    for (size_t i = 0; i < states_.size(); ++i) {
        const auto& surface = states_[i]->grain.surface;
        const auto& bound   = bodies_[i]->bound;
        if (!bound) continue;
        const Real ahead = softgrain::reach(surface, surface.speed, scene->dt);
        for (int d = 0; d < 2; ++d)
            if (surface.min[d] - ahead < bound->min[d] || surface.max[d] + ahead > bound->max[d]) scene->doSort = true;
    }
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
    evaluatedJ_  = minJ();
    criticalStep = std::numeric_limits<Real>::max();
    for (SoftState* state : states_)
        criticalStep = std::min(criticalStep, SoftTimeStepper::criticalStepOf(state->grain));
}

void SoftIntegrator::trackEnergies()
{
    auto& energy = *scene->energy;
    energy.set(elasticEnergy(), "softElastic", elasticId_);
    energy.set(kineticEnergy(), "softKinetic", kineticId_);
    energy.set(frictionDissipation, "softFriction", frictionId_);
    energy.set(contactDissipation, "softContact", contactId_);
    energy.set(-externalWork, "softExternalWork", workId_);
}

Real SoftIntegrator::elasticEnergy()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    evaluate();
    if (!assembly_) return 0;
    assembly_->evaluate_energy(scene->dt, threads());
    Real sum = 0;
    for (const SoftState* state : states_)
        sum += state->grain.elastic;
    return sum;
}

Real SoftIntegrator::kineticEnergy()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Real sum = 0;
    for (const SoftState* state : states_)
        sum += state->grain.motion.kinetic;
    return sum;
}

Real SoftIntegrator::solidArea()
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Real sum = 0;
    for (SoftState* state : states_)
        sum += state->area();
    return sum;
}

Real SoftIntegrator::minJ() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    Real least = 1;
    for (const SoftState* state : states_)
        least = std::min(least, state->grain.min_J);
    return least;
}

Real SoftIntegrator::residual() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    return problem_.residual();
}

boost::python::list SoftIntegrator::contacts() const
{
    const std::lock_guard<std::recursive_mutex> lock(guard_);
    boost::python::list touching;
    for (const Pair& pair : pairs_) {
        const Vector3r force = pair.phys->normalForce + pair.phys->shearForce;
        if (pair.phys->normalForce.squaredNorm() == 0) continue;
        touching.append(boost::python::make_tuple(
                pair.id1, pair.id2, pair.phys->contactPoint, pair.phys->normalForce.normalized(), force));
    }
    return touching;
}

} // namespace yade
