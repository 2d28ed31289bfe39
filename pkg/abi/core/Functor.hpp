// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Timing.hpp>
#include <lib/multimethods/FunctorWrapper.hpp>
#include <lib/serialization/Serializable.hpp>

namespace yade {

class Scene;

// Called by a dispatcher for arguments of the classes that it names.
class Functor : public Serializable {
public:
    shared_ptr<TimingDeltas> timingDeltas;
    Scene* scene; // set by the dispatcher before each loop
    string label;

    Functor() { }
    YADE_ABI_STOCK(Functor)
    virtual vector<string> getFunctorTypes() const;
};
YADE_ABI_STOCK_END(Functor, 80)

template <class Type1, class Result, class Arguments>
class Functor1D : public Functor, public FunctorWrapper<Result, Arguments> {
public:
    using DispatchType1 = Type1;
    using ReturnType = Result;
    using ArgumentTypes = Arguments;
    virtual string get1DFunctorType1() const;
    vector<string> getFunctorTypes() const override;
};

template <class Type1, class Type2, class Result, class Arguments>
class Functor2D : public Functor, public FunctorWrapper<Result, Arguments> {
public:
    using DispatchType1 = Type1;
    using DispatchType2 = Type2;
    using ReturnType = Result;
    using ArgumentTypes = Arguments;
    virtual string get2DFunctorType1() const;
    virtual string get2DFunctorType2() const;
    vector<string> getFunctorTypes() const override;
};

} // namespace yade

// In a functor: the classes it takes.
#define FUNCTOR1D(Type1)                                                                                                    \
public:                                                                                                                     \
    std::string get1DFunctorType1() const override { return #Type1; }
#define FUNCTOR2D(Type1, Type2)                                                                                             \
public:                                                                                                                     \
    std::string get2DFunctorType1() const override { return #Type1; }                                                       \
    std::string get2DFunctorType2() const override { return #Type2; }
