// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <core/Dispatching.hpp>

#include "SoftGrain.hpp"

namespace yade {

// Contact geometry of soft grains.
//
//   SoftIGeomFunctor                        what they share
//     Ig2_SoftGrain_SoftGrain_SoftGeom
//     Ig2_Wall_SoftGrain_SoftGeom
//     Ig2_Box_SoftGrain_SoftGeom
class SoftIGeomFunctor : public IGeomFunctor {
public:
    /// Refuses scenes that no SoftIntegrator advances; raises what functors noted.
    void preStep() override;

    YADE_CLASS_BASE_DOC(SoftIGeomFunctor, IGeomFunctor, "Base of the functors that make :yref:`SoftGeom`.");
};
REGISTER_SERIALIZABLE(SoftIGeomFunctor);

class Ig2_SoftGrain_SoftGrain_SoftGeom : public SoftIGeomFunctor {
public:
    bool
    go(const shared_ptr<Shape>& shape1,
       const shared_ptr<Shape>& shape2,
       const State& state1,
       const State& state2,
       const Vector3r& shift2,
       const bool& force,
       const shared_ptr<Interaction>& interaction) override;

    FUNCTOR2D(SoftGrain, SoftGrain);
    DEFINE_FUNCTOR_ORDER_2D(SoftGrain, SoftGrain);
    YADE_CLASS_BASE_DOC(
            Ig2_SoftGrain_SoftGrain_SoftGeom,
            SoftIGeomFunctor,
            "Contact points of two soft grains: surface points of the smaller against the smoothed outline of the larger, and sharp corners of "
            "the larger against the smaller. Periodic scenes are not supported.");
};
REGISTER_SERIALIZABLE(Ig2_SoftGrain_SoftGrain_SoftGeom);

} // namespace yade
