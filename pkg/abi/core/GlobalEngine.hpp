// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Engine.hpp>

namespace yade {

class GlobalEngine : public Engine {
public:
    GlobalEngine() { }
    YADE_ABI_STOCK(GlobalEngine)
};
YADE_ABI_STOCK_END(GlobalEngine, 104)

} // namespace yade
