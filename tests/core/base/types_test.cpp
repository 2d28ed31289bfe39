// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/types.hpp"

#include <gtest/gtest.h>

using namespace softgrain;

namespace {

TEST(Shown, GivesSixSignificantDigits)
{
    EXPECT_EQ(shown(0.1), "0.1");
    EXPECT_EQ(shown(1234567), "1.23457e+06");
    EXPECT_EQ(shown(-0.333333333), "-0.333333");
}

TEST(Power, CountsStencilsAndCorners)
{
    EXPECT_EQ(power(3, 2), 9);
    EXPECT_EQ(power(2, 3), 8);
    EXPECT_EQ(power(7, 0), 1);
}

TEST(Errors, TellUserMistakesFromFailedRuns)
{
    EXPECT_THROW(throw UserError("x"), std::invalid_argument);
    EXPECT_THROW(throw SimulationError("x"), std::runtime_error);
}

} // namespace
