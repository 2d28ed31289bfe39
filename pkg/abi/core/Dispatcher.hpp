// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Engine.hpp>
#include <core/Functor.hpp>
#include <core/Omega.hpp>
#include <lib/multimethods/Indexable.hpp>

namespace yade {

// Hands each item to the functor made for its class.
class Dispatcher : public Engine {
public:
    Dispatcher() { }
    YADE_ABI_STOCK(Dispatcher)
    virtual string getFunctorType() const;
    virtual int getDimension() const;
    virtual string getBaseClassType(unsigned int) const;
};
YADE_ABI_STOCK_END(Dispatcher, 104)

} // namespace yade
