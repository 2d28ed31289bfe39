// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/MatchMaker.hpp>
#include <pkg/common/NormShearPhys.hpp>

namespace yade {

class FrictPhys : public NormShearPhys {
public:
    Real tangensOfFrictionAngle;

    FrictPhys();
    YADE_ABI_STOCK(FrictPhys)
    YADE_ABI_STOCK_INDEX(FrictPhys)
};
YADE_ABI_STOCK_END(FrictPhys, 104)

} // namespace yade
