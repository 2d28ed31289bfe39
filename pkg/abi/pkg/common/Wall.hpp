// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>
#include <core/Shape.hpp>

namespace yade {

// Infinite plane through the body's position, normal to a coordinate axis.
class Wall : public Shape {
public:
    int sense = 0; // side that interacts: -1, +1, or 0 for both
    int axis = 0;  // of the normal: 0, 1, 2

    Wall() { createIndex(); }
    YADE_ABI_STOCK(Wall)
    YADE_ABI_STOCK_INDEX(Wall)
};
YADE_ABI_STOCK_END(Wall, 104)

} // namespace yade
