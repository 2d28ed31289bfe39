// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/tensor.hpp"
#include "support/finite_difference.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

template <int Dim> Tensor<Dim, double> tensor(const Mat<Dim>& A)
{
    Tensor<Dim, double> T;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
            T.at[i][j] = A(i, j);
    return T;
}

template <int Dim> Mat<Dim> matrix(const Tensor<Dim, double>& T)
{
    Mat<Dim> A;
    for (int i = 0; i < Dim; ++i)
        for (int j = 0; j < Dim; ++j)
            A(i, j) = T.at[i][j];
    return A;
}

template <class T> class TensorIn : public ::testing::Test {
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(TensorIn, Dimensions);

TYPED_TEST(TensorIn, DeterminantAndCauchyGreenAgreeWithEigen)
{
    constexpr int Dim = TypeParam::value;
    Random random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const Mat<Dim> F = random.matrix<Dim>(1);
        const auto T = tensor<Dim>(F);
        EXPECT_NEAR(determinant(T), F.determinant(), 1e-15 * 6);
        EXPECT_LE((matrix<Dim>(right_cauchy_green(T)) - F.transpose() * F).cwiseAbs().maxCoeff(), 1e-15);
        // plane strain: C33 = 1 counts
        EXPECT_NEAR(first_invariant(T), (F.transpose() * F).trace() + 3 - Dim, 1e-15 * 9);
    }
}

// dJ/dF = cof F = J F^-T (Holzapfel 2000, eq. 1.241).
TYPED_TEST(TensorIn, CofactorIsTheDerivativeOfTheDeterminant)
{
    constexpr int Dim = TypeParam::value;
    Random random(2);
    for (int trial = 0; trial < 50; ++trial) {
        const Mat<Dim> F = Mat<Dim>::Identity() + random.matrix<Dim>(0.4);
        const auto J = [](const std::vector<double>& entries) {
            return determinant(tensor<Dim>(Eigen::Map<const Mat<Dim>>(entries.data())));
        };
        // the determinant is a polynomial of degree at most 3 along each entry: no truncation error, eps / h remains
        const auto slope = central_gradient(J, std::vector<double>(F.data(), F.data() + Dim * Dim), 1e-2);
        const Mat<Dim> cof = matrix<Dim>(cofactor(tensor<Dim>(F)));
        EXPECT_LE((cof - Eigen::Map<const Mat<Dim>>(slope.data())).cwiseAbs().maxCoeff(), 1e-13);
        EXPECT_LE((cof.transpose() * F - F.determinant() * Mat<Dim>::Identity()).cwiseAbs().maxCoeff(), 1e-14);
    }
}

TEST(SmallestStretch, IsTheSmallestSingularValueInThePlane)
{
    Random random(3);
    for (int trial = 0; trial < 500; ++trial) {
        const Mat<2> F = random.rotation<2>() * Vec<2>(random.log_uniform(0.1, 3), random.log_uniform(0.1, 3)).asDiagonal()
            * random.rotation<2>();
        EXPECT_NEAR(smallest_stretch(tensor<2>(F)), F.jacobiSvd().singularValues().minCoeff(), 1e-13);
    }
    EXPECT_NEAR(smallest_stretch(tensor<2>(Mat<2>::Identity())), 1, 1e-15);
}

TEST(SmallestStretch, IsBoundedFromBelowInSpace)
{
    Random random(4);
    for (int trial = 0; trial < 500; ++trial) {
        const Mat<3> F = Mat<3>::Identity() + random.matrix<3>(0.5);
        if (F.determinant() < 0.05) continue;
        const Vec<3> stretch = F.jacobiSvd().singularValues();
        EXPECT_LE(smallest_stretch(tensor<3>(F)), stretch[2] * (1 + 1e-13));
        EXPECT_GE(smallest_stretch(tensor<3>(F)), stretch[2] / std::sqrt(3.0) * (1 - 1e-13));
    }
}

TEST(SmallestStretch, IsTheSameInLanes)
{
    Random random(5);
    constexpr int lanes = 4;
    Tensor<2, Lanes<lanes>::Value> wide;
    Mat<2> F[lanes];
    for (int l = 0; l < lanes; ++l) {
        F[l] = Mat<2>::Identity() + random.matrix<2>(0.3);
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                wide.at[i][j][l] = F[l](i, j);
    }
    const Lanes<lanes>::Value found = smallest_stretch(wide);
    for (int l = 0; l < lanes; ++l)
        EXPECT_NEAR(found[l], smallest_stretch(tensor<2>(F[l])), 1e-14);
}

} // namespace
