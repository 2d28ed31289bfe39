// SPDX-License-Identifier: GPL-2.0-or-later
// Finite plasticity: the return map against closed forms of homogeneous deformations, of the law and of whole grains; slope of
// the energy; objectivity; volume; order of the step; energies.
#include "material/plastic.hpp"
#include "step/critical_step.hpp"
#include "support/finite_difference.hpp"
#include "support/random.hpp"
#include "support/sums.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

constexpr double lambda = 1.5e6, mu = 1e6, yield_stress = 2e4, hardening = 3e5, kappa = lambda + 2 * mu / 3;

Material plastic(double H = hardening) { return { Plastic::name, { lambda, mu, yield_stress, H } }; }

/// A material point that is taken along a path of deformations.
struct Point {
    std::array<double, 8> p;
    double dissipated = 0;

    explicit Point(double H = hardening)
        : p { lambda, mu, yield_stress, H, 1, 0, 1, 0 }
    {
    }
    static Tensor<2, double> tensor(const Mat<2>& F) { return { { { F(0, 0), F(0, 1) }, { F(1, 0), F(1, 1) } } }; }
    void advance(const Mat<2>& F) { dissipated += Plastic::advance(p.data(), tensor(F)); }
    double strain() const { return p[7]; }
    /// Of the step to F [J/m3].
    double energy(const Mat<2>& F) const
    {
        return Plastic::volumetric_energy(p.data(), F.determinant()) + Plastic::energy<2, double>(p.data(), tensor(F));
    }
    /// Kirchhoff's [Pa].
    Mat<3> stress(const Mat<2>& F) const
    {
        Mat<3> whole = Mat<3>::Identity();
        whole.topLeftCorner<2, 2>() = F;
        return F.determinant() * law_kernels<2>(Plastic::name).cauchy_stress(p.data(), whole, F.determinant());
    }
};

double mises(const Mat<3>& tau)
{
    const Mat<3> s = tau - tau.trace() / 3 * Mat<3>::Identity();
    return std::sqrt(1.5) * s.norm();
}

Mat<2> stretches(double x, double y) { return Vec<2>(x, y).asDiagonal(); }

/// Principal logarithmic strains without rotation of axes: the small-strain solution in logarithms. In the plane strain of a
/// strip that is stretched by exp(e) along y at constant volume across, dev e = (-e, e, 0): sqrt(3/2) |dev tau| = sqrt(3) tau_22.
TEST(PlasticPoint, FollowsTheClosedFormOfPureShearForthAndBack)
{
    Point point;
    const double a = std::sqrt(3.0); // mises of tau = diag(-s, s, 0) is a s, equivalent strain of diag(-e, e, 0) is 2 e / a
    double worst = 0, plastic_strain = 0, flowed = 0; // gathered; of the y axis
    double last = 0;
    for (double top : { 0.3, -0.2, 0.25 })
        for (const double sign = top > last ? 1 : -1, step = 0.01; sign * (top - last) > 1e-12;) {
            last += sign * step;
            const double trial = a * 2 * mu * (last - flowed),
                         over = std::abs(trial) - yield_stress - hardening * plastic_strain;
            if (over > 0) {
                const double flow = over / (3 * mu + hardening);
                plastic_strain += flow;
                flowed += std::copysign(a / 2 * flow, trial);
            }
            const Mat<2> F = stretches(std::exp(-last), std::exp(last));
            point.advance(F);
            const Mat<3> tau = point.stress(F);
            const double expected = 2 * mu * (last - flowed);
            worst = std::max({ worst, std::abs(tau(1, 1) / expected - 1), std::abs(tau(0, 0) / expected + 1),
                               std::abs(tau(2, 2)) / yield_stress, std::abs(point.strain() - plastic_strain) });
        }
    std::printf("pure shear, forth, back and forth: within %.1e; plastic strain %.3f\n", worst, plastic_strain);
    EXPECT_LE(worst, 1e-11);
    EXPECT_NEAR(point.dissipated, yield_stress * plastic_strain + hardening / 2 * std::pow(plastic_strain, 2),
                1e-12 * yield_stress);
}

/// Compression with the sides held: dev e = e (-1, 2, -1) / 3 and the plastic flow takes dev e alone, in proportion, so that
/// any number of steps gives the same: with |e| large, tau_22 = kappa e - 2/3 Y, Y the yield stress reached.
TEST(PlasticPoint, FollowsTheClosedFormOfUniaxialStrainInOneStepOrMany)
{
    for (int steps : { 1, 7, 100 }) {
        Point point;
        const double e = -0.2;
        for (int k = 1; k <= steps; ++k)
            point.advance(stretches(1, std::exp(e * k / steps)));
        // q = 2 mu |e| - 3 mu a = yield_stress + hardening a
        const double a = (2 * mu * std::abs(e) - yield_stress) / (3 * mu + hardening), Y = yield_stress + hardening * a;
        const Mat<3> tau = point.stress(stretches(1, std::exp(e)));
        EXPECT_NEAR(point.strain(), a, 1e-12);
        EXPECT_NEAR(tau(1, 1), kappa * e - 2.0 / 3 * Y, 1e-9 * mu);
        EXPECT_NEAR(tau(0, 0), kappa * e + 1.0 / 3 * Y, 1e-9 * mu);
        EXPECT_NEAR(tau(2, 2), kappa * e + 1.0 / 3 * Y, 1e-9 * mu);
    }
}

/// In simple shear without hardening the axes of strain turn, and the shear stress tends to yield_stress / sqrt(3): F_e stays
/// small, its rotation follows. The error of the step is of first order.
TEST(PlasticPoint, FlowsAtTheYieldStressInSimpleShear)
{
    const auto shear = [](int steps) -> Vec<2> {
        Point point(0);
        Mat<2> F = Mat<2>::Identity();
        for (int k = 1; k <= steps; ++k) {
            F(0, 1) = 2.0 * k / steps;
            point.advance(F);
        }
        const Mat<3> tau = point.stress(F);
        EXPECT_NEAR(mises(tau), yield_stress, 1e-9 * yield_stress);
        return Vec<2>(tau(0, 1), tau(0, 0) - tau(1, 1)) / yield_stress;
    };
    const Vec<2> exact = shear(1 << 14);
    const double coarse = (shear(64) - exact).norm(), fine = (shear(256) - exact).norm(),
                 order = std::log(coarse / fine) / std::log(4);
    std::printf("simple shear: tau_12 %.6f of the yield stress over sqrt(3); order of the step %.2f\n",
                exact[0] * std::sqrt(3.0), order);
    EXPECT_NEAR(exact[0] * std::sqrt(3.0), 1, 1e-3); // the elastic strain is 0.6 %
    EXPECT_GE(order, 0.9);
}

/// Random paths: on the yield surface or inside, P the slope of the energy of the step, nothing lost by elastic steps.
TEST(PlasticPoint, HasTheStressThatIsTheSlopeOfTheEnergyOfTheStep)
{
    Random random(3);
    double slope_error = 0, yield_error = 0, turn_error = 0, after_error = 0;
    for (int trial = 0; trial < 50; ++trial) {
        Point point;
        Mat<2> F = Mat<2>::Identity();
        for (int k = 0; k < 5; ++k) {
            const Mat<2> next = (Mat<2>::Identity() + random.matrix<2>(0.1)) * F;
            const Plastic::Trial<double> step(point.p.data(), Point::tensor(next).at);
            const double beyond = step.stress - yield_stress - hardening * point.strain();
            if (std::abs(beyond) < 1e-2 * mu) continue; // the slope has a kink where flow begins
            const auto slope = central_gradient(
                [&](const std::vector<double>& f) { return point.energy(Eigen::Map<const Mat<2>>(f.data())); },
                std::vector<double>(next.data(), next.data() + 4), 1e-4);
            const Mat<2> tau = Eigen::Map<const Mat<2>>(slope.data()) * next.transpose();
            const Mat<3> found = point.stress(next);
            slope_error = std::max(slope_error, (found.topLeftCorner<2, 2>() - tau).norm() / mu);
            Point turned(point);
            const Mat<2> Q = random.rotation<2>();
            turn_error = std::max(turn_error,
                                  (turned.stress(Q * next).topLeftCorner<2, 2>() - Q * tau * Q.transpose()).norm() / mu);
            const double before = point.dissipated;
            point.advance(F = next);
            const Mat<3> after = point.stress(F);
            after_error = std::max(after_error, (after - found).norm() / mu);
            yield_error = std::max(yield_error, mises(after) / (yield_stress + hardening * point.strain()) - 1);
            EXPECT_GE(point.dissipated, before);
        }
    }
    std::printf("slope within %.1e of mu, turned %.1e, after the step %.1e; over the yield stress by %.1e\n", slope_error,
                turn_error, after_error, yield_error);
    EXPECT_LE(slope_error, 1e-9); // eps / h, and h^4 times a fifth derivative of up to some 1e4
    EXPECT_LE(turn_error, 1e-9);
    EXPECT_LE(after_error, 1e-12);
    EXPECT_LE(yield_error, 1e-10);
}

TEST(PlasticComplaint, NamesTheConstantAndItsValue)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::pair<std::array<double, 4>, std::string> cases[] { { { 1, 2, 3, 0 }, "" },
                                                                  { { 1, 0, 3, 0 }, "mu = 0" },
                                                                  { { -1, 2, 3, 0 }, "lambda = -1" },
                                                                  { { 1, 2, 0, 0 }, "yieldStress = 0" },
                                                                  { { 1, 2, nan, 0 }, "yieldStress = nan" },
                                                                  { { 1, 2, 3, -4 }, "hardening = -4" } };
    for (const auto& [p, words] : cases)
        EXPECT_EQ(Plastic::complaint(p.data()).substr(0, words.size()), words.empty() ? "" : words);
    EXPECT_EQ(Plastic::complaint(cases[0].first.data()), "");
}

TEST(PlasticPoint, RemembersNothingOfElasticSteps)
{
    Point point;
    const std::array<double, 8> start = point.p;
    for (int k = 0; k < 1000; ++k)
        point.advance(stretches(1 + 1e-3 * std::sin(k), 1 - 1e-3 * std::sin(k)));
    EXPECT_EQ(point.p, start);
    EXPECT_EQ(point.dissipated, 0);
}

/// All nodes of a disc go along a path of homogeneous deformations: every point has the stress of a point alone, turned or not,
/// one grain alone or among others in lanes.
TEST(PlasticGrain, HasTheStressOfAPointInHomogeneousDeformation)
{
    const auto mesh = disc_mesh(60, 0.3, 0.1);
    for (int count : { 1, 9 }) {
        std::deque<Grain<2>> grains;
        for (int g = 0; g < count; ++g)
            grains.push_back(make_grain(mesh, plastic()));
        std::vector<Point> points { size_t(count), Point() };
        const auto path = [](int g, int k) -> Mat<2> {
            const double s = 0.03 * k * (1 + 0.1 * g);
            return turn(0.2 * k) * (Mat<2>() << 1 + s, 2 * s, 0.3 * s, 1 - s).finished();
        };
        Assembly<2> assembly(pointers(grains), false);
        double dissipated = 0;
        for (int k = 0; k <= 10; ++k) {
            for (int g = 0; g < count; ++g) {
                Grain<2>& grain = grains[size_t(g)];
                grain.pull();
                const Mat<2> F = path(g, k);
                for (int i = 0; i < mesh->master_count; ++i)
                    Eigen::Map<Vec<2>>(&grain.displacement[2 * size_t(i)])
                        = (F - Mat<2>::Identity()) * mesh->node_position[i];
                grain.put();
                points[size_t(g)].advance(F);
            }
            assembly.renew(1, 1);
            dissipated += assembly.dissipated().plastic;
        }
        double worst = 0, expected = 0;
        for (int g = 0; g < count; ++g) {
            Grain<2>& grain = grains[size_t(g)];
            grain.pull();
            const Mat<2> F = path(g, 10);
            const Mat<3> sigma = points[size_t(g)].stress(F) / F.determinant();
            for (const Mat<3>& found : grain.cauchy_stresses())
                worst = std::max(worst, (found - sigma).norm() / mu);
            for (double strain : grain.plastic_strains())
                worst = std::max(worst, std::abs(strain - points[size_t(g)].strain()));
            expected += grain.reference_volume() * points[size_t(g)].dissipated;
        }
        std::printf("%d grains: stress and plastic strain within %.1e, dissipation %.1e\n", count, worst,
                    dissipated / expected - 1);
        EXPECT_LE(worst, 1e-11);
        EXPECT_NEAR(dissipated / expected, 1, 1e-11);
    }
}

/// A disc that is torn into vibration flows, and then vibrates without loss. Kinetic, elastic and dissipated energies balance
/// with order two or better in the step.
TEST(PlasticGrain, KeepsItsEnergyButForWhatIsDissipated)
{
    double missing[2];
    for (int k : { 0, 1 }) {
        World world;
        GrainStart start;
        start.velocity = Vec<2>(1, 2);
        start.velocity_gradient = spin(1000) + (Mat<2>() << 3000, 500, -300, -2800).finished();
        world.add(make_grain(disc_mesh(124), plastic(), start));
        SmallestCriticalStep<2> stable;
        const double dt = stable({ &world.grains[0] }, 1) * (k == 0 ? 0.6 : 0.3);
        world.step(dt);
        const Sums before(world);
        const double energy = world.energy();
        double dissipated = 0, last = 0;
        for (int n = 0; n < 2000 * (k + 1); ++n) {
            world.step(dt);
            last = world.dissipated().plastic;
            dissipated += last;
        }
        const Sums after(world);
        missing[k] = (world.energy() + dissipated) / energy - 1;
        std::printf("dissipated %.3f of the energy, %.1e in the last step; missing %.1e; momentum %.1e, angular %.1e\n",
                    dissipated / energy, last / energy, missing[k],
                    (after.momentum - before.momentum).norm() / before.momentum.norm(), after.angular / before.angular - 1);
        EXPECT_GT(dissipated, 0.1 * energy);
        EXPECT_LE(std::abs(missing[k]), 2e-3);
        EXPECT_LE((after.momentum - before.momentum).norm(), 1e-11 * before.momentum.norm());
        EXPECT_NEAR(after.angular / before.angular, 1, 1e-10);
    }
    EXPECT_GE(std::log2(missing[0] / missing[1]), 1.7);
}

} // namespace
