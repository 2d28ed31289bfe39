// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/IGeom.hpp>

namespace yade {

// Of two round bodies; normal from body 1 to body 2.
class GenericSpheresContact : public IGeom {
public:
    Vector3r normal = Vector3r::Zero(), contactPoint = Vector3r::Zero();
    Real refR1 = 0, refR2 = 0;

    GenericSpheresContact() { createIndex(); }
    YADE_ABI_STOCK(GenericSpheresContact)
    YADE_ABI_STOCK_INDEX(GenericSpheresContact)
};
YADE_ABI_STOCK_END(GenericSpheresContact, 96)

class ScGeom : public GenericSpheresContact {
private:
    Vector3r twist_axis, orthonormal_axis;

public:
    Real &radius1, &radius2;
    Real penetrationDepth;
    Vector3r shearInc;

    ScGeom();
    YADE_ABI_STOCK(ScGeom)
    YADE_ABI_STOCK_INDEX(ScGeom)
};
YADE_ABI_STOCK_END(ScGeom, 192)

} // namespace yade
