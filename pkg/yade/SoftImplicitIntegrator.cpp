// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftImplicitIntegrator.hpp"

#include "Problems.hpp"
#include "SceneCheck.hpp"
#include "Stopwatch.hpp"

#include <core/InteractionLoop.hpp>

namespace yade {

YADE_PLUGIN((SoftImplicitIntegrator));

void SoftImplicitIntegrator::assembled() { run_ = std::make_unique<softgrain::ImplicitRun<2>>(*assembly_); }

void SoftImplicitIntegrator::advance(double dt)
{
    Stopwatch watch(stageSeconds);
    loads_.gather(*scene, gravity, threads());
    refuseUnknownGrains();
    meetThemselves();
    HandedPairs pairs = handedPairs();
    pairs_.collect(*scene, std::move(pairs.soft));
    refuseUnknownPairs();
    if (const auto& rigid = pairs.rigid; !rigid.empty())
        throw std::runtime_error(
            "bodies #" + std::to_string(rigid[0].id1) + " and #" + std::to_string(rigid[0].id2)
            + ": SoftImplicitIntegrator knows no contacts between rigid bodies; take SoftIntegrator, or "
              "leave Law2_ScGeom_FrictPhys_ContactDynamics out.");
    if (fresh_) pairs_.refuseOverlaps();
    refuseStrangersNowAndThen();
    watch.stage(0);

    softgrain::ImplicitSettings settings;
    settings.theta = theta;
    settings.quasistatic = quasistatic;
    settings.tolerance = tolerance;
    settings.regularisation = regularisation;
    settings.most_iterations = maxIterations;
    settings.threads = threads();
    seen_.begin(*scene, dt, wallsAhead(), [this] { search(); });
    run_->substep = substep;
    run_->step.hold = hold;
    run_->advance(dt, settings, gravity.head<2>(), seen_, [&](double h, const auto& outcome) { take(h, dt, outcome); });
    watch.stage(2);

    pairs_.deliver(*scene);
    pairs_.deepest = run_->report.penetration;
    fresh_ = false;
    substep = run_->substep;
    hold = run_->step.hold;
    iterations = run_->report.iterations;
    totalIterations += iterations;
    substeps = run_->report.substeps;
    totalSubsteps += substeps;
    cuts = run_->report.cuts;
    totalCuts += cuts;
    contactDistance = run_->report.distance;
    imbalance = run_->report.held;
    contactCount = int(pairs_.problem.contacts.size());
    contactIterations += Real(iterations) * contactCount;
    numericalDissipation += run_->report.dissipated;
    externalWork += loads_.takeWork();
    assembly_->evaluate_stretch(threads());
    refuseCollapse();
    pairs_.refuseLeaks(0.5);
    if (scene->iter % checkInterval == 0) requireSoftEngines(*scene);
    if (scene->trackEnergy) trackEnergies();
    watch.stage(3);
}

/// What comes of a substep of the whole step.
void SoftImplicitIntegrator::take(double dt, double whole, const softgrain::ImplicitStep<2>::Outcome& outcome)
{
    seen_.pass(dt);
    pairs_.problem = run_->step.problem;
    frictionDissipation += outcome.work.friction;
    contactDissipation += outcome.work.contact_dissipation;
    externalWork += outcome.work.external_work;
    const double weighed = (quasistatic ? 1 : theta) * dt;
    pairs_.add(weighed, weighed / whole);
    auto contact = run_->step.contacts.begin();
    for (auto& pair : pairs_.pairs())
        for (auto& point : pair.geom->points())
            point.creep = (contact++)->creep;
    std::vector<softgrain::Vec<2>> before;
    for (const SoftState* state : soft_.states)
        before.push_back(state->grain.motion.position);
    assembly_->renew(dt, threads(), [&](softgrain::Grain<2>& grain) {
        const int place = soft_.of(grain.id);
        SoftState& state = *soft_.states[size_t(place)];
        const softgrain::Vec<2> way = grain.motion.position - before[size_t(place)];
        state.publish();
        state.justPlaced = false;
        loads_.work(place, Vector3r(way[0], way[1], dt * state.angVel[2]));
    });
    countDissipation();
}

/// Runs collider and interaction loop within the step: grains have left the room that the collider looked at.
void SoftImplicitIntegrator::search()
{
    for (const auto& engine : scene->engines) {
        if (engine->dead) continue;
        const bool collider = engine->getClassName() == "InsertionSortCollider";
        if (collider) scene->doSort = true;
        if (!collider && !dynamic_cast<const InteractionLoop*>(engine.get())) continue;
        engine->scene = scene;
        engine->action();
    }
    Problems::raise();
    meetThemselves();
    pairs_.collect(*scene, handedPairs().soft, true);
    refuseUnknownPairs();
}

/// NewtonIntegrator has moved the driven bodies already.
bool SoftImplicitIntegrator::wallsAhead() const
{
    for (const auto& engine : scene->engines) {
        if (engine.get() == this) return false;
        if (!engine->dead && engine->getClassName() == "NewtonIntegrator") return true;
    }
    return false;
}

void SoftImplicitIntegrator::refuseUnknownGrains() const
{
    for (const SoftState* state : soft_.states) {
        const auto refuse = [&](const std::string& what, const char* fix) {
            throw std::runtime_error("soft grain #" + std::to_string(state->grain.id) + ": " + what
                                     + " not known to SoftImplicitIntegrator; " + fix + ", or take SoftIntegrator.");
        };
        const auto held = state->held();
        if (held[0] || held[1] || held[2]) refuse("its blockedDOFs are", "free it");
        if (const double viscosity = state->grain.viscosity; viscosity > 0)
            refuse("the viscosity of its material, " + softgrain::shown(viscosity) + " Pa s, is", "give viscosity=0");
    }
}

void SoftImplicitIntegrator::refuseUnknownPairs()
{
    for (const auto& pair : pairs_.pairs()) {
        if (pair.phys->rebounds() || pair.phys->adheres())
            throw std::runtime_error(
                "bodies #" + std::to_string(pair.id1) + " and #" + std::to_string(pair.id2) + " have "
                + (pair.phys->adheres() ? "adhesion" : "coefficients of restitution")
                + ", which SoftImplicitIntegrator does not know; leave it out, or take SoftIntegrator.");
        if (pair.mover)
            throw std::runtime_error("body #" + std::to_string(pair.mover->id) + ", a " + pair.mover->shape->getClassName()
                                     + ", is free to move and touches soft grain #" + std::to_string(pair.id2)
                                     + ", and SoftImplicitIntegrator knows fixed and driven rigid bodies alone; give it "
                                       "state.blockedDOFs = 'xyzXYZ', or take SoftIntegrator.");
    }
}

void SoftImplicitIntegrator::requireSaneAttributes() const
{
    SoftIntegrator::requireSaneAttributes();
    const auto demand = [](bool sane, const char* name, Real value, const char* range) {
        if (!sane)
            throw std::runtime_error("SoftImplicitIntegrator: " + std::string(name) + " = " + softgrain::shown(value)
                                     + " has to " + range + ".");
    };
    demand(damping == 0, "damping", damping, "be 0: implicit steps do not know it, and quasi-static ones need none");
    demand(rigidBelow == 0, "rigidBelow", rigidBelow, "be 0: implicit steps do not know grains that move as rigid bodies");
    demand(theta >= 0.5 && theta <= 1, "theta", theta, "lie between 0.5 and 1");
    demand(regularisation > 0 && std::isfinite(regularisation), "regularisation", regularisation, "be positive and finite");
    demand(hold > 0 && hold <= 1, "hold", hold, "lie above 0 and not above 1");
    demand(maxIterations > 0, "maxIterations", maxIterations, "be 1 or more");
    demand(scene->dt > 0 && std::isfinite(scene->dt), "O.dt", scene->dt, "be positive and finite");
}

void SoftImplicitIntegrator::trackEnergies()
{
    SoftIntegrator::trackEnergies();
    scene->energy->set(numericalDissipation, "softNumerical", numericalId_);
}

boost::python::tuple SoftImplicitIntegrator::contactProblem() const
{
    throw std::runtime_error(
        "SoftImplicitIntegrator solves contacts and deformation together, so there is no linear contact "
        "problem to show; take SoftIntegrator.");
}

} // namespace yade
