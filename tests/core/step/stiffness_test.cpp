// SPDX-License-Identifier: GPL-2.0-or-later
// Stiffness, factor and compliance of the implicit scheme against dense matrices and the forces of the explicit one.
#include "step/stiffness.hpp"
#include "support/dense.hpp"
#include "support/forces.hpp"
#include "support/grains.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// What the kernels make of one grain, as dense matrices in the order of the masters.
struct Condensed {
    Eigen::MatrixXd K, C;
    Eigen::VectorXd solution; ///< K^-1 load

    Condensed(Grain<2> grain, double inertia, const Eigen::VectorXd& load)
    {
        const auto& mesh = *grain.mesh;
        const StiffnessPattern<2> pattern(mesh);
        AlignedVector displacement(2 * size_t(pattern.rows));
        for (size_t i = 0; i < displacement.size(); ++i)
            displacement[i] = grain.displacement[2 * size_t(pattern.master[i / 2]) + i % 2];
        const int points = mesh.surface_count();
        AlignedVector matrix(4 * size_t(pattern.block_count())), room(4 * size_t(points) * pattern.rows),
            compliance(4 * size_t(points) * points), x(2 * size_t(pattern.rows));
        grain.law->stiffness[0](&pattern, grain.parameters.data(), displacement.data(), &inertia, matrix.data());
        K = Eigen::MatrixXd::Zero(2 * pattern.rows, 2 * pattern.rows);
        for (int r = 0; r < pattern.rows; ++r)
            for (int c = pattern.first[size_t(r)]; c <= r; ++c)
                for (int i = 0; i < 2; ++i)
                    for (int j = 0; j < 2; ++j) {
                        const double value = matrix[4 * size_t(pattern.block(r, c)) + size_t(2 * i + j)];
                        const int row = 2 * pattern.master[size_t(r)] + i, column = 2 * pattern.master[size_t(c)] + j;
                        K(row, column) = K(column, row) = value;
                    }
        const auto& kernels = stiffness_kernels();
        kernels.factorise[0](&pattern, matrix.data());
        kernels.compliance[0](&pattern, matrix.data(), room.data(), compliance.data());
        C.resize(2 * points, 2 * points);
        for (int p = 0; p < points; ++p)
            for (int q = 0; q < points; ++q)
                for (int k = 0; k < 4; ++k)
                    C(2 * p + k / 2, 2 * q + k % 2) = compliance[4 * (size_t(points) * p + q) + k];
        for (int r = 0; r < 2 * pattern.rows; ++r)
            x[size_t(r)] = load[2 * pattern.master[size_t(r / 2)] + r % 2];
        kernels.solve[0](&pattern, matrix.data(), x.data());
        solution.resize(2 * pattern.rows);
        for (int r = 0; r < 2 * pattern.rows; ++r)
            solution[2 * pattern.master[size_t(r / 2)] + r % 2] = x[size_t(r)];
    }
};

Eigen::VectorXd random_load(Random& random, const Grain<2>& grain)
{
    Eigen::VectorXd load(2 * grain.mesh->master_count);
    for (double& f : load)
        f = random.uniform(-1, 1);
    return load;
}

// At rest nothing is cut off, and the stiffness is -df/du of the explicit forces; in the plane lengths drop out.
TEST(Stiffness, IsTheSlopeOfTheForcesAtRest)
{
    Random random(1);
    for (const Material& material : { neo_hookean(), mooney_rivlin(), ogden() })
        for (double angle : { 0.0, 1.3 }) {
            GrainStart start;
            start.angle = angle;
            const Grain<2> grain = make_grain(disc_mesh(60, 0.3, 0.1), material, start);
            const Eigen::MatrixXd expected = stiffness(grain);
            const Condensed found(grain, 0, random_load(random, grain));
            EXPECT_LE((found.K - expected).norm(), 1e-8 * expected.norm()) << material.law;
        }
}

// Deformed, it has no negative eigenvalues, and exceeds the slope of the forces by what was cut off.
TEST(Stiffness, IsPositiveSemiDefiniteAndNotBelowTheSlopeOfTheForces)
{
    Random random(2);
    for (const Material& material : { neo_hookean(), mooney_rivlin(), ogden() }) {
        Grain<2> grain = make_grain(disc_mesh(60), material);
        for (int i = 0; i < grain.mesh->master_count; ++i)
            for (int d = 0; d < 2; ++d)
                grain.displacement[size_t(2 * i + d)]
                    += (d == 0 ? 0.1 : -0.2) * grain.mesh->node_position[size_t(i)][d] + random.uniform(-0.01, 0.01);
        grain.refresh();
        const Condensed found(grain, 0, random_load(random, grain));
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> own(found.K), excess(found.K - stiffness(grain));
        EXPECT_GE(own.eigenvalues()[0], -1e-10 * own.eigenvalues().maxCoeff());
        EXPECT_GE(excess.eigenvalues()[0], -1e-7 * own.eigenvalues().maxCoeff()); // of the differences in stiffness()
    }
}

TEST(Stiffness, AndItsFactorSolveAndCondenseAsDenseMatricesDo)
{
    Random random(3);
    for (int points : { 30, 124 }) {
        const Grain<2> grain = make_grain(disc_mesh(points, 0.2, 0.4), neo_hookean());
        const Eigen::VectorXd load = random_load(random, grain);
        const Condensed found(grain, 1e5, load);
        const Eigen::MatrixXd inverse = found.K.inverse();
        EXPECT_LE((found.solution - inverse * load).norm(), 1e-9 * found.solution.norm());
        const Eigen::MatrixXd N = surface_interpolation(*grain.mesh);
        Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(2 * N.rows(), 2 * N.cols());
        for (int i = 0; i < N.rows(); ++i)
            for (int j = 0; j < N.cols(); ++j)
                wide.block<2, 2>(2 * i, 2 * j) = N(i, j) * Mat<2>::Identity();
        const Eigen::MatrixXd expected = wide * inverse * wide.transpose();
        EXPECT_LE((found.C - expected).norm(), 1e-9 * expected.norm());
    }
}

} // namespace
