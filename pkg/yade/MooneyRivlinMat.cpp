// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftMat.hpp"

namespace yade {

class MooneyRivlinMat : public SoftMat {
public:
    std::string lawName() const override { return "Mooney-Rivlin"; }
    std::array<double, softgrain::max_parameters> lawParameters() const override { return { c1, c2, c }; }

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            MooneyRivlinMat,
            SoftMat,
            "Compressible Mooney-Rivlin solid (Vu et al. 2017, eq. 8): S = 2 (c1 + c2 tr C) I - 2 c2 C + [2 c J (J - 1) - d] C⁻¹ with d = 2 "
            "(c1 + 2 c2) and tr C = C11 + C22 + 1. Small strains: μ = 2 (c1 + c2), λ = 2 c + 4 c2.",
            ((Real, c1, 0.63e6, , "Coefficient of the first invariant [Pa]."))((Real, c2, -0.0012e6, , "Coefficient of the second invariant [Pa]."))(
                    (Real, c, 6e6, , "Coefficient of the volumetric energy c (J - 1)² [Pa].")),
            );
};
REGISTER_SERIALIZABLE(MooneyRivlinMat);
YADE_PLUGIN((MooneyRivlinMat));

} // namespace yade
