// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace softgrain {

/// Cholesky factorisation of a sparse symmetric matrix that is stored row by row, from the first entry of each row to the
/// diagonal (skyline storage; Jennings 1966).
class SkylineCholesky {
public:
    /// first[i]: column of the first entry of row i.
    explicit SkylineCholesky(const std::vector<int>& first)
        : first_(first)
    {
        size_t size = 0;
        for (size_t i = 0; i < first.size(); ++i) {
            row_.push_back(size - first[i]); // so that row_[i] + j is the place of (i, j)
            size += i + 1 - first[i];
        }
        value_.assign(size, 0);
    }
    /// Entry (i, j) of the lower triangle, j <= i.
    double& at(int i, int j) { return value_[row_[i] + j]; }

    /// False when the matrix is not positive definite.
    bool factorise()
    {
        for (int i = 0; i < size(); ++i) {
            double* const a = value_.data() + row_[i];
            for (int j = first_[i]; j <= i; ++j) {
                const double* const b = value_.data() + row_[j];
                double sum = a[j];
                for (int k = std::max(first_[i], first_[j]); k < j; ++k)
                    sum -= a[k] * b[k];
                if (j < i)
                    a[j] = sum / b[j];
                else if (!(sum > 0))
                    return false;
                else
                    a[i] = std::sqrt(sum);
            }
        }
        return true;
    }

    /// Solves with the factors, in place; T: a number or a vector.
    template <class T> void solve(std::vector<T>& x) const
    {
        for (int i = 0; i < size(); ++i) {
            const double* const a = value_.data() + row_[i];
            for (int k = first_[i]; k < i; ++k)
                x[i] -= a[k] * x[k];
            x[i] /= a[i];
        }
        for (int i = size() - 1; i >= 0; --i) {
            const double* const a = value_.data() + row_[i];
            x[i] /= a[i];
            for (int k = first_[i]; k < i; ++k)
                x[k] -= a[k] * x[i];
        }
    }

private:
    int size() const { return int(first_.size()); }
    std::vector<int> first_;
    std::vector<size_t> row_;
    std::vector<double> value_;
};

} // namespace softgrain
