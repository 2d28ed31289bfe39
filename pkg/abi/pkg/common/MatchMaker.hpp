// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/serialization/Serializable.hpp>

#include <boost/unordered_map.hpp>

namespace yade {

// A number for a pair of bodies: looked up by their ids, else made of the two values by algo.
class MatchMaker : public Serializable {
    Real (MatchMaker::*fallback)(Real, Real) const;
    bool fallbackNeedsValues;
    boost::unordered_map<std::pair<int, int>, Real> matchSet;

public:
    std::vector<Vector3r> matches; // (id1, id2, number)
    string algo;                   // avg, min, max, harmAvg, val or zero
    Real val;

    MatchMaker();
    YADE_ABI_STOCK(MatchMaker)
    void postLoad(MatchMaker&);
    Real operator()(int id1, int id2, Real value1 = NaN, Real value2 = NaN) const;
    Real computeFallback(Real value1, Real value2) const;
};
YADE_ABI_STOCK_END(MatchMaker, 160)

} // namespace yade
