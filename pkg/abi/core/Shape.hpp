// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatcher.hpp>

namespace yade {

class BoundFunctor;
class InternalForceFunctor;

// Geometry of a body, in its own frame. Derived: Sphere, Box, Wall, Facet, Clump.
class Shape : public Serializable, public Indexable {
public:
    shared_ptr<BoundFunctor> boundFunctor; // cached by BoundDispatcher
    shared_ptr<InternalForceFunctor> internalforcefunctor;
    Vector3r color = Vector3r(1, 1, 1);
    bool wire = false;
    bool highlight = false;

    Shape() { }
    YADE_ABI_STOCK(Shape)
    YADE_ABI_STOCK_INDEX_HEAD(Shape)
};
YADE_ABI_STOCK_END(Shape, 96)

} // namespace yade
