// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>
#include <core/Scene.hpp>

namespace yade {

// Sets Scene::dt, every timeStepUpdateInterval steps.
class TimeStepper : public GlobalEngine {
public:
    bool active = true;
    unsigned int timeStepUpdateInterval = 1;

    TimeStepper() { }
    YADE_ABI_STOCK(TimeStepper)
    bool isActivated() override;
    void action() override;
    virtual void computeTimeStep(Scene*);
};
YADE_ABI_STOCK_END(TimeStepper, 112)

} // namespace yade
