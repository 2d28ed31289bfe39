// SPDX-License-Identifier: GPL-2.0-or-later
// Engines, the items of O.engines.
//
//   Engine
//     GlobalEngine     TimeStepper, PeriodicEngine, InteractionLoop
//     PartialEngine
//     Dispatcher       BoundDispatcher, IGeomDispatcher, IPhysDispatcher, LawDispatcher
#pragma once

#include <core/Omega.hpp>
#include <core/Timing.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Engine : public Serializable {
public:
    Scene* scene; // set before every step
    TimingInfo timingInfo;
    shared_ptr<TimingDeltas> timingDeltas;
    bool dead;
    int ompThreads;
    string label;

    Engine();
    YADE_ABI_STOCK(Engine)
    virtual bool isActivated();
    virtual void action();
};
YADE_ABI_STOCK_END(Engine, 104)

} // namespace yade
