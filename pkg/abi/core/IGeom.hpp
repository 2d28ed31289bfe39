// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatcher.hpp>

namespace yade {

// Geometry of an interaction.
class IGeom : public Serializable, public Indexable {
public:
    IGeom() { }
    YADE_ABI_STOCK(IGeom)
    YADE_ABI_STOCK_INDEX_HEAD(IGeom)
};
YADE_ABI_STOCK_END(IGeom, 32)

} // namespace yade
