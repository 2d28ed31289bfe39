// SPDX-License-Identifier: GPL-2.0-or-later
// Numerical damping for relaxation, after Cundall's local damping (Cundall and Strack 1979; Cundall 1987). Where a step has changed
// a velocity v by dv, the speed falls by
//
//     damping |dv . v| / |v|,    to 0 at most:
//
// a force against the motion, in proportion to the unbalanced force along it. That acts on a grain as a whole, on its centre's
// velocity and its spin, and on its nodes in their motion relative to that of the grain; what it does to them gives the grain
// no momentum. Flight without forces is not touched, and equilibria stay where they are. Batches without it do not come here.
#pragma once

#include "step/batch.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {

/// Of the speed, given the square of it and the product of velocity and its change.
inline double lost_share(double damping, double product, double square)
{
    return square > 1e-200 ? std::min(1.0, damping * std::abs(product) / square) : 0;
}

template <int Dim> class LocalDamping {
public:
    /// Velocities before the step.
    void begin(const Batch<Dim>& batch) { start_ = batch.velocity; }
    /// Velocities before contact impulses.
    void strike(const Batch<Dim>& batch) { kicked_ = batch.velocity; }
    /// Damps the velocities of the grain in a lane at the end of the step, as Velocities leaves them. Returns what is
    /// dissipated, per density and radius^(Dim + 2): the balance of the step counts internal forces and loads with the mean of
    /// the velocities before and after it, contacts with those without damping.
    double damp(Batch<Dim>& batch, int lane, double damping);

private:
    AlignedVector start_, kicked_;
};

extern template class LocalDamping<2>;

} // namespace softgrain
