// SPDX-License-Identifier: GPL-2.0-or-later
#include "SceneCheck.hpp"

#include "FreeBodies.hpp"
#include "SoftIntegrator.hpp"
#include "SoftMat.hpp"

#include <pkg/common/Wall.hpp>

#include <core/InteractionLoop.hpp>
#include <core/PartialEngine.hpp>

#include <set>

namespace yade {

namespace {
    /// It writes positions past SoftState, which puts the grain back.
    void refuseDisplacer(const Scene& scene, const PartialEngine& displacer)
    {
        for (Body::id_t id : displacer.ids)
            if (scene.bodies->exists(id) && softStateOf(*(*scene.bodies)[id]))
                throw std::runtime_error("StepDisplacer is to move soft grain #" + std::to_string(id)
                                         + ", which would stay where it is; take the grain off its ids and set "
                                           "state.pos in a PyRunner instead.");
    }

    /// What a KinematicEngine sets of a grain is not looked at where the grain is free.
    void requireDriven(const Scene& scene, const PartialEngine& driver)
    {
        constexpr unsigned plane = State::DOF_X | State::DOF_Y | State::DOF_RZ;
        for (Body::id_t id : driver.ids)
            if (scene.bodies->exists(id))
                if (const SoftState* state = softStateOf(*(*scene.bodies)[id]);
                    state && (state->blockedDOFs & plane) != plane)
                    throw std::runtime_error(
                        driver.getClassName() + " drives soft grain #" + std::to_string(id)
                        + ", which is free to move; set its state.blockedDOFs = 'xyZ', or take the engine off it.");
    }
} // namespace

void requireSoftEngines(const Scene& scene)
{
    std::set<std::string> needed;
    std::vector<std::string> walls; // what is wrong with them
    std::string free, unmoved;      // a rigid body that is free to move; and that no engine moves
    bool soft = false;
    for (const auto& body : *scene.bodies) {
        if (softStateOf(*body)) {
            soft = true;
            continue;
        }
        const auto* wall = dynamic_cast<const Wall*>(body->shape.get());
        const std::string kind = body->shape ? body->shape->getClassName() : "";
        const bool shown = kind == "Box" || kind == "Sphere" || kind == "Facet";
        if ((wall || shown) && !dynamic_cast<const FrictMat*>(body->material.get()))
            walls.push_back("body #" + std::to_string(body->id) + ", a " + kind
                            + (body->material ? " of " + body->material->getClassName() : " without material")
                            + ", has no friction with soft grains; give it a FrictMat.");
        if ((wall || shown) && FreeBodies::mover(scene, body)) free = "body #" + std::to_string(body->id) + ", a " + kind;
        if (wall && wall->axis < 2) needed.insert("Ig2_Wall_SoftGrain_SoftGeom");
        if (shown) needed.insert("Ig2_" + kind + "_SoftGrain_SoftGeom");
        if ((wall || shown) && !dynamic_cast<const SoftMat*>(body->material.get()))
            needed.insert("Ip2_FrictMat_SoftMat_SoftPhys");
    }
    if (!soft) return;
    if (scene.isPeriodic)
        throw std::runtime_error("O.periodic=True: periodic scenes are not supported for soft grains; use walls.");
    if (!walls.empty()) throw std::runtime_error(walls.front());
    needed.insert(
        { "Ig2_SoftGrain_SoftGrain_SoftGeom", "Ip2_SoftMat_SoftMat_SoftPhys", "Law2_SoftGeom_SoftPhys_ContactDynamics" });

    int integrators = 0, loops = 0;
    bool inOrder = true, moved = false;
    for (const auto& engine : scene._nextEngines.empty() ? scene.engines : scene._nextEngines) {
        if (engine->dead) continue;
        if (dynamic_cast<const SoftIntegrator*>(engine.get())) {
            ++integrators;
            inOrder = loops > 0;
            if (!moved && !free.empty()) unmoved = free;
        }
        moved |= engine->getClassName() == "NewtonIntegrator";
        if (const auto* partial = dynamic_cast<const PartialEngine*>(engine.get())) {
            const std::string name = partial->getClassName();
            if (partial->getBaseClassName() == "KinematicEngine" || name == "CombinedKinematicEngine")
                requireDriven(scene, *partial);
            if (name == "StepDisplacer") refuseDisplacer(scene, *partial);
        }
        if (const auto* loop = dynamic_cast<const InteractionLoop*>(engine.get())) {
            ++loops;
            for (const auto& functor : loop->geomDispatcher->functors)
                needed.erase(functor->getClassName());
            for (const auto& functor : loop->physDispatcher->functors)
                needed.erase(functor->getClassName());
            for (const auto& functor : loop->lawDispatcher->functors)
                needed.erase(functor->getClassName());
        }
    }
    const std::string remedy = ", or take softEngines().";
    if (integrators == 0)
        throw std::runtime_error(
            "O.engines has no SoftIntegrator, or a dead one, so soft grains would not move; append SoftIntegrator()"
            + remedy);
    if (integrators > 1)
        throw std::runtime_error("O.engines has " + std::to_string(integrators)
                                 + " SoftIntegrators, so soft grains would move several times a step; keep one.");
    if (loops == 0)
        throw std::runtime_error(
            "O.engines has no InteractionLoop, or a dead one, so soft grains would pass through each other; add one"
            + remedy);
    if (!needed.empty())
        throw std::runtime_error("O.engines lacks " + *needed.begin()
                                 + " in InteractionLoop, so soft grains would pass through other bodies; add it" + remedy);
    if (!inOrder)
        throw std::runtime_error(
            "SoftIntegrator stands before InteractionLoop in O.engines; put it behind, where contacts are known" + remedy);
    if (!unmoved.empty())
        throw std::runtime_error(
            unmoved
            + ", is free to move, but no NewtonIntegrator in O.engines moves it before SoftIntegrator; put "
              "one there"
            + remedy);
}

} // namespace yade
