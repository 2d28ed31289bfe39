// SPDX-License-Identifier: GPL-2.0-or-later
#include "base/aligned.hpp"
#include "base/lanes.hpp"
#include "support/random.hpp"

#include <gtest/gtest.h>

#include <functional>

using namespace softgrain;
using softgrain::testing_support::Random;

namespace {

constexpr double unit_roundoff = 0x1p-53;

/// Values go through vectors of `Count`, eight in all.
template <int Count, class Operation> SOFTGRAIN_INLINE void map(const Operation& operation, const double* x, double* y)
{
    for (int first = 0; first < 8; first += Count) {
        typename Lanes<Count>::Value in;
        for (int l = 0; l < Count; ++l)
            in[l] = x[first + l];
        const auto out = operation(in);
        for (int l = 0; l < Count; ++l)
            y[first + l] = out[l];
    }
}

/// Eight values through vectors of 2, 4 and 8.
template <class Operation> SOFTGRAIN_INLINE void map_all(const Operation& operation, const double* x, double* y)
{
    map<2>(operation, x, y);
    map<4>(operation, x, y + 8);
    map<8>(operation, x, y + 16);
}

struct Logarithm {
    template <class T> SOFTGRAIN_INLINE T operator()(const T& x) const { return logarithm(x); }
};
struct Exponential {
    template <class T> SOFTGRAIN_INLINE T operator()(const T& x) const { return exponential(x); }
};
struct SquareRoot {
    template <class T> SOFTGRAIN_INLINE T operator()(const T& x) const { return square_root(x); }
};

/// The kernels are compiled for one of these instruction sets; all of them have to be right.
using Function = void (*)(const double* x, double* y);
template <class Operation> __attribute__((target("arch=x86-64-v4"))) void on_v4(const double* x, double* y)
{
    map_all(Operation(), x, y);
}
template <class Operation> __attribute__((target("arch=x86-64-v3"))) void on_v3(const double* x, double* y)
{
    map_all(Operation(), x, y);
}
template <class Operation> void on_any(const double* x, double* y) { map_all(Operation(), x, y); }

template <class Operation> std::vector<std::pair<std::string, Function>> on_all_sets()
{
    std::vector<std::pair<std::string, Function>> sets { { "plain", on_any<Operation> } };
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) sets.push_back({ "v3", on_v3<Operation> });
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw"))
        sets.push_back({ "v4", on_v4<Operation> });
    return sets;
}

double units_in_the_last_place(double found, long double exact)
{
    const double nearest = std::abs(double(exact));
    const double unit = std::nextafter(nearest, INFINITY) - nearest;
    return double(std::abs(found - exact) / unit);
}

/// In units in the last place.
double worst_error(Function function, long double (*exact)(long double), const std::function<double()>& sample, int count)
{
    double worst = 0;
    for (int i = 0; i < count; i += 8) {
        double x[8], y[24];
        for (double& value : x)
            value = sample();
        function(x, y);
        for (int k = 0; k < 24; ++k)
            worst = std::max(worst, units_in_the_last_place(y[k], exact((long double)x[k % 8])));
    }
    return worst;
}

// The header promises 2 units in the last place; the oracle is the C library's logarithm in 64-bit mantissas.
TEST(LogarithmOfLanes, IsGoodTo2UnitsOverTheWholeRange)
{
    Random random(1);
    for (const auto& [set, function] : on_all_sets<Logarithm>())
        EXPECT_LE(worst_error(
                      function, std::log, [&] { return random.log_uniform(1e-300, 1e300); }, 400000),
                  2)
            << set;
}

TEST(LogarithmOfLanes, IsGoodTo2UnitsNearOneAndWhereTheMantissaIsSplit)
{
    Random random(2);
    for (const auto& [set, function] : on_all_sets<Logarithm>())
        for (double centre : { 1.0, std::sqrt(0.5), std::sqrt(2.0), 0.5, 2.0 })
            for (double width : { 0.3, 1e-3, 1e-7, 1e-14 })
                EXPECT_LE(worst_error(
                              function, std::log, [&] { return centre * (1 + random.uniform(-width, width)); }, 40000),
                          2)
                    << set << " near " << centre << " within " << width;
}

TEST(ExponentialOfLanes, IsGoodTo2Units)
{
    Random random(3);
    for (const auto& [set, function] : on_all_sets<Exponential>())
        for (double width : { 700.0, 1.0, 1e-3, 1e-9 })
            EXPECT_LE(worst_error(
                          function, std::exp, [&] { return random.uniform(-width, width); }, 40000),
                      2)
                << set << " within " << width;
}

TEST(ExponentialOfLanes, OfZeroIsOne)
{
    for (const auto& [set, function] : on_all_sets<Exponential>()) {
        const double x[8] {};
        double y[24];
        function(x, y);
        for (double value : y)
            EXPECT_EQ(value, 1) << set;
    }
}

TEST(LogarithmOfLanes, OfOneIsZero)
{
    for (const auto& [set, function] : on_all_sets<Logarithm>()) {
        const double x[8] { 1, 1, 1, 1, 1, 1, 1, 1 };
        double y[24];
        function(x, y);
        for (double value : y)
            EXPECT_EQ(value, 0) << set;
    }
}

TEST(SquareRootOfLanes, IsRoundedCorrectly)
{
    Random random(4);
    for (const auto& [set, function] : on_all_sets<SquareRoot>())
        for (int trial = 0; trial < 1000; ++trial) {
            double x[8], y[24];
            for (double& value : x)
                value = random.log_uniform(1e-300, 1e300);
            function(x, y);
            for (int k = 0; k < 24; ++k)
                ASSERT_EQ(y[k], std::sqrt(x[k % 8])) << set;
        }
}

// A product of two factors rounds once, so that 1/x_i built from n - 1 products, one division and n - 1 products
// is off by at most (2 n - 1) roundings.
template <int Count> void test_reciprocals(Random& random)
{
    using Wide = Lanes<4>::Value;
    for (int trial = 0; trial < 2000; ++trial) {
        Wide x[Count], wide[Count];
        double narrow[Count], one[Count];
        for (int i = 0; i < Count; ++i) {
            for (int l = 0; l < 4; ++l)
                x[i][l] = random.log_uniform(1e-3, 1e3) * (random.integer(0, 1) ? 1 : -1);
            one[i] = x[i][3];
        }
        reciprocals<Count>(x, wide);
        reciprocals<Count>(one, narrow);
        for (int i = 0; i < Count; ++i) {
            for (int l = 0; l < 4; ++l)
                ASSERT_LE(std::abs(wide[i][l] * (long double)x[i][l] - 1), (2 * Count - 1) * unit_roundoff * 1.001);
            ASSERT_LE(std::abs(narrow[i] * (long double)one[i] - 1), (2 * Count - 1) * unit_roundoff * 1.001);
        }
    }
}

TEST(Reciprocals, AreGoodToTheirRoundings)
{
    Random random(3);
    test_reciprocals<1>(random);
    test_reciprocals<2>(random);
    test_reciprocals<5>(random); // a region in 2D: four points and their mean
    test_reciprocals<9>(random);
}

TEST(Lanes, TakeSmallerAndLargerValuesLaneByLane)
{
    using Wide = Lanes<8>::Value;
    const Wide a { 1, -2, 3, 0, 5, -6, 7, 8 }, b { 2, -3, 3, -1, 4, -5, 9, 7 };
    const Wide least = smaller(a, b), most = larger(a, b), same = broadcast<Wide>(2.5);
    for (int l = 0; l < 8; ++l) {
        EXPECT_EQ(least[l], std::min(a[l], b[l]));
        EXPECT_EQ(most[l], std::max(a[l], b[l]));
        EXPECT_EQ(same[l], 2.5);
    }
    EXPECT_EQ(smaller(1.0, 2.0), 1);
    EXPECT_EQ(larger(1.0, 2.0), 2);
    EXPECT_EQ(broadcast<double>(2.5), 2.5);
    const int widths[] { lane_count<double>, lane_count<Lanes<2>::Value>, lane_count<Lanes<4>::Value>, lane_count<Wide> };
    EXPECT_EQ(std::vector<int>(widths, widths + 4), (std::vector<int> { 1, 2, 4, 8 }));
}

TEST(AlignedVector, StandsOnTheBoundaryThatLanesAskFor)
{
    for (int size : { 1, 8, 100, 12345 })
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(AlignedVector(size).data()) % alignof(Lanes<8>::Value), 0u);
}

} // namespace
