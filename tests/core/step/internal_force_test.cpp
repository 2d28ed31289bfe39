// SPDX-License-Identifier: GPL-2.0-or-later
// f = -dE/du, seen from outside: forces from the velocities that a step from rest gives, energies from the grains.
#include "material/mooney_rivlin.hpp"
#include "support/dense.hpp"
#include "support/finite_difference.hpp"
#include "support/forces.hpp"
#include "support/grains.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

using Grains = std::deque<Grain<2>>;

double energy(const Grains& grains, size_t which)
{
    Grains copies = grains;
    Assembly<2> assembly(pointers(copies));
    assembly.evaluate_energy(0, 1);
    return copies[which].elastic;
}

/// Grains with random rotations and nodal displacements, strains of some per cent to ten.
Grains random_grains(Random& random, const Material& material, int count, int points)
{
    Grains grains;
    const auto mesh = disc_mesh(points, 0.3, 0.1);
    for (int g = 0; g < count; ++g) {
        GrainStart start;
        start.angle = random.uniform(0, 7);
        Material own = material;
        for (double& p : own.parameters)
            p *= random.uniform(0.7, 1.4);
        grains.push_back(make_grain(mesh, own, start, random.log_uniform(0.5e-3, 2e-3)));
        for (double& u : grains.back().displacement)
            u += random.uniform(-0.02, 0.02) * mesh->cell_width;
        grains.back().refresh();
    }
    return grains;
}

/// -dE/du along random directions, against the forces.
void expect_forces_are_slopes(const Material& material, int count)
{
    Random random(1);
    const Grains grains = random_grains(random, material, count, 60);
    const auto f = forces(grains);
    for (int which : { 0, count / 2, count - 1 })
        for (int trial = 0; trial < 12; ++trial) {
            const auto& grain = grains[which];
            std::vector<double> direction(grain.displacement.size(), 0);
            if (trial < 8)
                direction[random.integer(0, int(direction.size()) - 1)] = 1;
            else
                for (double& d : direction)
                    d = random.uniform(-1, 1);
            double expected = 0, size = 0;
            for (size_t i = 0; i < direction.size(); ++i) {
                expected -= grain.radius * f[which][i] * direction[i];
                size += grain.radius * std::abs(f[which][i] * direction[i]);
            }
            const auto along = [&](const std::vector<double>& s) {
                Grains moved = grains;
                for (size_t i = 0; i < direction.size(); ++i)
                    moved[which].displacement[i] += s[0] * direction[i];
                return energy(moved, which);
            };
            // h^4 of a strain h / cell width, and round-off of the energy over h
            constexpr double h = 1e-5;
            const double round_off = 1e-15 * energy(grains, which) / h;
            EXPECT_NEAR(central_gradient(along, { 0.0 }, h)[0], expected, 1e-8 * size + 20 * round_off);
        }
}

TEST(InternalForce, IsTheSlopeOfTheEnergyInOneLane)
{
    expect_forces_are_slopes(neo_hookean(), 1);
    expect_forces_are_slopes(mooney_rivlin(), 1);
    expect_forces_are_slopes(ogden(), 1);
}

TEST(InternalForce, IsTheSlopeOfTheEnergyInManyLanes)
{
    expect_forces_are_slopes(neo_hookean(), 11); // a full batch and lanes to spare
    expect_forces_are_slopes(mooney_rivlin(), 11);
}

TEST(InternalForce, AndEnergyAreTheSameInOneLaneAndInMany)
{
    Random random(2);
    for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
        Grains grains = random_grains(random, material, 11, 124);
        const auto wide = forces(grains);
        for (size_t g = 0; g < grains.size(); ++g) {
            const auto narrow = forces({ grains[g] })[0];
            double largest = 0;
            for (double f : narrow)
                largest = std::max(largest, std::abs(f));
            for (size_t i = 0; i < narrow.size(); ++i)
                // lanes have their own logarithm and order of sums
                ASSERT_NEAR(wide[g][i], narrow[i], 1e-12 * largest) << material.law;
            Grain<2> alone = grains[g];
            ASSERT_NEAR(energy(grains, g) / alone.elastic_energy(), 1, 1e-12) << material.law;
        }
    }
}

// Internal forces have no resultant and no couple about the current positions (objectivity), whatever the deformation.
TEST(InternalForce, HasNoResultantAndNoCouple)
{
    Random random(3);
    for (const Material& material : { neo_hookean(), mooney_rivlin() })
        for (int points : { 60, 276 }) {
            const Grains grains = random_grains(random, material, 3, points);
            const auto f = forces(grains);
            for (size_t g = 0; g < grains.size(); ++g) {
                Vec<2> sum = Vec<2>::Zero();
                double couple = 0, size = 0;
                for (int i = 0; i < grains[g].mesh->master_count; ++i) {
                    const Vec<2> force(f[g][2 * i], f[g][2 * i + 1]);
                    const Vec<2> x = grains[g].mesh->node_position[i]
                        + Vec<2>(grains[g].displacement[2 * i], grains[g].displacement[2 * i + 1]);
                    sum += force;
                    couple += x.x() * force.y() - x.y() * force.x();
                    size += force.norm();
                }
                EXPECT_LE(sum.norm(), 1e-12 * size);
                EXPECT_LE(std::abs(couple), 1e-12 * size);
            }
        }
}

TEST(InternalForce, HasASymmetricStiffness)
{
    Random random(4);
    for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
        const Grains grains = random_grains(random, material, 1, 30);
        const Eigen::MatrixXd K = stiffness(grains[0]);
        EXPECT_LE((K - K.transpose()).norm(), 1e-8 * K.norm());
    }
}

// At rest the stiffness is Hooke's, put together the obvious way. For displacements u, with t the trace of the strain e,
//     u K u / 2 = sum over regions of V [ U'' / 2 (mean t)^2 + k / 2 mean (t - mean t)^2 ]
//               + sum over points of V_p [ (lambda - U'') / 2 t^2 + mu e : e ],      k = 0.8 min(U'', 50 mu) in cut cells.
TEST(InternalForce, HasTheStiffnessOfHookesLawAtRest)
{
    struct Moduli {
        Material material;
        double lambda, mu, volumetric; ///< U''(1)
    };
    const double nu = 0.4999, stiff = 2 * nu / (1 - 2 * nu) * 1e6; // over the bound of k
    for (const auto& [material, lambda, mu, volumetric] :
         { Moduli { neo_hookean(), 61e6, 1.26e6, 61e6 }, Moduli { { "Neo-Hookean", { stiff, 1e6 } }, stiff, 1e6, stiff },
           Moduli { { "Mooney-Rivlin", { 0.4e6, 0.1e6, 6e6 } }, 12.4e6, 1e6, 12e6 } }) {
        Grain<2> grain = make_grain(disc_mesh(60, 0.3, 0.1), material);
        const Discretisation<2>& mesh = *grain.mesh;
        const Eigen::MatrixXd E = extension(mesh);
        Eigen::MatrixXd K = Eigen::MatrixXd::Zero(2 * mesh.master_count, 2 * mesh.master_count);
        for (const auto& region : mesh.regions) {
            std::vector<Eigen::MatrixXd> gradient; // [point], rows du_x/dX, du_x/dY, du_y/dX, du_y/dY
            Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(K.cols());
            for (int b = region.first_block; b < region.first_block + region.block_count; ++b) {
                const auto& block = mesh.blocks[size_t(b)];
                for (int p = block.first_point; p < block.first_point + block.point_count; ++p) {
                    Eigen::MatrixXd B = Eigen::MatrixXd::Zero(4, K.cols());
                    for (int k = 0; k < mesh.stencil; ++k)
                        for (int i = 0; i < mesh.master_count; ++i)
                            for (int c = 0; c < 2; ++c)
                                B.block<2, 1>(2 * c, 2 * i + c)
                                    += E(block.node[size_t(k)], i) * mesh.gradient_at(block, p, k);
                    gradient.push_back(B);
                    mean += (B.row(0) + B.row(3)) / 4;
                }
            }
            const double V = region.volume, k = region.full ? 0 : 0.8 * std::min(volumetric, 50 * mu);
            K += V * volumetric * mean.transpose() * mean;
            for (const auto& B : gradient) {
                const Eigen::RowVectorXd trace = B.row(0) + B.row(3), shear = B.row(1) + B.row(2), off = trace - mean;
                K += V / 4 * (k * off.transpose() * off + (lambda - volumetric) * trace.transpose() * trace);
                K += V / 4 * mu
                    * (2 * B.row(0).transpose() * B.row(0) + 2 * B.row(3).transpose() * B.row(3)
                       + shear.transpose() * shear);
            }
        }
        const Eigen::MatrixXd found = stiffness(grain);
        std::printf("%s, lambda / mu = %.0f: stiffness within %.1e, symmetric within %.1e\n", material.law, lambda / mu,
                    (found - K).norm() / K.norm(), (found - found.transpose()).norm() / K.norm());
        EXPECT_LE((found - K).norm(), 1e-8 * K.norm()); // of the differences in stiffness()
    }
}

// Of Mooney-Rivlin U is a parabola, so that the mean of U(J_p) is U(mean J) + U''/2 times the mean square of J_p - mean J.
TEST(InternalForce, WithoutMeanDilatationEveryPointHasItsOwnVolumeChange)
{
    Resolution resolution;
    resolution.points = 60;
    resolution.mean_dilatation = false;
    const auto mesh = std::make_shared<const Discretisation<2>>(DiscOutline(), resolution);
    Random random(3);
    Grain<2> grain = make_grain(mesh, mooney_rivlin());
    for (double& u : grain.displacement)
        u += random.uniform(-0.05, 0.05) * mesh->cell_width;
    grain.refresh();
    const std::vector<Mat<2>> deformation = grain.deformation_gradients();
    double expected = 0;
    for (size_t p = 0; p < deformation.size(); ++p) {
        Tensor<2, double> F;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                F.at[i][j] = deformation[p](i, j);
        expected += grain.radius * grain.radius * mesh->point_volume[p]
            * (MooneyRivlin::volumetric_energy(grain.parameters.data(), determinant(F))
               + MooneyRivlin::energy<2, double>(grain.parameters.data(), F));
    }
    EXPECT_NEAR(grain.elastic_energy(), expected, 1e-12 * expected);
}

TEST(InternalForce, IsNoneInAGrainThatIsOnlyTurned)
{
    for (const Material& material : { neo_hookean(), mooney_rivlin() }) {
        GrainStart start;
        start.angle = 2.1;
        start.centre = Vec<2>(0.3, -0.2);
        Grain<2> grain = make_grain(disc_mesh(276), material, start);
        const double stiffness = grain.law->wave_modulus(material.parameters.data()) * grain.radius;
        const auto all = forces({ grain });
        for (double f : all[0])
            EXPECT_NEAR(f, 0, 1e-13 * stiffness);
        EXPECT_NEAR(grain.elastic_energy(), 0, 1e-14 * stiffness * grain.radius);
    }
}

} // namespace
