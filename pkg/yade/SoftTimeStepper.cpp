// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftTimeStepper.hpp"

#include "Problems.hpp"
#include "SoftIntegrator.hpp"

namespace yade {

YADE_PLUGIN((SoftTimeStepper));

namespace {
    /// Before the integrator's first step [s]; NaN without grains.
    Real firstStep(const Scene& scene)
    {
        std::vector<softgrain::Grain<2>*> grains;
        for (const auto& body : *scene.bodies)
            if (SoftState* state = softStateOf(*body)) {
                state->prepare(*body);
                grains.push_back(&state->grain);
            }
        return grains.empty() ? NaN : softgrain::SmallestCriticalStep<2>()(grains, omp_get_max_threads());
    }
} // namespace

void SoftTimeStepper::computeTimeStep(Scene* scene)
{
    Problems::raise();
    if (!(safety > 0 && safety < 1))
        throw std::runtime_error("SoftTimeStepper: safety = " + softgrain::shown(safety) + " has to lie between 0 and 1.");
    Real limit = NaN;
    for (const auto& engine : scene->engines)
        if (auto* integrator = dynamic_cast<SoftIntegrator*>(engine.get())) {
            integrator->evaluate();
            limit = integrator->criticalStep;
        }
    if (std::isnan(limit)) limit = firstStep(*scene);
    if (!std::isnan(limit)) scene->dt = safety * limit;
}

} // namespace yade
