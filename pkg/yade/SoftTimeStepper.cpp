// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftTimeStepper.hpp"

#include "Problems.hpp"
#include "SoftIntegrator.hpp"

#include <algorithm>
#include <cmath>

namespace yade {

YADE_PLUGIN((SoftTimeStepper));

namespace {
    std::vector<softgrain::Grain<2>*> grainsOf(const Scene& scene)
    {
        std::vector<softgrain::Grain<2>*> grains;
        for (const auto& body : *scene.bodies)
            if (SoftState* state = softStateOf(*body)) {
                state->prepare(*body);
                grains.push_back(&state->grain);
            }
        return grains;
    }

    /// Time in which no surface point passes more than this share of a cell [s].
    Real stepBySpeed(const std::vector<softgrain::Grain<2>*>& grains)
    {
        constexpr Real share = 0.04;
        Real least = 1e300;
        for (const auto* grain : grains)
            least = std::min(least, share * grain->mesh->cell_width * grain->radius / grain->surface.speed);
        return least;
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
    const auto grains = grainsOf(*scene);
    if (std::isnan(limit)) {
        if (grains.empty()) return;
        limit = softgrain::SmallestCriticalStep<2>()(grains, omp_get_max_threads());
    }
    if (std::isinf(limit))
        throw std::runtime_error(
            "SoftTimeStepper: no soft grain says how long a step may be; set O.dt, as by softEngines(dt=...), "
            "and take SoftTimeStepper out of O.engines.");
    constexpr Real most = 0.3, kept = 0.9;
    const Real change = lastLimit > 0 ? std::min(std::abs(std::log(limit / lastLimit)), most) : 0;
    unrest = std::max(change, kept * unrest);
    lastLimit = limit;
    constexpr Real least = 0.1; // what flies as fast as that is for a guard to stop
    scene->dt = std::min(stepAt(limit), std::max(stepBySpeed(grains), least * limit));
}

/// Symplectic Euler is stable below omega dt = 2, but modes at sqrt(2) and sqrt(3) resonate with their own nonlinearity (Schlick,
/// Mandziuk, Skeel and Srinivas 1998). In calm motion nothing comes of it: limits change by less than 2 % in compactions.
Real SoftTimeStepper::stepAt(Real limit) const
{
    constexpr Real calm = 0.03, wild = 0.1, below_resonances = 0.6;
    const Real wildness = std::clamp((unrest - calm) / (wild - calm), 0.0, 1.0);
    return limit * (safety + wildness * std::min(below_resonances - safety, 0.0));
}

} // namespace yade
