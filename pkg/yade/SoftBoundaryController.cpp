// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftBoundaryController.hpp"

#include "SoftImplicitIntegrator.hpp"

#include <pkg/common/NormShearPhys.hpp>
#include <pkg/common/Wall.hpp>

#include <utility>

namespace yade {

YADE_PLUGIN((SoftBoundaryController));

void SoftBoundaryController::action()
{
    requireSaneAttributes();
    const SoftIntegrator& soft = integrator();
    gravity_ = soft.gravity;
    if (std::isnan(mass)) mass = massOfGrains();
    scene->forces.sync();
    steer(dynamic_cast<const SoftImplicitIntegrator*>(&soft));
    gatheredTime += scene->dt;
    if (++gathered < globUpdate) return;
    publish(1.0 / gathered);
    currUnbalanced = unbalanced();
    gathered = 0;
    gatheredTime = 0;
    std::fill(gatheredForces.begin(), gatheredForces.end(), 0);
    if (!sameGoal()) reached = false;
    if (reached || !atGoal() || !(currUnbalanced <= maxUnbalanced)) return;
    reached = true;
    runHook();
}

void SoftBoundaryController::steer(bool)
{
    throw std::runtime_error("SoftBoundaryController moves nothing; take SoftWallController or SoftBoxController.");
}

const SoftIntegrator& SoftBoundaryController::integrator() const
{
    const SoftIntegrator* found = nullptr;
    for (const auto& engine : scene->engines) {
        if (engine.get() == this && found) return *found;
        if (const auto* soft = dynamic_cast<const SoftIntegrator*>(engine.get()); soft && !soft->dead) found = soft;
    }
    throw std::runtime_error(getClassName()
                             + " stands before SoftIntegrator in O.engines, or there is none; put it behind, as "
                               "softEngines(more=[...]) does.");
}

void SoftBoundaryController::demand(bool sane, const char* name, Real value, const char* range) const
{
    if (!sane)
        throw std::runtime_error(getClassName() + ": " + name + " = " + softgrain::shown(value) + " has to " + range + ".");
}

void SoftBoundaryController::requireSaneAttributes() const
{
    demand(std::isnan(mass) || (mass > 0 && std::isfinite(mass)), "mass", mass, "be positive and finite, or NaN");
    demand(relStressTol >= 0, "relStressTol", relStressTol, "be 0 or more");
    demand(absStressTol >= 0, "absStressTol", absStressTol, "be 0 or more");
    demand(maxUnbalanced >= 0, "maxUnbalanced", maxUnbalanced, "be 0 or more");
    demand(globUpdate > 0, "globUpdate", globUpdate, "be 1 or more");
}

namespace {
    /// Moves as a whole of its own, and is no wall.
    bool isGrain(const Body& body)
    {
        return body.isDynamic() && !body.isClumpMember() && !dynamic_cast<const Wall*>(body.shape.get());
    }
} // namespace

Real SoftBoundaryController::massOfGrains() const
{
    Real sum = 0;
    for (const auto& body : *scene->bodies)
        if (isGrain(*body)) sum += body->state->mass;
    if (!(sum > 0))
        throw std::runtime_error(
            getClassName()
            + ": the scene has no grain that moves, so no mass follows for walls; append grains, or set mass.");
    return sum;
}

Real SoftBoundaryController::unbalanced()
{
    std::vector<Vector3r> velocities;
    Real force = 0, sum = 0;
    int contacts = 0;
    const auto& before = velocitiesBefore;
    for (const auto& body : *scene->bodies) {
        if (!isGrain(*body)) continue;
        const size_t grain = velocities.size();
        velocities.push_back(body->state->vel);
        if (grain < before.size()) sum += body->state->mass * (velocities[grain] - before[grain]).norm() / gatheredTime;
    }
    const bool known = velocities.size() == before.size();
    velocitiesBefore = std::move(velocities);
    if (!known) return NaN; // grains have come or gone
    for (const auto& interaction : *scene->interactions)
        if (const auto* phys = dynamic_cast<const NormShearPhys*>(interaction->phys.get())) {
            const Real size = (phys->normalForce + phys->shearForce).norm();
            force += size;
            contacts += size > 0;
        }
    return contacts > 0 && !before.empty() ? sum / Real(before.size()) / (force / contacts) : 0;
}

void SoftBoundaryController::gather(const ControlledWall& wall, size_t number)
{
    gatheredForces.resize(std::max(gatheredForces.size(), number + 1));
    gatheredForces[number] += wall.borne();
    externalWork += wall.work();
}

void SoftBoundaryController::press(ControlledWall& wall, size_t number, const Press& press, bool implicit)
{
    const Real dt = scene->dt, borne = wall.borne();
    if (!implicit) {
        const softgrain::Piston piston { mass, press.speed, press.wanted, borne };
        // NewtonIntegrator is about to add its weight
        wall.give(piston.kicked(wall.velocity(), dt) - dt * wall.along(gravity_), piston.inertia(dt));
        return;
    }
    constexpr size_t kept = 4;
    if (servos.size() < kept * (number + 1)) servos.resize(kept * (number + 1), 0);
    Real* memory = &servos[kept * number];
    softgrain::Servo servo { memory[0], memory[1], memory[2], memory[3] > 0 ? memory[3] : 1 };
    wall.drive(servo.next(press.wanted, borne, wall.velocity() * dt, press.speed * dt) / dt);
    const Real after[kept] = { servo.force, servo.lack, servo.stiffness, servo.share };
    std::copy(after, after + kept, memory);
}

bool SoftBoundaryController::isNear(Real stress, Real goal) const
{
    return std::abs(stress - goal) <= std::max(relStressTol * std::abs(goal), absStressTol);
}

void SoftBoundaryController::runHook() const
{
    if (doneHook.empty()) return;
    const PyGILState_STATE state = PyGILState_Ensure();
    const int failed = PyRun_SimpleString(doneHook.c_str());
    PyGILState_Release(state);
    if (failed)
        throw std::runtime_error(getClassName() + ": doneHook = '" + doneHook
                                 + "' failed as printed above; mend the command.");
}

} // namespace yade
