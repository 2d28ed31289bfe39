// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/contact_problem.hpp"

namespace softgrain {

/// Non-linear Gauss-Seidel (Jean 1999): contact by contact the local law is solved exactly with the others held,
/// until the impulses of a whole sweep change by less than the tolerance, relative to the largest of them.
///
/// Bodies are divided into strips of space. A sweep treats the contacts inside the strips, then those between a strip
/// and the next, even ones first: those of different strips do not meet and run side by side. The strips follow from
/// the scene alone, so the result is the same for every number of threads.
struct NonlinearGaussSeidel {
    double tolerance = 1e-3;
    int max_sweeps = 1000;
    int threads = 1;

    /// Starts from the contacts' impulses, leaves the solution there, and the velocities of the surfaces to match.
    /// Returns the number of sweeps.
    template <int Dim> int solve(ContactProblem<Dim>& problem) const;
};

extern template int NonlinearGaussSeidel::solve<2>(ContactProblem<2>&) const;

} // namespace softgrain
