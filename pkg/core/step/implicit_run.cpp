// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/implicit_run.hpp"

#include <cmath>

namespace softgrain {
namespace {

    constexpr double smallest = 1e-6; // substep [step]
    constexpr int swift = 25;         // iterations after which a substep went well
    constexpr double growth = 1.5;
    constexpr double most_missing = 0.005;       // of the energy that a substep exchanges: more and it is cut,
    constexpr double shortest_for_energy = 1e-3; // unless it is that short [step]

} // namespace

template <int Dim>
void ImplicitRun<Dim>::advance(double dt, const ImplicitSettings& settings, const Vec<Dim>& gravity,
                               ImplicitScene<Dim>& scene, const Accepted& accepted)
{
    report = {};
    double lacking = 0;    // substep that was cut for its energy alone [s]
    bool as_it_is = false; // shorter ones fail: takes any that converges
    for (double rest = dt; rest > 0;) {
        const double wished = substep > 0 ? substep : dt;
        const double h = rest / std::ceil(rest / wished - 1e-9); // no crumb at the end
        const auto outcome = step.attempt(h, settings, gravity, scene);
        report.iterations += outcome.iterations;
        const double missing = settings.quasistatic ? 0 : outcome.missing_energy / most_missing;
        if (!outcome.converged || (missing > 1 && !as_it_is && h > shortest_for_energy * dt)) {
            ++report.cuts;
            substep = h / 2;
            if (outcome.converged) {
                step.undo();
                lacking = h;
            } else if (!as_it_is && (lacking > 0 || substep < smallest * dt)) {
                as_it_is = true;
                substep = lacking > 0 ? lacking : dt;
            }
            if (substep < smallest * dt)
                throw SimulationError("the implicit step cannot go on: " + outcome.trouble + " even in a step of " + shown(h)
                                      + " s.");
            continue;
        }
        lacking = 0;
        as_it_is = false;
        ++report.substeps;
        report.residual = std::max(report.residual, outcome.residual);
        report.distance = std::max(report.distance, outcome.distance);
        report.penetration = std::max(report.penetration, outcome.penetration);
        report.held = outcome.held;
        report.dissipated += outcome.dissipated;
        accepted(h, outcome);
        rest = h >= rest ? 0 : rest - h;
        // from the wish and not from h: of equal parts that are shorter than the wish none would ever become the whole step
        const bool well = outcome.iterations <= swift * outcome.stages && missing < 0.25;
        substep = well ? growth * std::min(wished, dt) : wished;
    }
}

template class ImplicitRun<2>;

} // namespace softgrain
