// SPDX-License-Identifier: GPL-2.0-or-later
#include "SoftMat.hpp"

namespace yade {

class OgdenMat : public SoftMat {
public:
    std::string lawName() const override
    {
        const std::string terms[] { "Ogden", "Ogden of two terms", "Ogden of three terms" };
        requireTerms();
        return terms[mu.size() - 1];
    }
    std::array<double, softgrain::max_parameters> lawParameters() const override
    {
        requireTerms();
        std::array<double, softgrain::max_parameters> constants { lambda_ };
        for (size_t k = 0; k < mu.size(); ++k) {
            constants[1 + 2 * k] = mu[k];
            constants[2 + 2 * k] = alpha[k];
        }
        return constants;
    }

    YADE_CLASS_BASE_DOC_ATTRS_CTOR(
            OgdenMat,
            SoftMat,
            "Compressible Ogden solid (Ogden 1972) with one to three terms: W = Σ [μₖ/αₖ (λ₁^αₖ + λ₂^αₖ + λ₃^αₖ - 3) - μₖ ln J] + λ/2 (ln J)², "
            "λ₁, λ₂ and λ₃ = 1 the principal stretches, for gels and rubbers that stiffen in large strains (α > 2). Shear modulus of small strains: "
            "Σ μₖ αₖ / 2, which has to be positive. mu=[μ], alpha=[2] is NeoHookeanMat(mu=μ).",
            ((Real, lambda_, 61e6, , "First Lamé constant λ of the undeformed grain, 0 or more [Pa] (with an underscore: lambda is a word of Python)."))(
                    (vector<Real>, mu, vector<Real>(1, 1.26e6), , "Coefficients μₖ of the terms, one to three [Pa]."))(
                    (vector<Real>, alpha, vector<Real>(1, 2), , "Exponents αₖ of the terms, as many, none of them 0 [-].")),
            );

private:
    void requireTerms() const
    {
        if (mu.empty() || mu.size() > 3 || mu.size() != alpha.size())
            throw softgrain::UserError("OgdenMat" + (label.empty() ? "" : " '" + label + "'") + ": mu has "
                                       + std::to_string(mu.size()) + " numbers and alpha " + std::to_string(alpha.size())
                                       + "; give as many of both, one to three.");
    }
};
REGISTER_SERIALIZABLE(OgdenMat);
YADE_PLUGIN((OgdenMat));

} // namespace yade
