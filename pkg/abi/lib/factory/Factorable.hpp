// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/factory/ClassFactory.hpp>

#include <boost/enable_shared_from_this.hpp>

namespace yade {

// Anything that ClassFactory can create.
class Factorable : public boost::enable_shared_from_this<Factorable> {
public:
    Factorable() { }
    virtual ~Factorable();
    virtual string getBaseClassName(unsigned int = 0) const;
    virtual int getBaseClassNumber() const;
    virtual string getClassName() const;
};
static_assert(sizeof(Factorable) == 24, "YADE 2023.02a: size of Factorable");

} // namespace yade

#define REGISTER_CLASS_AND_BASE(K, Base)                                                                                    \
public:                                                                                                                     \
    string getClassName() const override { return #K; }                                                                     \
    string getBaseClassName(unsigned int i = 0) const override { return i == 0 ? #Base : ""; }                              \
    int getBaseClassNumber() const override { return 1; }
