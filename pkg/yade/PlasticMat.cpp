// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftMat.hpp"

namespace yade {

class PlasticMat : public SoftMat {
public:
    std::string lawName() const override { return "plastic"; }
    std::array<double, softgrain::max_parameters> lawParameters() const override
    {
        return { lambda_, mu, yieldStress, hardening };
    }

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            PlasticMat,
            SoftMat,
            "Elastoplastic solid of finite strains: Hencky's elasticity, the yield condition of von Mises with linear isotropic hardening, "
            "plastic flow by the exponential return map (Simo 1992). The Kirchhoff stress τ keeps √(3/2) |dev τ| ≤ yieldStress + hardening a, "
            "with a the plastic strain that has gathered, softgrain.arrays.plasticStrains(body). Total-Lagrangian grains only. A grain that is "
            "given a material of another class forgets its plastic deformation.",
            ((Real, lambda_, 61e6, , "First Lamé constant λ [Pa] (with an underscore: lambda is a word of Python)."))(
                    (Real, mu, 1.26e6, , "Shear modulus μ [Pa]."))(
                    (Real, yieldStress, NaN, , "Yield stress in uniaxial tension, of the solid that has not flowed yet [Pa]; has to be given."))(
                    (Real, hardening, 0, , "Growth of the yield stress with the plastic strain [Pa]; 0: ideally plastic.")),
            );
};
REGISTER_SERIALIZABLE(PlasticMat);
YADE_PLUGIN((PlasticMat));

} // namespace yade
