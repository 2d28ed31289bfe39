// SPDX-License-Identifier: GPL-2.0-or-later
// What the shape functions reproduce, slaves included.
#include "support/dense.hpp"
#include "support/layouts.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

const std::vector<int> resolutions { 12, 60, 276, 1000 };
constexpr double round_off = 1e-13;

/// Rows [point][node] of the shape functions at the material points, or of their derivative along one axis.
Eigen::MatrixXd at_points(const Discretisation<2>& mesh, int derivative = -1)
{
    Eigen::MatrixXd N = Eigen::MatrixXd::Zero(mesh.point_count(), mesh.node_count());
    for (const auto& block : mesh.blocks)
        for (int p = block.first_point; p < block.first_point + block.point_count; ++p)
            for (int k = 0; k < mesh.stencil; ++k)
                N(p, block.node[k])
                    += derivative < 0 ? mesh.shape[size_t(p) * mesh.stencil + k] : mesh.gradient_at(block, p, k)[derivative];
    return N;
}

Eigen::MatrixXd rows(const std::vector<Vec<2>>& points, int count)
{
    Eigen::MatrixXd X(count, 2);
    for (int i = 0; i < count; ++i)
        X.row(i) = points[i].transpose();
    return X;
}

Eigen::MatrixXd surface_rows(const Discretisation<2>& mesh)
{
    Eigen::MatrixXd X(mesh.surface_count(), 2);
    for (int p = 0; p < mesh.surface_count(); ++p)
        X.row(p) = mesh.surface[p].position.transpose();
    return X;
}

double largest(const Eigen::MatrixXd& A) { return A.size() ? A.cwiseAbs().maxCoeff() : 0; }

TEST(Interpolation, SharesAddUpToOne)
{
    Random random(1);
    for (const auto& layout : layouts(random, resolutions, 3)) {
        const auto& mesh = *layout.mesh;
        const Eigen::MatrixXd E = extension(mesh);
        const Eigen::VectorXd one = Eigen::VectorXd::Ones(mesh.master_count);
        EXPECT_LE(largest((at_points(mesh) * E * one).array() - 1), round_off) << layout.name;
        EXPECT_LE(largest((surface_interpolation(mesh) * one).array() - 1), round_off) << layout.name;
        for (int d = 0; d < 2; ++d)
            EXPECT_LE(largest(at_points(mesh, d) * E * one) * mesh.cell_width, round_off) << layout.name;
    }
}

// Master nodes carry X; everything else has to come out as X: points, surface, slaves; gradients as I.
TEST(Interpolation, ReproducesLinesThroughMastersAlone)
{
    Random random(2);
    for (const auto& layout : layouts(random, resolutions, 3)) {
        const auto& mesh = *layout.mesh;
        const Eigen::MatrixXd E = extension(mesh), X = rows(mesh.node_position, mesh.master_count);
        EXPECT_LE(largest(E * X - rows(mesh.node_position, mesh.node_count())), round_off) << layout.name;
        EXPECT_LE(largest(at_points(mesh) * E * X - rows(mesh.point_position, mesh.point_count())), round_off)
            << layout.name;
        EXPECT_LE(largest(surface_interpolation(mesh) * X - surface_rows(mesh)), round_off) << layout.name;
        for (int d = 0; d < 2; ++d) {
            Eigen::MatrixXd identity = Eigen::MatrixXd::Zero(mesh.point_count(), 2);
            identity.col(d).setOnes();
            EXPECT_LE(largest(at_points(mesh, d) * E * X - identity), round_off / mesh.cell_width) << layout.name;
        }
    }
}

// All nodes set by a parabola (slaves as if they were masters): sum N_i x_i^2 = x^2 + h^2/4, sum N_i x_i y_i = x y,
// and gradients are exact: the splines themselves reproduce quadratics.
TEST(Interpolation, ReproducesParabolasThroughAllNodes)
{
    Random random(3);
    for (const auto& layout : layouts(random, resolutions, 3)) {
        const auto& mesh = *layout.mesh;
        const Eigen::ArrayXXd X = rows(mesh.node_position, mesh.node_count()),
                              x = rows(mesh.point_position, mesh.point_count());
        const double h = mesh.cell_width;
        const Eigen::MatrixXd N = at_points(mesh);
        for (int d = 0; d < 2; ++d) {
            const Eigen::VectorXd parabola = X.col(d).square();
            EXPECT_LE(largest((N * parabola).array() - x.col(d).square() - h * h / 4), round_off) << layout.name;
            EXPECT_LE(largest((at_points(mesh, d) * parabola).array() - 2 * x.col(d)), round_off / h) << layout.name;
            EXPECT_LE(largest(at_points(mesh, 1 - d) * parabola), round_off / h) << layout.name;
        }
        const Eigen::VectorXd saddle = X.col(0) * X.col(1);
        EXPECT_LE(largest((N * saddle).array() - x.col(0) * x.col(1)), round_off) << layout.name;
    }
}

TEST(Interpolation, MeanGradientIsTheMeanOfTheGradients)
{
    Random random(4);
    for (const auto& layout : layouts(random, resolutions, 2)) {
        const auto& mesh = *layout.mesh;
        const Eigen::VectorXd volume = Eigen::Map<const Eigen::VectorXd>(mesh.point_volume.data(), mesh.point_count());
        for (int d = 0; d < 2; ++d) {
            const Eigen::VectorXd mean = (at_points(mesh, d) * extension(mesh)).transpose() * volume / M_PI;
            for (int i = 0; i < mesh.master_count; ++i)
                EXPECT_NEAR(mesh.mean_gradient[2 * i + d], mean[i], round_off) << layout.name;
        }
    }
}

TEST(Interpolation, AtSurfaceAgreesWithTheDenseRows)
{
    Random random(5);
    for (const auto& layout : layouts(random, { 60 }, 2)) {
        const auto& mesh = *layout.mesh;
        const Eigen::MatrixXd masters
            = Eigen::MatrixXd::NullaryExpr(mesh.master_count, 2, [&] { return random.uniform(-1, 1); });
        const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor> field = extension(mesh) * masters;
        const Eigen::MatrixXd expected = surface_interpolation(mesh) * masters;
        for (int p = 0; p < mesh.surface_count(); ++p)
            EXPECT_LE((mesh.at_surface(p, field.data()).transpose() - expected.row(p)).norm(), round_off) << layout.name;
    }
}

// W = N M^-1 N^T, the velocity of surface point p due to a unit impulse on q.
TEST(Delassus, IsTheDenseProduct)
{
    Random random(6);
    for (const auto& layout : layouts(random, { 12, 60, 276 }, 3)) {
        const auto& mesh = *layout.mesh;
        const Eigen::MatrixXd W = dense_delassus(mesh);
        for (int p = 0; p < mesh.surface_count(); ++p)
            for (int q = 0; q < mesh.surface_count(); ++q)
                ASSERT_NEAR(mesh.delassus(p, q), W(p, q), 1e-12 * W.diagonal().maxCoeff()) << layout.name;
    }
}

TEST(Delassus, RowsAreSortedAndHaveADiagonal)
{
    Random random(7);
    for (const auto& layout : layouts(random, { 60 }, 2)) {
        const auto& mesh = *layout.mesh;
        ASSERT_EQ(int(mesh.delassus_row.size()), mesh.surface_count() + 1);
        for (int p = 0; p < mesh.surface_count(); ++p) {
            EXPECT_GT(mesh.delassus(p, p), 0);
            for (int k = mesh.delassus_row[p] + 1; k < mesh.delassus_row[p + 1]; ++k)
                EXPECT_LT(mesh.delassus_column[k - 1], mesh.delassus_column[k]);
        }
    }
}

} // namespace
