// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Bound.hpp>

namespace yade {

class Aabb : public Bound {
public:
    Aabb();
    YADE_ABI_STOCK(Aabb)
    YADE_ABI_STOCK_INDEX(Aabb)
};
YADE_ABI_STOCK_END(Aabb, 144)

} // namespace yade
