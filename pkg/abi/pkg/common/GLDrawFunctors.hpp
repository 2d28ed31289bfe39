// SPDX-License-Identifier: GPL-2.0-or-later
// Functors that draw in YADE's 3D view.
//
//   GlShapeFunctor   Gl1_...    go(shape, state, wire, view); OpenGL is in the frame of the body, and names are those of bodies
#pragma once

#include <core/Functor.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>

namespace yade {

struct GLViewInfo {
    Vector3r sceneCenter;
    Real sceneRadius;
};
static_assert(sizeof(GLViewInfo) == 32, "YADE 2023.02a: size of GLViewInfo");

class GlShapeFunctor
    : public Functor1D<Shape, void,
                       boost::mpl::vector<const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&>> {
public:
    GlShapeFunctor() { }
    YADE_ABI_STOCK(GlShapeFunctor)
    virtual string renders() const;
    virtual void initgl(); // when the view is opened
};
YADE_ABI_STOCK_END(GlShapeFunctor, 88)

} // namespace yade

// In a functor: the class that it draws.
#define RENDERS(Type)                                                                                                       \
public:                                                                                                                     \
    std::string renders() const override { return #Type; }                                                                  \
    FUNCTOR1D(Type)
