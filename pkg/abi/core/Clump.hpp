// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/PartialEngine.hpp>

namespace yade {

// Rigid aggregate of bodies.
class Clump : public Shape {
public:
    using MemberMap = std::map<Body::id_t, Se3r>;
    MemberMap members; // placements in the clump's frame
    vector<int> ids;

    Clump() { createIndex(); }
    YADE_ABI_STOCK(Clump)
    YADE_ABI_STOCK_INDEX(Clump)
};
YADE_ABI_STOCK_END(Clump, 168)

} // namespace yade
