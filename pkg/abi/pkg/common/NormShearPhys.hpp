// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/IPhys.hpp>

namespace yade {

// Forces act on body 2, world frame [N].
class NormPhys : public IPhys {
public:
    Real kn;
    Vector3r normalForce;

    NormPhys();
    YADE_ABI_STOCK(NormPhys)
    YADE_ABI_STOCK_INDEX(NormPhys)
};
YADE_ABI_STOCK_END(NormPhys, 64)

class NormShearPhys : public NormPhys {
public:
    Real ks;
    Vector3r shearForce;

    NormShearPhys();
    YADE_ABI_STOCK(NormShearPhys)
    YADE_ABI_STOCK_INDEX(NormShearPhys)
};
YADE_ABI_STOCK_END(NormShearPhys, 96)

} // namespace yade
