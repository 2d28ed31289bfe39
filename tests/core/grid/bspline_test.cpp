// SPDX-License-Identifier: GPL-2.0-or-later
#include "grid/bspline.hpp"
#include "support/finite_difference.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using softgrain::testing_support::central_gradient;

namespace {

constexpr double round_off = 1e-15;

// With nodes in the middles of the cells (Greville abscissae -1, 0, 1 from the middle of the home cell):
//     sum N_i = 1,  sum N_i x_i = x,  sum N_i x_i^2 = x^2 + 1/4   (de Boor 1978, Marsden's identity).
TEST(QuadraticBSpline, ReproducesConstantsAndLinesAndShiftsParabolas)
{
    for (double x = -0.5; x <= 0.5; x += 1.0 / 64) {
        const QuadraticBSpline spline(x);
        double sum = 0, first = 0, second = 0, slope = 0, first_slope = 0;
        for (int i = 0; i < 3; ++i) {
            sum += spline.value[i];
            first += spline.value[i] * (i - 1);
            second += spline.value[i] * (i - 1) * (i - 1);
            slope += spline.slope[i];
            first_slope += spline.slope[i] * (i - 1);
            EXPECT_GE(spline.value[i], 0);
        }
        EXPECT_NEAR(sum, 1, round_off);
        EXPECT_NEAR(first, x, round_off);
        EXPECT_NEAR(second, x * x + 0.25, round_off);
        EXPECT_NEAR(slope, 0, round_off);
        EXPECT_NEAR(first_slope, 1, round_off);
    }
}

TEST(QuadraticBSpline, SlopesAreDerivatives)
{
    for (double x = -0.45; x <= 0.45; x += 0.05)
        for (int i = 0; i < 3; ++i) {
            const auto value = [i](const std::vector<double>& at) { return QuadraticBSpline(at[0]).value[i]; };
            EXPECT_NEAR(central_gradient(value, { x }, 0.01)[0], QuadraticBSpline(x).slope[i], 1e-13); // eps / h
        }
}

// Knots at the cell's ends: value and slope pass on to the next cell without a jump, and the first of the three
// splines of a cell ends there.
TEST(QuadraticBSpline, IsSmoothAcrossCells)
{
    const QuadraticBSpline left(0.5), right(-0.5);
    for (int i = 0; i < 2; ++i) {
        EXPECT_NEAR(left.value[i + 1], right.value[i], round_off);
        EXPECT_NEAR(left.slope[i + 1], right.slope[i], round_off);
    }
    EXPECT_EQ(left.value[0], 0);
    EXPECT_EQ(left.slope[0], 0);
    EXPECT_EQ(right.value[2], 0);
    EXPECT_EQ(right.slope[2], 0);
}

} // namespace
