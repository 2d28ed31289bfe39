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
    for (double rest = dt; rest > 0;) {
        const double wished = substep > 0 ? substep : dt;
        const double h = rest / std::ceil(rest / wished - 1e-9); // no crumb at the end
        const auto outcome = step.attempt(h, settings, gravity, scene);
        report.iterations += outcome.iterations;
        // for theta = 1 the scheme is stable by what it dissipates
        const bool conserving = !settings.quasistatic && settings.theta < 1;
        const double missing = conserving ? outcome.missing_energy / most_missing : 0;
        if (!outcome.converged || (missing > 1 && h > shortest_for_energy * dt)) {
            if (outcome.converged) step.undo();
            ++report.cuts;
            substep = h / 2;
            if (substep < smallest * dt)
                throw SimulationError("the implicit step cannot go on: " + outcome.trouble + " even in a step of " + shown(h)
                                      + " s.");
            continue;
        }
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
