// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <pkg/common/ElastMat.hpp>

#include "step/grain.hpp"

#include <array>

namespace yade {

// Base of NeoHookeanMat and its like, each a file of its own. They share the class index of SoftMat, so that YADE dispatches on
// SoftMat and a new material needs no new functor.
class SoftMat : public FrictMat {
public:
    /// Name of the law in the core; the parameters go in the order that the law names them.
    virtual std::string lawName() const;
    virtual std::array<double, softgrain::max_parameters> lawParameters() const;
    /// The law, once the density and the parameters are found sound. Throws softgrain::UserError.
    const softgrain::LawKernels<2>& law() const;

    shared_ptr<State> newAssocState() const override;
    bool stateTypeOk(State* state) const override;

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            SoftMat,
            FrictMat,
            "Base of the materials of soft grains: plane strain. :yref:`density<Material.density>` [kg/m³] is that of the "
            "undeformed grain; :yref:`frictionAngle<FrictMat.frictionAngle>` [rad] gives Coulomb's coefficient tan(angle) of a contact, the "
            "smaller of the two bodies' angles counting, as YADE does. Moduli, density and viscosity can be changed at any time; a changed angle counts "
            "for contacts that come after, as in YADE, and SoftPhys.tangensOfFrictionAngle is that of a contact there is. young and poisson are not used.",
            ((Real, viscosity, 0, , "Shear viscosity η of the solid [Pa·s] (Kelvin-Voigt): beside the elastic stress acts 2 η (D - tr D/3 1), D the rate of deformation in space; no stress by rigid motion or change of volume. 0: none, and no cost.")),
            createIndex(); density = 1000; frictionAngle = 0;);
    REGISTER_CLASS_INDEX(SoftMat, FrictMat);
};
REGISTER_SERIALIZABLE(SoftMat);

} // namespace yade
