// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/assembly.hpp"
#include "step/stiffness_pattern.hpp"

namespace softgrain {

/// Grains as an implicit step sees them, side by side in lanes: those of a batch, or a single one in the updated-Lagrangian
/// form. Vectors are [row of the pattern][Dim][lane], in radii; without displacement nodes and surface points stand where the
/// pattern has them.
template <int Dim> class ImplicitBody {
public:
    virtual ~ImplicitBody() = default;

    int lanes;
    std::vector<Grain<Dim>*> members; ///< the lanes' grains; lanes beyond are spare
    std::shared_ptr<const StiffnessPattern<Dim>> pattern;
    double* parameters; ///< of the law, [parameter][lane] [Pa]

    /// Begins a step: the pattern may be another one from here on.
    virtual void begin() { }
    /// Displacement and velocity of the grains as they are.
    virtual void state(AlignedVector& displacement, AlignedVector& velocity) const = 0;
    /// Internal forces under a displacement [Pa].
    virtual void forces(const AlignedVector& displacement, AlignedVector& force) = 0;
    /// Elastic energies per radius^Dim [J/m^Dim] and smallest principal stretches, [lane].
    virtual void energy(const AlignedVector& displacement, double* energy, double* min_stretch) = 0;
    /// Where the grains are at the end of the step, for `Assembly::renew`.
    virtual void leave(const AlignedVector& displacement, const AlignedVector& velocity) = 0;

    int wide() const { return lanes == 8; }
    const LawKernels<Dim>& law() const { return *members[0]->law; }

protected:
    ImplicitBody(int lanes, const std::vector<Grain<Dim>*>& members, double* parameters)
        : lanes(lanes)
        , members(members)
        , parameters(parameters)
    {
    }
};

/// All grains of an assembly, grains of one discretisation sharing the pattern.
template <int Dim> std::vector<std::unique_ptr<ImplicitBody<Dim>>> implicit_bodies(Assembly<Dim>& assembly);

extern template std::vector<std::unique_ptr<ImplicitBody<2>>> implicit_bodies(Assembly<2>& assembly);

} // namespace softgrain
