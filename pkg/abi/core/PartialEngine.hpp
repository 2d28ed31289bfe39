// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Body.hpp>
#include <core/Engine.hpp>

namespace yade {

class PartialEngine : public Engine {
public:
    vector<int> ids; // of the bodies it acts on

    PartialEngine() { }
    YADE_ABI_STOCK(PartialEngine)
};
YADE_ABI_STOCK_END(PartialEngine, 128)

} // namespace yade
