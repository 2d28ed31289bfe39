// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "base/types.hpp"

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

namespace softgrain::testing_support {

/// Random numbers of a test. The seed is printed, and SOFTGRAIN_TEST_SEED puts another in its place.
class Random {
public:
    explicit Random(unsigned seed)
    {
        if (const char* other = std::getenv("SOFTGRAIN_TEST_SEED")) seed = unsigned(std::strtoul(other, nullptr, 10));
        std::cout << "[   SEED   ] " << seed << std::endl;
        generator_.seed(seed);
    }

    double uniform(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(generator_); }
    double log_uniform(double lo, double hi) { return std::exp(uniform(std::log(lo), std::log(hi))); }
    int integer(int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(generator_); }

    template <int Dim> Vec<Dim> vector(double size)
    {
        Vec<Dim> v;
        for (int d = 0; d < Dim; ++d)
            v[d] = uniform(-size, size);
        return v;
    }
    template <int Dim> Vec<Dim> unit()
    {
        for (;;) {
            const Vec<Dim> v = vector<Dim>(1);
            if (v.norm() > 0.1 && v.norm() <= 1) return v.normalized();
        }
    }
    template <int Dim> Mat<Dim> matrix(double size)
    {
        Mat<Dim> A;
        for (int d = 0; d < Dim; ++d)
            A.col(d) = vector<Dim>(size);
        return A;
    }
    /// A rotation, uniform in 2D.
    template <int Dim> Mat<Dim> rotation()
    {
        Mat<Dim> Q = matrix<Dim>(1).householderQr().householderQ();
        if (Q.determinant() < 0) Q.col(0) *= -1;
        return Q;
    }

    std::mt19937& generator() { return generator_; }

private:
    std::mt19937 generator_;
};

} // namespace softgrain::testing_support
