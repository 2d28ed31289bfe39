// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <lib/base/Math.hpp>

#include <boost/mpl/at.hpp>
#include <boost/mpl/vector.hpp>

namespace yade {

// The overloads of go() and goReverse() with the first 1 to 7 of the argument types; a functor overrides the one it needs.
template <class Result, class Arguments> class FunctorWrapper {
    template <int i> using Arg = typename boost::mpl::at_c<Arguments, i>::type;

public:
    FunctorWrapper() { }
    virtual ~FunctorWrapper() { }
    virtual string checkOrder() const;

    virtual Result go(Arg<0>);
    virtual Result go(Arg<0>, Arg<1>);
    virtual Result go(Arg<0>, Arg<1>, Arg<2>);
    virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>);
    virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>);
    virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>);
    virtual Result go(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>, Arg<6>);

    virtual Result goReverse(Arg<0>);
    virtual Result goReverse(Arg<0>, Arg<1>);
    virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>);
    virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>);
    virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>);
    virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>);
    virtual Result goReverse(Arg<0>, Arg<1>, Arg<2>, Arg<3>, Arg<4>, Arg<5>, Arg<6>);
};

} // namespace yade

// In a functor of two unequal shapes: the order in which go() takes them.
#define DEFINE_FUNCTOR_ORDER_2D(First, Second)                                                                              \
public:                                                                                                                     \
    std::string checkOrder() const override { return #First " " #Second; }
