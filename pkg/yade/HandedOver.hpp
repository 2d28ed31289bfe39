// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Omega.hpp>

#include <iterator>
#include <omp.h>
#include <vector>

namespace yade {

/// What a Law2 functor, called by several threads, hands over to the integrator in a step.
template <class Pair> class HandedOver {
public:
    HandedOver()
        : byThread_(size_t(std::max(omp_get_max_threads(), omp_get_num_procs())))
    {
    }
    void take(long step, Pair&& pair)
    {
        Handed& mine = byThread_[size_t(omp_get_thread_num())];
        if (mine.step != step) mine.pairs.clear();
        mine.step = step;
        mine.pairs.push_back(std::move(pair));
    }
    /// Moves the pairs of a step to the end of `pairs`, in no certain order.
    void to(long step, std::vector<Pair>& pairs)
    {
        for (Handed& handed : byThread_) {
            if (handed.step != step) continue;
            std::move(handed.pairs.begin(), handed.pairs.end(), std::back_inserter(pairs));
            handed.pairs.clear();
        }
    }

private:
    struct Handed {
        long step = -1;
        std::vector<Pair> pairs;
    };
    std::vector<Handed> byThread_;
};

} // namespace yade
