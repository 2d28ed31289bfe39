// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Scene.hpp>

namespace yade {

// Runs at intervals of simulated time [s], wall-clock time [s] or steps; an interval <= 0 is off.
class PeriodicEngine : public GlobalEngine {
public:
    Real virtPeriod;
    Real realPeriod;
    long iterPeriod;
    long nDo; // at most so many runs, negative: no limit
    bool initRun;
    long firstIterRun;
    Real virtLast;
    Real realLast;
    long iterLast;
    long nDone;

    PeriodicEngine();
    YADE_ABI_STOCK(PeriodicEngine)
    bool isActivated() override;
};
YADE_ABI_STOCK_END(PeriodicEngine, 184)

} // namespace yade
