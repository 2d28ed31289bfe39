// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Shape.hpp>

namespace yade {

class Sphere : public Shape {
public:
    Real radius; // [m]

    Sphere();
    Sphere(Real r)
        : radius(r)
    {
        createIndex();
    }
    YADE_ABI_STOCK(Sphere)
    YADE_ABI_STOCK_INDEX(Sphere)
};
YADE_ABI_STOCK_END(Sphere, 104)

} // namespace yade
