// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

namespace yade {

// Array of sums; each thread adds to its own copy, the value is the sum over the threads.
template <typename T> class OpenMPArrayAccumulator {
    int cacheLine;
    size_t nThreads;
    int perCacheLine;
    std::vector<T*> chunks; // by thread
    size_t sz;
    size_t nCacheLines;

public:
    OpenMPArrayAccumulator() = delete;
    size_t size() const { return sz; }
    T get(size_t i) const
    {
        T sum(0);
        for (size_t thread = 0; thread < nThreads; thread++)
            sum += chunks[thread][i];
        return sum;
    }
    void set(size_t i, const T& value)
    {
        for (size_t thread = 0; thread < nThreads; thread++)
            chunks[thread][i] = thread == 0 ? value : T(0);
    }
    T operator[](size_t i) const { return get(i); }
};
static_assert(sizeof(OpenMPArrayAccumulator<Real>) == 64, "YADE 2023.02a: size of OpenMPArrayAccumulator");

} // namespace yade
