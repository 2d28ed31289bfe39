// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/implicit_step.hpp"

namespace softgrain {

/// Takes steps of the implicit scheme in as many substeps as they need: one that fails or creates energy is halved, and after
/// one that went well the next is longer again. Energy is let be where no shorter substep converges.
template <int Dim> class ImplicitRun {
public:
    explicit ImplicitRun(Assembly<Dim>& assembly)
        : step(assembly)
    {
    }

    ImplicitStep<Dim> step;
    /// Of the last step; iterations since the start.
    struct Report {
        int substeps = 0, cuts = 0, iterations = 0;
        double residual = 0, distance = 0, penetration = 0; ///< the worst of the substeps, see ImplicitStep::Outcome
        double held = 0;                                    ///< of the last substep
        double dissipated = 0;                              ///< by the scheme [J]
    };
    Report report;
    double substep = 0; ///< to be tried next [s]; 0: the whole step

    /// Calls accepted(length, outcome) after every substep: it takes contact forces from `step`, and renews the assembly.
    /// Throws SimulationError when neither the step nor any part of it down to a millionth can be taken.
    using Accepted = std::function<void(double, const typename ImplicitStep<Dim>::Outcome&)>;
    void advance(double dt, const ImplicitSettings& settings, const Vec<Dim>& gravity, ImplicitScene<Dim>& scene,
                 const Accepted& accepted);
};

extern template class ImplicitRun<2>;

} // namespace softgrain
