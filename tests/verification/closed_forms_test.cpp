// SPDX-License-Identifier: GPL-2.0-or-later
// Cauchy stresses of homogeneous deformations against the closed forms C_*.csv, to 1e-10 of their largest entry.
#include "reference.hpp"
#include "support/grains.hpp"

#include <gtest/gtest.h>

#include <functional>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const std::vector<std::pair<std::string, Material>> materials { { "NH", neo_hookean() },
                                                                { "MR", mooney_rivlin() },
                                                                { "NHsoft", soft_neo_hookean() } };

Mat<3> stress(const Material& material, const Mat<2>& in_plane)
{
    Mat<3> F = Mat<3>::Identity();
    F.topLeftCorner<2, 2>() = in_plane;
    return law_kernels<2>(material.law).cauchy_stress(material.parameters.data(), F, F.determinant());
}

void compare(const std::string& name, const std::string& key, const std::function<Mat<2>(double)>& deformation)
{
    const Table table(name);
    for (const auto& [label, material] : materials)
        for (size_t row = 0; row < table[key].size(); ++row) {
            const Mat<2> F = deformation(table[key][row]);
            const Mat<3> sigma = stress(material, F);
            const auto entry = [&](const std::string& suffix) { return table[label + "_" + suffix][row]; };
            Mat<3> expected = Mat<3>::Zero();
            expected.diagonal() << entry("s11"), entry("s22"), entry("s33");
            expected(0, 1) = expected(1, 0) = entry("s12");
            // round-off of terms that cancel is relative to the moduli
            const double scale = std::max(expected.cwiseAbs().maxCoeff(), material.parameters[0]);
            EXPECT_LE((sigma - expected).cwiseAbs().maxCoeff(), 1e-10 * scale)
                << name << " " << label << " " << table[key][row] << "\n" << sigma << "\n" << expected;
            EXPECT_NEAR(F.determinant(), table["J"][row], 1e-12);
        }
}

Mat<2> stretches(double x, double y) { return Vec<2>(x, y).asDiagonal(); }

TEST(ClosedForms, UniaxialStrain) { compare("C_uniaxial_strain.csv", "s", [](double s) { return stretches(1, s); }); }
TEST(ClosedForms, EquibiaxialStrain) { compare("C_equibiaxial_strain.csv", "s", [](double s) { return stretches(s, s); }); }
TEST(ClosedForms, IsochoricBiaxialStrain) { compare("C_biaxial_isochoric.csv", "s", [](double s) { return stretches(1 / s, s); }); }
TEST(ClosedForms, SimpleShear)
{
    compare("C_simple_shear.csv", "g", [](double g) { return (Mat<2>() << 1, g, 0, 1).finished(); });
}
TEST(ClosedForms, RotatedUniaxialStrain)
{
    compare("C_rotated_uniaxial_s0.8.csv", "theta_rad", [](double theta) { return Mat<2>(turn(theta) * stretches(1, 0.8)); });
}

TEST(ClosedForms, UniaxialStressInPlaneStrain)
{
    const Table table("C_uniaxial_stress_planestrain.csv");
    for (const auto& [label, material] : materials)
        for (size_t row = 0; row < table["s"].size(); ++row) {
            const Mat<3> sigma = stress(material, stretches(table[label + "_l"][row], table["s"][row]));
            const double scale = std::max({ std::abs(table[label + "_s22"][row]), material.parameters[0] });
            EXPECT_NEAR(sigma(0, 0), 0, 1e-10 * scale) << label;
            EXPECT_NEAR(sigma(1, 1), table[label + "_s22"][row], 1e-10 * scale) << label;
            EXPECT_NEAR(sigma(2, 2), table[label + "_s33"][row], 1e-10 * scale) << label;
        }
}

} // namespace
