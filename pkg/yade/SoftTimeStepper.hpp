// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/TimeStepper.hpp>

namespace yade {

class SoftTimeStepper : public TimeStepper {
public:
    void computeTimeStep(Scene* scene) override;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftTimeStepper,
            TimeStepper,
            "Keeps O.dt at safety times SoftIntegrator.criticalStep, the largest stable step of the soft grains: 2/ω of their stiffest mode as they "
            "are deformed.",
            ((Real, safety, 0.8, , "Fraction of the stable step [-]; beyond 0.9 steps may turn unstable as grains deform.")),
            timeStepUpdateInterval = 50;);
};
REGISTER_SERIALIZABLE(SoftTimeStepper);

} // namespace yade
