// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <chrono>
#include <vector>

namespace yade {

/// Adds the time since the last call to a stage.
class Stopwatch {
public:
    explicit Stopwatch(std::vector<Real>& stages)
        : stages_(stages)
        , last_(Clock::now())
    {
    }
    void stage(int index)
    {
        const auto now = Clock::now();
        stages_[index] += std::chrono::duration<Real>(now - last_).count();
        last_ = now;
    }

private:
    using Clock = std::chrono::steady_clock;
    std::vector<Real>& stages_;
    Clock::time_point last_;
};

} // namespace yade
