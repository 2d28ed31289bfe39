// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

namespace yade {

// How often something ran, and for how long [ns].
struct TimingInfo {
    using delta = unsigned long long;
    long nExec = 0;
    delta nsec = 0;
    static bool enabled;
};
static_assert(sizeof(TimingInfo) == 16, "YADE 2023.02a: size of TimingInfo");

class TimingDeltas; // made by YADE only when built for it

} // namespace yade
