// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftMat.hpp"

namespace yade {

class NeoHookeanMat : public SoftMat {
public:
    std::string lawName() const override { return "Neo-Hookean"; }
    std::array<double, softgrain::max_parameters> lawParameters() const override { return { lambda_, mu }; }

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            NeoHookeanMat,
            SoftMat,
            "Compressible Neo-Hookean solid (Vu et al. 2017, eq. 7): S = (λ ln J - μ) C⁻¹ + μ I, from W = μ/2 (tr C - 3) - μ ln J + λ/2 "
            "(ln J)². Stable for μ > 0 and λ ≥ 0.",
            ((Real, lambda_, 61e6, , "First Lamé constant λ of the undeformed grain [Pa] (with an underscore: lambda is a word of Python)."))(
                    (Real, mu, 1.26e6, , "Shear modulus μ of the undeformed grain [Pa].")),
            );
};
REGISTER_SERIALIZABLE(NeoHookeanMat);
YADE_PLUGIN((NeoHookeanMat));

} // namespace yade
