// SPDX-License-Identifier: GPL-2.0-or-later
// Cauchy stresses of homogeneous deformations against the closed forms C_*.csv, to 1e-10 of their largest entry or of the
// first modulus: of the law alone, and of all points of a grain that is deformed and then turned.
#include "reference.hpp"
#include "support/forces.hpp"
#include "support/grains.hpp"
#include "support/random.hpp"

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

/// Stresses at the material points of a disc whose nodes are at A X; cut cells, slaves and the mean J of regions take part.
std::vector<Mat<3>> stresses_in_a_grain(const Material& material, const Mat<2>& A)
{
    static const auto mesh = disc_mesh(60, 0.3, 0.1);
    Grain<2> grain = make_grain(mesh, material);
    for (int i = 0; i < mesh->master_count; ++i)
        Eigen::Map<Vec<2>>(&grain.displacement[2 * size_t(i)]) = (A - Mat<2>::Identity()) * mesh->node_position[size_t(i)];
    return grain.cauchy_stresses();
}

/// Checks the law and grains at several turns Q against sigma, that is Q sigma Q^T (objectivity). Returns the error.
double check(const Material& material, const Mat<2>& F, const Mat<3>& sigma)
{
    // round-off of terms that cancel is relative to the moduli
    const double scale = std::max(sigma.cwiseAbs().maxCoeff(), material.parameters[0]);
    double worst = (stress(material, F) - sigma).cwiseAbs().maxCoeff() / scale;
    for (double angle : { 0.0, 0.7, 2.9, -1.8 }) {
        Mat<3> Q = Mat<3>::Identity();
        Q.topLeftCorner<2, 2>() = turn(angle);
        for (const Mat<3>& found : stresses_in_a_grain(material, turn(angle) * F))
            worst = std::max(worst, (found - Q * sigma * Q.transpose()).cwiseAbs().maxCoeff() / scale);
    }
    EXPECT_LE(worst, 1e-10) << material.law << "\n" << F << "\n" << sigma;
    return worst;
}

void compare(const std::string& name, const std::string& key, const std::function<Mat<2>(double)>& deformation)
{
    const Table table(name);
    double worst = 0;
    for (const auto& [label, material] : materials)
        for (size_t row = 0; row < table[key].size(); ++row) {
            const Mat<2> F = deformation(table[key][row]);
            const auto entry = [&, &label = label](const std::string& suffix) { return table[label + "_" + suffix][row]; };
            Mat<3> expected = Mat<3>::Zero();
            expected.diagonal() << entry("s11"), entry("s22"), entry("s33");
            expected(0, 1) = expected(1, 0) = entry("s12");
            worst = std::max(worst, check(material, F, expected));
            EXPECT_NEAR(F.determinant(), table["J"][row], 1e-12);
        }
    std::printf("%s: stress within %.1e\n", name.c_str(), worst);
}

Mat<2> stretches(double x, double y) { return Vec<2>(x, y).asDiagonal(); }

TEST(ClosedForms, UniaxialStrain)
{
    compare("C_uniaxial_strain.csv", "s", [](double s) { return stretches(1, s); });
}
TEST(ClosedForms, EquibiaxialStrain)
{
    compare("C_equibiaxial_strain.csv", "s", [](double s) { return stretches(s, s); });
}
TEST(ClosedForms, IsochoricBiaxialStrain)
{
    compare("C_biaxial_isochoric.csv", "s", [](double s) { return stretches(1 / s, s); });
}
TEST(ClosedForms, SimpleShear)
{
    compare("C_simple_shear.csv", "g", [](double g) { return (Mat<2>() << 1, g, 0, 1).finished(); });
}
TEST(ClosedForms, RotatedUniaxialStrain)
{
    compare("C_rotated_uniaxial_s0.8.csv", "theta_rad",
            [](double theta) { return Mat<2>(turn(theta) * stretches(1, 0.8)); });
}

TEST(ClosedForms, UniaxialStressInPlaneStrain)
{
    const Table table("C_uniaxial_stress_planestrain.csv");
    double worst = 0;
    for (const auto& [label, material] : materials)
        for (size_t row = 0; row < table["s"].size(); ++row) {
            Mat<3> expected = Mat<3>::Zero(); // sigma_11 = 0: the lateral stretch in the table makes it so
            expected(1, 1) = table[label + "_s22"][row];
            expected(2, 2) = table[label + "_s33"][row];
            worst = std::max(worst, check(material, stretches(table[label + "_l"][row], table["s"][row]), expected));
        }
    std::printf("C_uniaxial_stress_planestrain.csv: stress within %.1e\n", worst);
}

// A grain in any state of strain, turned by Q: E(Q x) = E(x), f(Q x) = Q f(x).
TEST(Objectivity, ForcesTurnWithTheGrain)
{
    Random random(1);
    double force_error = 0, energy_error = 0;
    for (const auto& [label, material] : materials)
        for (int trial = 0; trial < 5; ++trial) {
            Grain<2> grain = make_grain(disc_mesh(124, 0.3, 0.1), material);
            for (double& u : grain.displacement)
                u = random.uniform(-0.05, 0.05) * grain.mesh->cell_width;
            const Mat<2> Q = random.rotation<2>();
            Grain<2> turned = grain;
            for (int i = 0; i < grain.mesh->master_count; ++i) {
                const Vec<2>& X = grain.mesh->node_position[size_t(i)];
                const Eigen::Map<const Vec<2>> u(&grain.displacement[2 * size_t(i)]);
                Eigen::Map<Vec<2>>(&turned.displacement[2 * size_t(i)]) = Q * (X + u) - X;
            }
            energy_error = std::max(energy_error, std::abs(turned.elastic_energy() / grain.elastic_energy() - 1));
            const auto f = forces({ grain })[0], of_turned = forces({ turned })[0];
            double size = 0, apart = 0;
            for (size_t i = 0; i < f.size(); i += 2) {
                size = std::max(size, Vec<2>(f[i], f[i + 1]).norm());
                apart = std::max(apart, (Vec<2>(of_turned[i], of_turned[i + 1]) - Q * Vec<2>(f[i], f[i + 1])).norm());
            }
            force_error = std::max(force_error, apart / size);
        }
    std::printf("turned grains: forces within %.1e, energies within %.1e\n", force_error, energy_error);
    EXPECT_LE(force_error, 1e-12);
    EXPECT_LE(energy_error, 1e-12);
}

} // namespace
