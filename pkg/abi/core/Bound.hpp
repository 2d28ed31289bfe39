// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatcher.hpp>

namespace yade {

// Part of space that surely contains a body.
class Bound : public Serializable, public Indexable {
public:
    int lastUpdateIter = 0;
    Vector3r refPos = Vector3r(NaN, NaN, NaN); // of the body at the last update
    Real sweepLength = 0;
    Vector3r color = Vector3r(1, 1, 1);
    Vector3r min = Vector3r(NaN, NaN, NaN);
    Vector3r max = Vector3r(NaN, NaN, NaN);

    Bound() { }
    YADE_ABI_STOCK(Bound)
    YADE_ABI_STOCK_INDEX_HEAD(Bound)
};
YADE_ABI_STOCK_END(Bound, 144)

} // namespace yade
