// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/TimeStepper.hpp>

namespace yade {

class SoftTimeStepper : public TimeStepper {
public:
    void computeTimeStep(Scene* scene) override;
    /// Time step at a stable step of the grains [s].
    Real stepAt(Real limit) const;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftTimeStepper,
            TimeStepper,
            "Keeps O.dt at safety times SoftIntegrator.criticalStep, the largest stable step of the soft grains: 2/ω of their stiffest mode as they "
            "are deformed. Where that limit changes quickly, as in grains that vibrate hard, steps stay below 0.6 of it: their stiffest "
            "modes would draw energy from nowhere. No point of a surface passes more than 0.04 cells in a step, which "
            "shortens those of impacts near the wave speed to 0.1 of the stable step at most.",
            ((Real, safety, 0.8, , "Fraction of the stable step [-]; beyond 0.9 steps may turn unstable as grains deform."))(
                    (Real, lastLimit, NaN, Attr::readonly, "Stable step when O.dt was set last [s]."))(
                    (Real,
                     unrest,
                     0,
                     Attr::readonly,
                     "Largest relative change of the stable step between two times of setting O.dt, a tenth of which is forgotten at each [-].")),
            timeStepUpdateInterval = 50;);
};
REGISTER_SERIALIZABLE(SoftTimeStepper);

} // namespace yade
