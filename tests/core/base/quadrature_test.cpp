// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/quadrature.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace softgrain;

namespace {

double integral(int degree)
{
    double sum = 0;
    for (const auto& [x, weight] : gauss_legendre_16())
        sum += weight * std::pow(x, degree);
    return sum;
}

// n points integrate polynomials up to degree 2 n - 1 exactly: int_-1^1 x^k dx = 2 / (k + 1) for even k, 0 for odd k.
TEST(GaussLegendre16, IsExactToDegree31)
{
    for (int k = 0; k <= 31; ++k)
        EXPECT_NEAR(integral(k), k % 2 ? 0 : 2.0 / (k + 1), 16 * 0x1p-53) << "degree " << k;
}

// Error term for x^32 (Abramowitz and Stegun 1964, 25.4.29): 2^33 (16!)^4 / (33 (32!)^2).
TEST(GaussLegendre16, MissesDegree32ByItsErrorTerm)
{
    const double error = std::exp(33 * std::log(2.0) + 4 * std::lgamma(17.0) - std::log(33.0) - 2 * std::lgamma(33.0));
    EXPECT_NEAR((2.0 / 33 - integral(32)) / error, 1, 1e-5);
}

TEST(GaussLegendre16, StandsInsideTheIntervalWithPositiveWeights)
{
    for (const auto& [x, weight] : gauss_legendre_16()) {
        EXPECT_LT(std::abs(x), 1);
        EXPECT_GT(weight, 0);
    }
}

} // namespace
