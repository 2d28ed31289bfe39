// SPDX-License-Identifier: GPL-2.0-or-later
// The updated-Lagrangian form of a disc squeezed between rigid plates against finite elements, as in plates_test.cpp.
#include "plates.hpp"
#include "reference.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

// Points that move through the cells are no longer Gauss points of them, and nodes become slaves and masters again on the
// way. From 10 % squeeze on, the contact is wider than two cells.
TEST(UpdatedFormBetweenPlates, ForceAgreesWithFiniteElements)
{
    for (const auto& [material, file] :
         { std::pair { neo_hookean(), "A_plates_NH.csv" }, std::pair { mooney_rivlin(), "A_plates_MR.csv" } }) {
        const Table table(file);
        for (double angle : { 0.0, 0.9, 2.3, 4.1 }) {
            SqueezeCase c;
            c.material = material;
            c.updated = true;
            c.angle = angle;
            c.speed = 0.2;
            const Squeeze run = squeeze(c);
            double worst = 0, rms = 0, area = 0;
            int count = 0;
            for (const auto& window : run.windows) {
                if (window.squeeze < 0.1) continue;
                const double error = window.force / table.at("squeeze", window.squeeze, "F_N_per_m") - 1;
                worst = std::max(worst, std::abs(error));
                rms += error * error;
                area = std::max(area, std::abs(window.area_ratio - table.at("squeeze", window.squeeze_at_end, "A_over_A0")));
                ++count;
            }
            rms = std::sqrt(rms / count);
            std::printf("%s, angle %.1f: force rms %.2f %%, worst %.2f %% from 10 to 40 %% squeeze; A/A0 within %.1e; J >= "
                        "%.2f; deepest "
                        "%.1e R; energy %+.1e; %d steps\n",
                        material.law, angle, 100 * rms, 100 * worst, area, run.min_J, -run.deepest / 1e-3, run.residual,
                        run.steps);
            EXPECT_LE(worst, 0.03) << material.law << ", angle " << angle;
            EXPECT_LE(rms, 0.01) << material.law << ", angle " << angle;
            EXPECT_LE(area, 2e-3) << material.law << ", angle " << angle;
            EXPECT_LE(std::abs(run.residual), 2e-3) << material.law << ", angle " << angle;
        }
    }
}

// Beyond what the references tell, to where grids are laid anew: the total form is the reference.
TEST(UpdatedFormBetweenPlates, ForceAgreesWithTheTotalFormWhereGridsAreLaidAnew)
{
    for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
        SqueezeCase c;
        c.material = material;
        c.angle = 0.9;
        c.speed = 0.5;
        c.until = 0.7;
        const Squeeze total = squeeze(c);
        c.updated = true;
        const Squeeze moved = squeeze(c);
        double worst = 0;
        for (size_t k = 0; k < total.windows.size(); ++k)
            if (total.windows[k].squeeze > 0.4)
                worst = std::max(worst, std::abs(moved.windows[k].force / total.windows[k].force - 1));
        std::printf("%s: force within %.2f %% of the total form's from 40 to 70 %% squeeze; energy %+.1e; %d new grids\n",
                    material.law, 100 * worst, moved.residual, moved.new_grids);
        EXPECT_GE(moved.new_grids, 1) << material.law;
        EXPECT_LE(worst, 0.03) << material.law;
        EXPECT_LE(std::abs(moved.residual), 2e-3) << material.law;
    }
}

} // namespace
