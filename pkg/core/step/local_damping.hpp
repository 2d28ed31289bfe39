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
#include "step/grain.hpp"

namespace softgrain {

template <int Dim> class LocalDamping {
public:
    /// Velocities before the step.
    void begin(const Batch<Dim>& batch) { start_ = batch.velocity; }
    /// Velocities before contact impulses.
    void strike(const Batch<Dim>& batch) { kicked_ = batch.velocity; }
    /// Damps the velocities at the end of the step, as Velocities leaves them. Returns what is dissipated [J]: the balance of
    /// the step counts internal forces and loads with the mean of the velocities before and after it, contacts with those
    /// without damping.
    double end(Batch<Dim>& batch, const std::vector<Grain<Dim>*>& members, double damping);

private:
    double damp(Batch<Dim>& batch, int lane, double damping);

    AlignedVector start_, kicked_;
};

extern template class LocalDamping<2>;

} // namespace softgrain
