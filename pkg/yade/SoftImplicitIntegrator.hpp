// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "SoftImplicitScene.hpp"
#include "SoftIntegrator.hpp"

#include "step/implicit_run.hpp"

namespace yade {

class SoftImplicitIntegrator : public SoftIntegrator {
public:
    Real kineticEnergy() override { return quasistatic ? 0 : SoftIntegrator::kineticEnergy(); }
    Real residual() const override { return run_ ? run_->report.residual : 0; }
    boost::python::tuple contactProblem() const override;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR_PY(
            SoftImplicitIntegrator,
            SoftIntegrator,
            "Advances all soft grains by one step of any length: theta scheme with Newton's method, contacts by an interior-point method under "
            "the same law as :yref:`SoftIntegrator`'s, or without inertia from one equilibrium to the next. O.dt is the largest step; where one "
            "fails, the engine cuts it into substeps. iterations and totalIterations count iterations of Newton's method; recovery, maxSweeps "
            "and checkInterval are of no use here.",
            ((Real, theta, 1, , "Weight of the end of a step, from 1/2 (order 2, dissipates at contacts alone, cuts long steps) to 1 (order 1, dissipates) [-]."))(
                    (bool, quasistatic, false, , "No inertia: steps go from one equilibrium to the next."))(
                    (Real,
                     regularisation,
                     0.02,
                     ,
                     "Quasi-static: stiffness per area that holds grains while an equilibrium is sought [shear modulus]. It fades where there is one."))(
                    (Real, hold, 1, , "Quasi-static: share of regularisation that the next step begins with; steps choose it [-]."))(
                    (int, maxIterations, 60, , "Most iterations of Newton's method until a step is cut [-]."))(
                    (Real, substep, 0, , "Length of the substep to be tried next [s]; 0: O.dt."))(
                    (int, substeps, 0, Attr::readonly, "Substeps of the last step [-]."))(
                    (int, cuts, 0, Attr::readonly, "Times that a substep failed and was cut in the last step [-]."))(
                    (long, totalSubsteps, 0, Attr::readonly, "Substeps since the start [-]."))(
                    (long, totalCuts, 0, Attr::readonly, "Cuts since the start [-]."))(
                    (Real,
                     contactDistance,
                     0,
                     Attr::readonly,
                     "Mean gap of contacts in the last step, weighted by their forces [radius of the smaller body]: how far from each other touching "
                     "bodies are kept."))(
                    (Real, imbalance, 0, Attr::readonly, "Quasi-static: forces that still hold the grains after the last step, over contact forces [-]."))(
                    (Real, numericalDissipation, 0, Attr::readonly, "Energy dissipated by the scheme since the start [J/m].")),
            , );

protected:
    Real lookAhead() const override { return 1.5 * softgrain::ImplicitStep<2>::ahead; }
    Real velocitiesBehind() const override { return 0; }
    bool mayFly() const override { return false; }
    void assembled() override;
    void advance(double dt) override;
    void requireSaneAttributes() const override;
    void requireStableStep() override { }
    void trackEnergies() override;

private:
    void search();
    bool wallsAhead() const;
    void refuseUnknownGrains() const;
    void refuseUnknownPairs();
    void take(double dt, double whole, const softgrain::ImplicitStep<2>::Outcome& outcome);

    std::unique_ptr<softgrain::ImplicitRun<2>> run_;
    SoftImplicitScene seen_ { soft_, pairs_ };
    int numericalId_ = -1;
};
REGISTER_SERIALIZABLE(SoftImplicitIntegrator);

} // namespace yade
