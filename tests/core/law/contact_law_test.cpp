// SPDX-License-Identifier: GPL-2.0-or-later
#include "law/contact_law.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

template <class T> class LocalLaw : public ::testing::Test {
};
using Dimensions = ::testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(LocalLaw, Dimensions);

/// A random local problem u = w (r - trial), u with the gap: w the (isotropic) Delassus operator.
template <int Dim> struct Problem {
    Vec<Dim> normal, trial;
    double friction, w;

    explicit Problem(Random& random)
        : normal(random.unit<Dim>())
        , trial(random.log_uniform(1e-3, 1e3) * random.vector<Dim>(1))
        , friction(random.integer(0, 3) == 0 ? 0 : random.uniform(0, 1.5))
        , w(random.log_uniform(0.1, 10))
    {
    }
    Vec<Dim> solve() const { return SignoriniCoulomb<Dim>().reaction({ normal, friction, trial }); }
    Vec<Dim> velocity(const Vec<Dim>& r) const { return w * (r - trial); }
    Vec<Dim> tangential(const Vec<Dim>& a) const { return a - a.dot(normal) * normal; }
    double round_off() const { return 1e-14 * trial.norm() * (1 + w) * (1 + trial.norm()); }
};

// 0 <= r_n  perp  u_n + g/dt >= 0 (Moreau 1994; Jean 1999, eq. 2.11).
TYPED_TEST(LocalLaw, IsComplementary)
{
    constexpr int Dim = TypeParam::value;
    Random random(1);
    int open = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Problem<Dim> problem(random);
        const Vec<Dim> r = problem.solve(), u = problem.velocity(r);
        const double rn = r.dot(problem.normal), un = u.dot(problem.normal);
        ASSERT_GE(rn, -problem.round_off());
        ASSERT_GE(un, -problem.round_off());
        ASSERT_NEAR(rn * un, 0, problem.round_off());
        open += r == Vec<Dim>::Zero();
    }
    EXPECT_GT(open, 8000); // about half are in tension
    EXPECT_LT(open, 12000);
}

// |r_t| <= mu r_n, and r_t dissipates most: r_t . u_t <= s . u_t for every s of the disc |s| <= mu r_n.
TYPED_TEST(LocalLaw, StaysInTheConeAndDissipatesMost)
{
    constexpr int Dim = TypeParam::value;
    Random random(2);
    int sticks = 0, slides = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Problem<Dim> problem(random);
        const Vec<Dim> r = problem.solve(), u = problem.velocity(r);
        const Vec<Dim> rt = problem.tangential(r), ut = problem.tangential(u);
        const double most = problem.friction * r.dot(problem.normal);
        ASSERT_LE(rt.norm(), most + problem.round_off());
        for (int other = 0; other < 5; ++other) {
            Vec<Dim> s = problem.tangential(random.vector<Dim>(1));
            if (s.norm() > 1e-3) s *= most / s.norm() * random.uniform(0, 1);
            if (s.norm() <= most) {
                ASSERT_LE(rt.dot(ut), s.dot(ut) + problem.round_off());
            }
        }
        if (most == 0) continue;
        (ut.norm() <= problem.round_off() ? sticks : slides)++;
        // sliding is opposite to r_t, with |r_t| at the cone
        if (ut.norm() > problem.round_off()) {
            ASSERT_NEAR(rt.dot(ut), -rt.norm() * ut.norm(), problem.round_off());
            ASSERT_NEAR(rt.norm(), most, problem.round_off());
        }
    }
    EXPECT_GT(sticks, 500);
    EXPECT_GT(slides, 500);
}

TYPED_TEST(LocalLaw, IsIsotropicAndHomogeneous)
{
    constexpr int Dim = TypeParam::value;
    Random random(3);
    for (int trial = 0; trial < 1000; ++trial) {
        const Problem<Dim> problem(random);
        Problem<Dim> turned = problem, scaled = problem;
        const Mat<Dim> Q = random.rotation<Dim>();
        turned.normal = Q * problem.normal;
        turned.trial = Q * problem.trial;
        scaled.trial *= 7;
        EXPECT_LE((turned.solve() - Q * problem.solve()).norm(), 1e-13 * problem.trial.norm());
        EXPECT_LE((scaled.solve() - 7 * problem.solve()).norm(), 1e-13 * problem.trial.norm());
    }
}

TYPED_TEST(LocalLaw, WithoutFrictionPushesAlongTheNormal)
{
    constexpr int Dim = TypeParam::value;
    Random random(4);
    for (int trial = 0; trial < 1000; ++trial) {
        Problem<Dim> problem(random);
        problem.friction = 0;
        const double expected = std::max(0.0, problem.trial.dot(problem.normal));
        EXPECT_LE((problem.solve() - expected * problem.normal).norm(), 1e-14 * problem.trial.norm());
    }
}

} // namespace
