// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Box : public Shape {
public:
    Vector3r extents; // half edges [m]

    Box()
        : extents()
    {
        createIndex();
    }
    YADE_ABI_STOCK(Box)
    YADE_ABI_STOCK_INDEX(Box)
};
YADE_ABI_STOCK_END(Box, 120)

} // namespace yade
