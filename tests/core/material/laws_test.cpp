// SPDX-License-Identifier: GPL-2.0-or-later
#include "material/mooney_rivlin.hpp"
#include "material/neo_hookean.hpp"
#include "material/ogden.hpp"
#include "step/point_tangent.hpp"
#include "support/finite_difference.hpp"
#include "support/random.hpp"

#include <Eigen/SVD>
#include <gtest/gtest.h>

#include <limits>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

template <class L, int D> struct Case {
    using Law = L;
    static constexpr int Dim = D;
};

/// Constants [Pa] of the order of 1, away from special values.
std::vector<double> constants(const NeoHookean&) { return { 2.3, 0.7 }; }
std::vector<double> constants(const MooneyRivlin&) { return { 0.63, 0.17, 3.1 }; }
std::vector<double> constants(const Ogden<1>&) { return { 2.3, 0.3, 5.0 }; }
std::vector<double> constants(const Ogden<3>&) { return { 2.3, 0.4, 3.0, -0.2, -2.5, 0.1, 1.0 }; }
/// Small-strain lambda and mu, Vu et al. 2017 (below eqs. 7 and 8).
std::pair<double, double> lame(const NeoHookean&, const std::vector<double>& p) { return { p[0], p[1] }; }
std::pair<double, double> lame(const MooneyRivlin&, const std::vector<double>& p)
{
    return { 2 * p[2] + 4 * p[1], 2 * (p[0] + p[1]) };
}

template <int Terms> std::pair<double, double> lame(const Ogden<Terms>&, const std::vector<double>& p)
{
    double mu = 0;
    for (int k = 0; k < Terms; ++k)
        mu += p[1 + 2 * k] * p[2 + 2 * k] / 2;
    return { p[0], mu };
}

template <class C> class LawIn : public ::testing::Test {
protected:
    using Law = typename C::Law;
    static constexpr int Dim = C::Dim;
    const std::vector<double> p = constants(Law());

    static Tensor<Dim, double> tensor(const Mat<Dim>& F)
    {
        Tensor<Dim, double> T;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                T.at[i][j] = F(i, j);
        return T;
    }
    /// W = U(J) + w(F) [J/m3].
    double energy(const Mat<Dim>& F) const
    {
        return Law::volumetric_energy(p.data(), F.determinant()) + Law::template energy<Dim, double>(p.data(), tensor(F));
    }
    /// P = U'(J) cof F + dw/dF [Pa].
    Mat<Dim> stress(const Mat<Dim>& F) const
    {
        const auto T = tensor(F), cof = cofactor(T);
        const double J = determinant(T), slope = Law::volumetric_slope(p.data(), J, 1 / J);
        Tensor<Dim, double> P;
        Law::template stress<Dim, double>(p.data(), T, cof, 1 / J, P);
        Mat<Dim> sum;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                sum(i, j) = P.at[i][j] + slope * cof.at[i][j];
        return sum;
    }
    static Mat<Dim> matrix(const Tensor<Dim, double>& T)
    {
        Mat<Dim> M;
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                M(i, j) = T.at[i][j];
        return M;
    }
    static Mat<Dim> deformation(Random& random)
    {
        for (;;) {
            const Mat<Dim> F = Mat<Dim>::Identity() + random.matrix<Dim>(0.35);
            if (F.determinant() > 0.3) return F;
        }
    }
};

using Cases = ::testing::Types<Case<NeoHookean, 2>, Case<NeoHookean, 3>, Case<MooneyRivlin, 2>, Case<MooneyRivlin, 3>,
                               Case<Ogden<1>, 2>, Case<Ogden<3>, 2>>;
TYPED_TEST_SUITE(LawIn, Cases);

// P = dW/dF (Holzapfel 2000, eq. 6.1).
TYPED_TEST(LawIn, StressIsTheSlopeOfTheEnergy)
{
    constexpr int Dim = TypeParam::Dim;
    Random random(1);
    for (int trial = 0; trial < 100; ++trial) {
        const Mat<Dim> F = this->deformation(random);
        const auto slope = central_gradient(
            [&](const std::vector<double>& f) { return this->energy(Eigen::Map<const Mat<Dim>>(f.data())); },
            std::vector<double>(F.data(), F.data() + Dim * Dim), 1e-3);
        const Mat<Dim> P = this->stress(F);
        // h^4 times the fifth derivative, some hundreds (of ln J down to J = 0.3), over 30; eps / h = 2e-13
        EXPECT_LE((P - Eigen::Map<const Mat<Dim>>(slope.data())).cwiseAbs().maxCoeff(), 1e-9 * (1 + P.norm()));
    }
}

/// dP along dF in closed form, by differentiating P = F S of Vu et al. 2017, eqs. 7 and 8, with d(F^-T) = -F^-T dF^T F^-T; for
/// Neo-Hookean as in Bonet and Wood 2008, section 6.4.
template <int Dim> Mat<Dim> tangent(const NeoHookean&, const std::vector<double>& p, const Mat<Dim>& F, const Mat<Dim>& dF)
{
    const Mat<Dim> G = F.inverse().transpose();
    return p[1] * dF + (p[1] - p[0] * std::log(F.determinant())) * G * dF.transpose() * G
        + p[0] * G.cwiseProduct(dF).sum() * G;
}
template <int Dim> Mat<Dim> tangent(const MooneyRivlin&, const std::vector<double>& p, const Mat<Dim>& F, const Mat<Dim>& dF)
{
    const double c1 = p[0], c2 = p[1], c = p[2], J = F.determinant();
    const Mat<Dim> G = F.inverse().transpose(), C = F.transpose() * F, dC = dF.transpose() * F + F.transpose() * dF;
    const double trace = C.trace() + 3 - Dim;
    return 2 * (c1 + c2 * trace) * dF + 2 * c2 * dC.trace() * F - 2 * c2 * (dF * C + F * dC)
        + 2 * c * (2 * J - 1) * J * G.cwiseProduct(dF).sum() * G
        - (2 * c * J * (J - 1) - 2 * (c1 + 2 * c2)) * G * dF.transpose() * G;
}

/// dW/dl of one principal stretch of an Ogden solid, and its own derivative; the other stretch comes in by ln J alone.
template <int Terms> std::array<double, 2> slopes(const Ogden<Terms>&, const std::vector<double>& p, double l, double log_J)
{
    double first = p[0] * log_J / l, second = p[0] * (1 - log_J) / (l * l);
    for (int k = 0; k < Terms; ++k) {
        const double mu = p[1 + 2 * k], alpha = p[2 + 2 * k];
        first += mu * (std::pow(l, alpha) - 1) / l;
        second += mu * ((alpha - 1) * std::pow(l, alpha) + 1) / (l * l);
    }
    return { first, second };
}
/// Principal directions and stretches (Ogden 1997, sections 6.1.4 and 6.1.5): F = sum of l n (x) N, P = sum of dW/dl n (x) N.
template <int Dim, int Terms>
Mat<Dim> tangent(const Ogden<Terms>& law, const std::vector<double>& p, const Mat<Dim>& F, const Mat<Dim>& dF)
{
    const Eigen::JacobiSVD<Mat<Dim>> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Mat<Dim> n = svd.matrixU(), N = svd.matrixV(), A = n.transpose() * dF * N;
    const Vec<Dim> l = svd.singularValues();
    const double log_J = std::log(F.determinant());
    const auto w1 = slopes(law, p, l[0], log_J), w2 = slopes(law, p, l[1], log_J);
    const double w12 = p[0] / (l[0] * l[1]);
    const double alike = (w1[0] + w2[0]) / (l[0] + l[1]), opposite = (w1[0] - w2[0]) / (l[0] - l[1]);
    Mat<Dim> dP;
    dP << w1[1] * A(0, 0) + w12 * A(1, 1), (opposite * (A(0, 1) + A(1, 0)) + alike * (A(0, 1) - A(1, 0))) / 2,
        (opposite * (A(0, 1) + A(1, 0)) - alike * (A(0, 1) - A(1, 0))) / 2, w12 * A(0, 0) + w2[1] * A(1, 1);
    return n * dP * N.transpose();
}

// The second derivatives of U and, in the plane, of w that the implicit scheme takes, against differences of their slopes.
TYPED_TEST(LawIn, PlaneTangentIsTheSlopeOfTheStress)
{
    using Law = typename TypeParam::Law;
    constexpr int Dim = TypeParam::Dim;
    const double* p = this->p.data();
    for (double J = 0.4; J < 2; J += 0.1) {
        const auto slope = [&](const std::vector<double>& at) { return Law::volumetric_slope(p, at[0], 1 / at[0]); };
        EXPECT_NEAR(central_gradient(slope, { J }, 1e-3)[0], Law::volumetric_curvature(p, J, 1 / J), 1e-7);
    }
    if constexpr (Dim == 2) {
        Random random(8);
        for (int trial = 0; trial < 100; ++trial) {
            const Mat<2> F = this->deformation(random), A = random.matrix<2>(1);
            const auto stress = [&](double s, int i, int j) {
                const auto T = this->tensor(F + s * A), cof = cofactor(T);
                Tensor<2, double> P;
                Law::template stress<2, double>(p, T, cof, 1 / determinant(T), P);
                return P.at[i][j];
            };
            const double J = F.determinant();
            const Mat<2> cof = J * F.inverse().transpose(),
                         dcof = (Mat<2>() << A(1, 1), -A(1, 0), -A(0, 1), A(0, 0)).finished();
            Mat<2> slope;
            for (int i = 0; i < 2; ++i)
                for (int j = 0; j < 2; ++j)
                    slope(i, j) = central_gradient([&](const std::vector<double>& s) { return stress(s[0], i, j); }, { 0.0 },
                                                   3e-4)[0];
            if constexpr (gives_plane_tangent<Law>::value) {
                const auto tangent = Law::plane_tangent(p, J, 1 / J);
                const Mat<2> expected
                    = tangent.identity * A + tangent.cofactor * cof.cwiseProduct(A).sum() * cof + tangent.bend * dcof;
                EXPECT_LE((slope - expected).cwiseAbs().maxCoeff(), 1e-9 * (1 + expected.norm()));
            }
            // of every law by differences of h = 1e-5, h^2 times a third derivative of the stress and eps / h
            const auto s = StretchTangent<double>::of<Law>(p, this->tensor(F));
            const Mat<2> along[] { this->matrix(s.along[0]), this->matrix(s.along[1]) };
            const double a = along[0].cwiseProduct(A).sum(), b = along[1].cwiseProduct(A).sum();
            const Mat<2> same = (A + dcof) / 2, opposite = (A - dcof) / 2;
            const Mat<2> expected = (2 * s.pp * a + 2 * s.pm * b) * along[0] + (2 * s.pm * a + 2 * s.mm * b) * along[1]
                + s.twist * (same - a * along[0]) + s.flip * (opposite - b * along[1]);
            EXPECT_LE((slope - expected).cwiseAbs().maxCoeff(), 1e-7 * (1 + expected.norm()));
            EXPECT_LE(A.cwiseProduct(expected).sum(), (1 + 1e-7) * s.most() * A.squaredNorm());
        }
    }
}

// Of the whole stress: the differences of its stress have to be that of the law, and symmetric, A : dP[B] = B : dP[A].
TYPED_TEST(LawIn, DifferencesOfTheStressAreASymmetricTangent)
{
    constexpr int Dim = TypeParam::Dim;
    Random random(6);
    double worst = 0, asymmetry = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Mat<Dim> F = this->deformation(random), A = random.matrix<Dim>(1), B = random.matrix<Dim>(1);
        const auto along = [&](const Mat<Dim>& dF) {
            Mat<Dim> dP;
            for (int i = 0; i < Dim; ++i)
                for (int j = 0; j < Dim; ++j)
                    dP(i, j) = central_gradient(
                        [&](const std::vector<double>& s) { return this->stress(F + s[0] * dF)(i, j); }, { 0.0 }, 3e-4)[0];
            return dP;
        };
        const Mat<Dim> dP = along(A), expected = tangent<Dim>(typename TypeParam::Law(), this->p, F, A);
        worst = std::max(worst, (dP - expected).norm() / (1 + expected.norm()));
        asymmetry = std::max(asymmetry,
                             std::abs(dP.cwiseProduct(B).sum() - along(B).cwiseProduct(A).sum()) / (1 + expected.norm()));
    }
    std::printf("%s in %d dimensions: tangent within %.1e, symmetric within %.1e\n", TypeParam::Law::name, Dim, worst,
                asymmetry);
    EXPECT_LE(worst, 1e-9); // h^4 times a sixth derivative of ln J, 8e-15 times up to 1e5, and eps / h
    EXPECT_LE(asymmetry, 1e-9);
}

TYPED_TEST(LawIn, VolumetricSlopeIsTheSlopeOfTheVolumetricEnergy)
{
    using Law = typename TypeParam::Law;
    for (double J = 0.3; J < 2; J += 0.1) {
        const auto U = [&](const std::vector<double>& at) { return Law::volumetric_energy(this->p.data(), at[0]); };
        EXPECT_NEAR(central_gradient(U, { J }, 1e-3)[0], Law::volumetric_slope(this->p.data(), J, 1 / J), 1e-8);
    }
}

// P = F S with the laws as Vu et al. 2017 give them, eqs. 7 and 8; of Ogden S = sum of dW/dl / l N (x) N.
TYPED_TEST(LawIn, StressIsThePapersFormula)
{
    using Law = typename TypeParam::Law;
    constexpr int Dim = TypeParam::Dim;
    Random random(2);
    for (int trial = 0; trial < 100; ++trial) {
        const Mat<Dim> F = this->deformation(random), I = Mat<Dim>::Identity(), C = F.transpose() * F;
        const double J = F.determinant(), trace = C.trace() + 3 - Dim;
        Mat<Dim> S;
        if constexpr (std::is_same_v<Law, NeoHookean>)
            S = (this->p[0] * std::log(J) - this->p[1]) * C.inverse() + this->p[1] * I;
        else if constexpr (std::is_same_v<Law, MooneyRivlin>) {
            const double c1 = this->p[0], c2 = this->p[1], c = this->p[2], d = 2 * (c1 + 2 * c2);
            S = 2 * (c1 + c2 * trace) * I - 2 * c2 * C + (2 * c * J * (J - 1) - d) * C.inverse();
        } else {
            const Eigen::SelfAdjointEigenSolver<Mat<Dim>> principal(C);
            S.setZero();
            for (int i = 0; i < Dim; ++i) {
                const double l = std::sqrt(principal.eigenvalues()[i]);
                const Vec<Dim> N = principal.eigenvectors().col(i);
                S += slopes(Law(), this->p, l, std::log(J))[0] / l * N * N.transpose();
            }
        }
        EXPECT_LE((this->stress(F) - F * S).norm(), 1e-13 * (1 + (F * S).norm()));
    }
}

TYPED_TEST(LawIn, UndeformedIsFreeOfStressAndEnergy)
{
    constexpr int Dim = TypeParam::Dim;
    EXPECT_NEAR(this->energy(Mat<Dim>::Identity()), 0, 1e-15);
    EXPECT_LE(this->stress(Mat<Dim>::Identity()).norm(), 1e-15);
}

// W(Q F) = W(F), P(Q F) = Q P(F); isotropy: W(F Q) = W(F).
TYPED_TEST(LawIn, DoesNotSeeRotations)
{
    constexpr int Dim = TypeParam::Dim;
    Random random(3);
    for (int trial = 0; trial < 100; ++trial) {
        const Mat<Dim> F = this->deformation(random), Q = random.rotation<Dim>();
        EXPECT_NEAR(this->energy(Q * F), this->energy(F), 1e-13);
        EXPECT_NEAR(this->energy(F * Q), this->energy(F), 1e-13);
        EXPECT_LE((this->stress(Q * F) - Q * this->stress(F)).norm(), 1e-13 * (1 + this->stress(F).norm()));
        const Mat<Dim> kirchhoff = this->stress(F) * F.transpose(); // symmetric: no couple on a point
        EXPECT_LE((kirchhoff - kirchhoff.transpose()).norm(), 1e-13 * (1 + kirchhoff.norm()));
    }
}

// Small strains e: P = lambda tr(e) I + 2 mu e + O(e^2); plane strain has the same form.
TYPED_TEST(LawIn, SmallStrainsAreHookes)
{
    using Law = typename TypeParam::Law;
    constexpr int Dim = TypeParam::Dim;
    const auto [lambda, mu] = lame(Law(), this->p);
    Random random(4);
    for (int trial = 0; trial < 20; ++trial) {
        const Mat<Dim> A = random.matrix<Dim>(1), I = Mat<Dim>::Identity();
        constexpr double h = 1e-4;
        // the difference of +h and -h has no h^2 term: h^2 times the third derivative remains
        const Mat<Dim> slope = (this->stress(I + h * A) - this->stress(I - h * A)) / (2 * h);
        const Mat<Dim> hooke = lambda * A.trace() * I + mu * (A + A.transpose());
        EXPECT_LE((slope - hooke).norm(), 1e3 * h * h);
    }
    EXPECT_NEAR(Law::wave_modulus(this->p.data()), lambda + 2 * mu, 1e-14);
    EXPECT_NEAR(Law::shear_modulus(this->p.data()), mu, 1e-14);
}

TYPED_TEST(LawIn, LanesAgreeWithOneLane)
{
    using Law = typename TypeParam::Law;
    constexpr int Dim = TypeParam::Dim, lanes = 4;
    using Wide = typename Lanes<lanes>::Value;
    Random random(5);
    Wide p[7];
    for (size_t k = 0; k < this->p.size(); ++k)
        p[k] = broadcast<Wide>(this->p[k]);
    Mat<Dim> F[lanes];
    Tensor<Dim, Wide> wide, P;
    for (int l = 0; l < lanes; ++l) {
        F[l] = this->deformation(random);
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                wide.at[i][j][l] = F[l](i, j);
    }
    const Wide J = determinant(wide), inverse_J = 1.0 / J;
    const Tensor<Dim, Wide> cof = cofactor(wide);
    Law::template stress<Dim, Wide>(p, wide, cof, inverse_J, P);
    const Wide slope = Law::volumetric_slope(p, J, inverse_J);
    const Wide W = Law::volumetric_energy(p, J) + Law::template energy<Dim, Wide>(p, wide);
    for (int l = 0; l < lanes; ++l) {
        EXPECT_NEAR(W[l], this->energy(F[l]), 1e-13);
        const Mat<Dim> expected = this->stress(F[l]);
        for (int i = 0; i < Dim; ++i)
            for (int j = 0; j < Dim; ++j)
                EXPECT_NEAR(P.at[i][j][l] + slope[l] * cof.at[i][j][l], expected(i, j), 1e-13 * (1 + expected.norm()));
    }
}

template <class Law> void expect_complaint(std::vector<double> p, const std::vector<std::string>& words)
{
    const std::string complaint = Law::complaint(p.data());
    if (words.empty()) {
        EXPECT_EQ(complaint, "");
    }
    for (const auto& word : words)
        EXPECT_NE(complaint.find(word), std::string::npos) << "'" << word << "' is missing in: " << complaint;
}

const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

TEST(NeoHookeanComplaint, NamesTheConstantAndItsValue)
{
    expect_complaint<NeoHookean>({ 61e6, 1.26e6 }, {});
    expect_complaint<NeoHookean>({ 0, 1 }, {});
    expect_complaint<NeoHookean>({ 1, 0 }, { "mu = 0", "positive" });
    expect_complaint<NeoHookean>({ 1, -2.5 }, { "mu = -2.5" });
    expect_complaint<NeoHookean>({ 1, nan }, { "mu" });
    expect_complaint<NeoHookean>({ 1, inf }, { "mu" });
    expect_complaint<NeoHookean>({ -0.7, 1 }, { "lambda = -0.7" });
    expect_complaint<NeoHookean>({ nan, 1 }, { "lambda" });
    expect_complaint<NeoHookean>({ inf, 1 }, { "lambda" });
}

TEST(MooneyRivlinComplaint, NamesTheModulusAndItsValue)
{
    expect_complaint<MooneyRivlin>({ 0.63e6, -0.0012e6, 6e6 }, {});
    expect_complaint<MooneyRivlin>({ 1, -0.5, 5 }, { "c1 + 2 c2 = 0 Pa" });
    expect_complaint<MooneyRivlin>({ -1, 0.75, 5 }, { "shear modulus", "-0.5" });
    expect_complaint<MooneyRivlin>({ nan, 0, 5 }, { "c1 = nan", "finite" });
    expect_complaint<MooneyRivlin>({ 1, -inf, 5 }, { "c2 = -inf", "finite" });
    expect_complaint<MooneyRivlin>({ 1, 0, inf }, { "c = inf", "finite" });
    expect_complaint<MooneyRivlin>({ 1, 0, -1 }, { "bulk modulus", "-0.666667", "raise c = -1" });
}

TEST(OgdenComplaint, NamesTheConstantAndItsValue)
{
    expect_complaint<Ogden<1>>({ 61e6, 0.4e6, 6 }, {});
    expect_complaint<Ogden<1>>({ 0, -1, -2 }, {});
    expect_complaint<Ogden<2>>({ 1, 2, 2, 0.1, -3 }, {});
    expect_complaint<Ogden<2>>({ 1, 2, 2, 1, -5 }, { "shear modulus", "-0.5 Pa", "positive" });
    expect_complaint<Ogden<1>>({ 1, 1, -2 }, { "shear modulus", "-1 Pa" });
    expect_complaint<Ogden<2>>({ 1, 2, 2, 1, 0 }, { "alpha[1] = 0", "leave" });
    expect_complaint<Ogden<3>>({ 1, 2, 2, 1, 1, nan, 1 }, { "mu[2] = nan", "finite" });
    expect_complaint<Ogden<1>>({ 1, 2, inf }, { "alpha[0] = inf", "finite" });
    expect_complaint<Ogden<1>>({ -0.7, 1, 2 }, { "lambda = -0.7" });
}

TEST(LawNames, AreThoseOfTheFilesAndMessages)
{
    EXPECT_STREQ(NeoHookean::name, "Neo-Hookean");
    EXPECT_STREQ(NeoHookean::parameters[0], "lambda");
    EXPECT_STREQ(NeoHookean::parameters[1], "mu");
    EXPECT_STREQ(MooneyRivlin::name, "Mooney-Rivlin");
    EXPECT_STREQ(MooneyRivlin::parameters[0], "c1");
    EXPECT_STREQ(MooneyRivlin::parameters[1], "c2");
    EXPECT_STREQ(MooneyRivlin::parameters[2], "c");
}

} // namespace
