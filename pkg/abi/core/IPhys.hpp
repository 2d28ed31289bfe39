// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatcher.hpp>

namespace yade {

// Physics of an interaction. Derived: NormPhys, NormShearPhys, FrictPhys.
class IPhys : public Serializable, public Indexable {
public:
    IPhys() { }
    YADE_ABI_STOCK(IPhys)
    YADE_ABI_STOCK_INDEX_HEAD(IPhys)
};
YADE_ABI_STOCK_END(IPhys, 32)

} // namespace yade
