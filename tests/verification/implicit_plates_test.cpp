// SPDX-License-Identifier: GPL-2.0-or-later
// The quasi-static implicit scheme: a disc squeezed between rigid plates against finite elements (A_plates_*.csv), and on
// to where little is left of it.
#include "plates.hpp"
#include "reference.hpp"
#include "support/implicit_world.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

struct Named {
    Material material;
    const char* file;
};
const std::vector<Named> laws { { neo_hookean(), "A_plates_NH.csv" }, { mooney_rivlin(), "A_plates_MR.csv" } };

struct Plates {
    ImplicitWorld world;
    explicit Plates(const Material& material, bool updated = false, int points = 276,
                    const std::array<double, 3>& placing = {})
    {
        world.settings.quasistatic = true;
        GrainStart start;
        start.updated = updated;
        start.angle = placing[2];
        world.add(make_grain(disc_mesh(points, placing[0], placing[1]), material, start));
        world.planes = { { 1, 1, -1e-3, 0.1 }, { 1, -1, 1e-3, -0.1 } };
    }
    void squeeze(double share) { world.step(share * 1e-3 / 0.1); }
    double force() const { return (world.plane_force[1].y() - world.plane_force[0].y()) / 2; }
};

struct Bounds {
    double rms, worst; ///< of the force
};

void compare(bool updated, double from, const Bounds& bounds)
{
    for (const auto& law : laws) {
        const Table table(law.file);
        Plates plates(law.material, updated);
        double squares = 0, worst = 0;
        int count = 0;
        for (int k = 1; k <= 160; ++k) {
            plates.squeeze(0.0025);
            if (k < from / 0.0025) continue;
            const double error = plates.force() / table.at("squeeze", 0.0025 * k, "F_N_per_m") - 1;
            squares += error * error;
            worst = std::max(worst, std::abs(error));
            ++count;
        }
        std::printf("%s: force rms %.2f %%, worst %.2f %%; %d iterations, %d cuts, residual %.1e, penetration %.1e\n",
                    law.material.law, 100 * std::sqrt(squares / count), 100 * worst, plates.world.iterations,
                    plates.world.cuts, plates.world.worst_residual, plates.world.worst_penetration);
        EXPECT_LE(std::sqrt(squares / count), bounds.rms);
        EXPECT_LE(worst, bounds.worst);
        EXPECT_LE(plates.world.worst_penetration, 1e-4);
    }
}

// Forces at single squeezes, with the ripple of points that come to touch: the bounds of the explicit scheme, which takes
// means over half a per cent, are 0.6 % and 2.2 %.
TEST(QuasiStaticPlates, ForceAgreesWithFiniteElements) { compare(false, 0.05, { 0.007, 0.022 }); }

// The bounds of explicit steps in this form, from the squeeze on that they hold from.
TEST(QuasiStaticPlates, ForceAgreesWithFiniteElementsInTheUpdatedForm) { compare(true, 0.1, { 0.01, 0.03 }); }

// Without the waves of moving plates, which at 2400 points are larger than the error: quadratic splines on a grid that the
// boundary cuts, contact at points have order 2 in the cell width. Single placings scatter, so the order is that of the line
// through the logarithms of rms errors over twelve.
TEST(QuasiStaticPlates, ForceConvergesWithOrder2HoweverPlaced)
{
    constexpr int placings = 12;
    for (const auto& law : laws) {
        const Table table(law.file);
        double x = 0, y = 0, xx = 0, xy = 0, rms = 0;
        std::string found;
        const std::vector<int> resolutions { 276, 556, 1200, 2400 };
        for (int points : resolutions) {
            double sum = 0, worst = 0;
            int count = 0;
            Random random(12);
            for (int k = 0; k < placings; ++k) {
                Plates plates(law.material, false, points, random_placing(random));
                for (int step = 1; step <= 80; ++step) {
                    plates.squeeze(0.005);
                    if (step < 10) continue;
                    const double error = plates.force() / table.at("squeeze", 0.005 * step, "F_N_per_m") - 1;
                    sum += error * error;
                    worst = std::max(worst, std::abs(error));
                    ++count;
                }
            }
            rms = std::sqrt(sum / count);
            found += " " + shown(100 * rms, 2) + " % (" + shown(100 * worst, 2) + " %)";
            if (points == resolutions.front()) {
                EXPECT_LE(rms, 0.008) << law.material.law;
            }
            const double h = std::log(disc_mesh(points)->cell_width), e = std::log(rms);
            x += h;
            y += e;
            xx += h * h;
            xy += h * e;
        }
        const double n = double(resolutions.size()), order = (n * xy - x * y) / (n * xx - x * x);
        std::printf("%s: force rms (worst)%s at 276, 556, 1200, 2400 points: order %.2f\n", law.material.law, found.c_str(),
                    order);
        EXPECT_LE(rms, 0.0007) << law.material.law; // at 2400 points
        EXPECT_GE(order, 2) << law.material.law;
    }
}

struct Worst {
    double squares = 0, worst = 0;
    int count = 0;
    void add(double error)
    {
        squares += error * error;
        worst = std::max(worst, std::abs(error));
        ++count;
    }
    double rms() const { return std::sqrt(squares / count); }
};

/// Undeformed place of a point, turned with the grain [radius]: without friction discs may roll.
Vec<2> turned(const Grain<2>& grain, const Vec<2>& X)
{
    const Mat<2>& F = grain.motion.mean_gradient;
    return turn(std::atan2(F(1, 0) - F(0, 1), F.trace())) * X;
}

/// Where the rim is, over the radius (A_profile_*.csv, good to 1e-5).
Worst rim_error(const Grain<2>& grain, const Table& rim)
{
    Worst error;
    for (int p = 0; p < grain.surface.count; ++p) {
        const Vec<2> X = turned(grain, grain.mesh->surface[size_t(p)].position), x = grain.surface.x(p);
        const double theta = std::atan2(std::abs(X.x()), std::abs(X.y()));
        error.add(
            Vec<2>(std::abs(x.x()) - rim.at("theta_rad", theta, "x_m"), std::abs(x.y()) - rim.at("theta_rad", theta, "y_m"))
                .norm()
            / grain.radius);
    }
    return error;
}

/// Force over the arc of a contact point against the pressure per undeformed length, over its maximum (good to 1 %); points
/// less than two arcs from the edge of the contact carry parts of what lies beyond it, or the reference has jumps.
Worst pressure_error(ImplicitWorld& world, const Table& rim)
{
    Worst error;
    const Grain<2>& grain = world.grains[0];
    const auto &angles = rim["theta_rad"], &pressures = rim["p_nominal_Pa"];
    double edge = 0;
    for (size_t i = 0; i < angles.size(); ++i)
        if (pressures[i] > 0.01 * pressures[0]) edge = angles[i];
    for (const auto& [p, force] : world.forces_of_plane(1, 0)) {
        const auto& point = grain.mesh->surface[size_t(p)];
        const Vec<2> X = turned(grain, point.position);
        const double theta = std::atan2(std::abs(X.x()), std::abs(X.y()));
        if (theta > edge - 2 * point.weight) continue;
        error.add((force.norm() / (grain.radius * point.weight) - rim.at("theta_rad", theta, "p_nominal_Pa"))
                  / pressures[0]);
    }
    return error;
}

/// Cauchy stress of material points within half a cell of an axis, where it is even across it, up to 0.9 radii, over its
/// largest entry (A_stress_*.csv, good to 0.2 % there).
Worst stress_error(const Grain<2>& grain, const Table& stresses)
{
    Worst error;
    const auto found = grain.cauchy_stresses();
    double largest = 0;
    for (const char* entry : { "s11_Pa", "s22_Pa" })
        for (size_t i = 0; i < stresses[entry].size(); ++i)
            if (stresses["Xref_m"][i] < 0.9 * grain.radius) largest = std::max(largest, std::abs(stresses[entry][i]));
    for (int axis : { 0, 1 }) {
        const Table along = stresses.where("axis", axis);
        for (size_t p = 0; p < found.size(); ++p) {
            const Vec<2> X = turned(grain, grain.mesh->point_position[p]);
            const double place = std::abs(X[axis]);
            if (std::abs(X[1 - axis]) > grain.mesh->cell_width / 2 || place > 0.9) continue;
            const auto at = [&](const char* entry) { return along.at("Xref_m", place * grain.radius, entry); };
            error.add((found[p](0, 0) - at("s11_Pa")) / largest);
            error.add((found[p](1, 1) - at("s22_Pa")) / largest);
            error.add((found[p](2, 2) - at("s33_Pa")) / largest);
        }
    }
    return error;
}

TEST(QuasiStaticPlates, RimPressureAndStressAgreeWithFiniteElements)
{
    struct Bounds {
        int points;
        double rim_rms, rim_worst, pressure_rms, stress_rms;
    };
    for (const auto& law : laws)
        for (const Bounds& bounds : { Bounds { 276, 1e-2, 2e-2, 0.05, 0.06 }, Bounds { 2400, 1e-3, 4e-3, 0.025, 0.02 } }) {
            const std::string name = std::string(law.file).substr(9);
            const Table rims("A_profile_" + name), stresses("A_stress_" + name);
            Plates plates(law.material, false, bounds.points);
            Grain<2>& grain = plates.world.grains[0];
            for (int step = 1; step <= 80; ++step) {
                plates.squeeze(0.005);
                if (step != 20 && step != 40 && step != 60 && step != 80) continue;
                grain.pull();
                const Table rim = rims.where("squeeze", step * 0.005);
                const Worst shape = rim_error(grain, rim), pressure = pressure_error(plates.world, rim),
                            stress = stress_error(grain, stresses.where("squeeze", step * 0.005));
                std::printf(
                    "%s, %d points, %.0f %%: rim rms %.2e R, worst %.2e R; pressure rms %.2f %%, worst %.2f %% of %d "
                    "points; stress rms %.2f %%, worst %.2f %% of %d numbers\n",
                    law.material.law, bounds.points, 0.5 * step, shape.rms(), shape.worst, 100 * pressure.rms(),
                    100 * pressure.worst, pressure.count, 100 * stress.rms(), 100 * stress.worst, stress.count);
                EXPECT_LE(shape.rms(), bounds.rim_rms);
                EXPECT_LE(shape.worst, bounds.rim_worst);
                if (pressure.count > 0) { // at 276 points narrow contacts are all edge
                    EXPECT_LE(pressure.rms(), bounds.pressure_rms);
                }
                EXPECT_TRUE(pressure.count > 0 || bounds.points == 276);
                EXPECT_LE(stress.rms(), bounds.stress_rms);
            }
        }
}

TEST(QuasiStaticPlates, SqueezeToEightyPerCent)
{
    for (const auto& law : laws) {
        Plates plates(law.material);
        double before = 0;
        for (int k = 1; k <= 160; ++k) {
            plates.squeeze(0.005);
            if (k > 10) {
                EXPECT_GT(plates.force(), before);
            }
            before = plates.force();
        }
        std::printf("%s at 80 %%: %.0f N/m, smallest J %.2f, %d iterations, %d cuts\n", law.material.law, before,
                    plates.world.min_J(), plates.world.iterations, plates.world.cuts);
        EXPECT_GT(plates.world.min_J(), 0);
        EXPECT_LE(plates.world.worst_penetration, 1e-4);
    }
}

} // namespace
