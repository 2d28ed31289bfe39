// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "step/grain.hpp"

#include <memory>
#include <vector>

namespace softgrain {

/// Grains in the lanes of batches, those of one mesh and law together; of these batches all but the last are full. What a grain
/// computes does not depend on its lane.
template <int Dim> class Seating {
public:
    /// For these grains; takes none of them in yet.
    explicit Seating(const std::vector<Grain<Dim>*>& grains);
    /// Takes a grain in, with the fields that it holds.
    void put_in(Grain<Dim>& grain);
    /// Hands the fields back to the grain.
    void take_out(Grain<Dim>& grain);

    int count() const { return int(batches_.size()); }
    Batch<Dim>& batch(int b) { return *batches_[size_t(b)]; }
    /// In the order of the lanes; there may be none.
    const std::vector<Grain<Dim>*>& members(int b) const { return members_[size_t(b)]; }

private:
    struct Group {
        const Discretisation<Dim>* mesh;
        const LawKernels<Dim>* law;
        int grains, lanes;
        std::vector<int> batches; ///< in the order in which they are filled
        int seated;
    };
    Group& group_of(const Grain<Dim>& grain);
    void seat(Grain<Dim>& grain, int b, int lane);

    std::vector<Group> groups_;
    std::vector<std::unique_ptr<Batch<Dim>>> batches_;
    std::vector<std::vector<Grain<Dim>*>> members_; ///< of each batch
};

extern template class Seating<2>;

} // namespace softgrain
