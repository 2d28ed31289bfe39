// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/contact_problem.hpp"

#include <memory>

namespace softgrain {

/// Non-linear Gauss-Seidel (Jean 1999) by blocks: for two bodies after the other the laws of their contacts are solved
/// with all others held, contact by contact in turn, until the impulses of a whole sweep change by less than the
/// tolerance, relative to their size. Where that takes long, because the contacts of two bodies are nearly redundant, theirs
/// are solved more thoroughly.
///
/// Bodies are divided into strips of space. A sweep treats the contacts inside the strips, then those between a strip
/// and the next, even ones first: those of different strips do not meet and run side by side. The strips follow from
/// the scene alone, so the result is the same for every number of threads.
template <int Dim> class NonlinearGaussSeidel {
public:
    explicit NonlinearGaussSeidel(double tolerance = 1e-3, int max_sweeps = 1000);
    ~NonlinearGaussSeidel();

    double tolerance;
    int max_sweeps;
    int threads = 1;

    /// Starts from the contacts' impulses, leaves the solution there, and the velocities of the surfaces to match.
    /// Returns the number of sweeps.
    int solve(ContactProblem<Dim>& problem);

private:
    class Sweeper;
    std::unique_ptr<Sweeper> sweeper_;
};

extern template class NonlinearGaussSeidel<2>;

} // namespace softgrain
