// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/barrier_contact.hpp"

namespace softgrain {

/// How normal forces of contacts turn and shift as the surfaces move, their sizes held: the second derivative of the gaps
/// times the forces. Of a way of the surfaces, let d be the slide of the point along the face, w the rotation of the face, and
/// k the curvature of the outline. A gap changes by n . (difference of the ways) + (k d^2 - 2 w d) / 2 (for gap 0).
template <int Dim> class ContactTurning {
public:
    /// Outlines at the feet of the contacts that bear a force. Planes do not turn.
    void look(const std::vector<BarrierContact<Dim>>& contacts, const std::vector<Surface<Dim>*>& bodies);
    /// Adds the change of the forces that a way of the surfaces brings.
    void add(const std::vector<BarrierContact<Dim>>& contacts, const SurfaceField& way, SurfaceField& forces) const;

private:
    struct Face {
        size_t contact;
        Bend bend;
    };
    std::vector<Face> faces_;
};

extern template class ContactTurning<2>;

} // namespace softgrain
