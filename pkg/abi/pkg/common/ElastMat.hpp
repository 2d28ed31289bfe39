// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Material.hpp>

namespace yade {

class ElastMat : public Material {
public:
    Real young = 1e9; // [Pa]
    Real poisson = .25;

    ElastMat() { createIndex(); }
    YADE_ABI_STOCK(ElastMat)
    YADE_ABI_STOCK_INDEX(ElastMat)
};
YADE_ABI_STOCK_END(ElastMat, 96)

class FrictMat : public ElastMat {
public:
    Real frictionAngle; // [rad]

    FrictMat();
    YADE_ABI_STOCK(FrictMat)
    YADE_ABI_STOCK_INDEX(FrictMat)
};
YADE_ABI_STOCK_END(FrictMat, 104)

} // namespace yade
