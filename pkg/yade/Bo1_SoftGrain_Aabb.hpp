// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

class Bo1_SoftGrain_Aabb : public BoundFunctor {
public:
    void go(const shared_ptr<Shape>& shape, shared_ptr<Bound>& bound, const Se3r& se3, const Body* body) override;

    FUNCTOR1D(SoftGrain);
    YADE_CLASS_BASE_DOC(
            Bo1_SoftGrain_Aabb,
            BoundFunctor,
            "Bounding box of a :yref:`SoftGrain` as deformed, as thick across the plane as the grain's radius.");
};
REGISTER_SERIALIZABLE(Bo1_SoftGrain_Aabb);

} // namespace yade
