// SPDX-License-Identifier: GPL-2.0-or-later
// What ends a run.
#include "Problems.hpp"
#include "SoftIntegrator.hpp"
#include "SoftTimeStepper.hpp"

#include "contact/polyline.hpp"

#include <pkg/common/Wall.hpp>

#include <utility>

namespace yade {

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
        if (stretch < folds && state->folded())
            throw softgrain::SimulationError(whose + "its boundary has folded over itself (smallest stretch "
                                             + softgrain::shown(stretch, 2) + ")" + causes);
    }
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
    demand(damping >= 0 && damping < 1, "damping", damping, "be 0 or more and less than 1");
    demand(rigidBelow >= 0 && rigidBelow < 1, "rigidBelow", rigidBelow, "be 0 or more and less than 1");
    demand(gravity.allFinite() && gravity[2] == 0, "gravity z component", gravity[2],
           "be 0 and the others finite: grains stay in the xy-plane");
}

/// Grains to which the damping of nodes is not known.
void SoftIntegrator::refuseUndamped() const
{
    for (const SoftState* state : soft_.states) {
        const std::string begin = "soft grain #" + std::to_string(state->grain.id)
            + ": SoftIntegrator.damping = " + softgrain::shown(damping) + " is not known to ";
        if (state->grain.updated)
            throw std::runtime_error(begin + "formulation='updated'; give damping=0, or take formulation='total'.");
        const auto held = state->held();
        if (held[0] || held[1] || held[2])
            throw std::runtime_error(begin + "blockedDOFs; give damping=0, or free the grain.");
    }
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
        + ", are rigid, at least one is free to move, and no functor knows their contact; give functors that do, as "
          "softEngines(functors=rigidContacts()) does for spheres and what they touch, or take one of the two out by a "
          "mask.");
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

} // namespace yade
