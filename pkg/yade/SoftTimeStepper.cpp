// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftTimeStepper.hpp"

#include "Problems.hpp"
#include "SoftIntegrator.hpp"

#include <map>
#include <mutex>

namespace yade {

YADE_PLUGIN((SoftTimeStepper));

Real SoftTimeStepper::criticalStepOf(const softgrain::Grain<2>& grain)
{
    using Key
        = std::pair<std::shared_ptr<const softgrain::Discretisation<2>>, std::array<double, softgrain::max_parameters>>;
    static std::map<std::pair<Key, const void*>, double> known;
    static std::mutex guard;
    const std::lock_guard<std::mutex> lock(guard);
    const auto [entry, added] = known.try_emplace({ { grain.mesh, grain.parameters }, grain.law }, 0);
    if (added) entry->second = softgrain::unit_critical_step(grain);
    return softgrain::critical_step(grain, entry->second);
}

void SoftTimeStepper::computeTimeStep(Scene* scene)
{
    Problems::raise();
    if (!(safety > 0 && safety < 1))
        throw std::runtime_error("SoftTimeStepper: safety = " + softgrain::shown(safety) + " has to lie between 0 and 1.");
    for (const auto& engine : scene->engines)
        if (auto* integrator = dynamic_cast<SoftIntegrator*>(engine.get())) integrator->evaluate();
    Real least = std::numeric_limits<Real>::max();
    for (const auto& body : *scene->bodies)
        if (SoftState* state = softStateOf(*body)) {
            state->prepare(*body);
            least = std::min(least, criticalStepOf(state->grain));
        }
    if (least < std::numeric_limits<Real>::max()) scene->dt = safety * least;
}

} // namespace yade
