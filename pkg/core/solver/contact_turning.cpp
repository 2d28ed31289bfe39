// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/contact_turning.hpp"

namespace softgrain {

template <int Dim>
void ContactTurning<Dim>::look(const std::vector<BarrierContact<Dim>>& contacts, const std::vector<Surface<Dim>*>& bodies)
{
    constexpr double least = 1e-6; // force that counts, over the largest
    double largest = 0;
    for (const auto& contact : contacts)
        largest = std::max(largest, contact.force);
    faces_.clear();
    for (size_t c = 0; c < contacts.size(); ++c) {
        const auto& contact = contacts[c];
        if (contact.other < 0 || contact.force < least * largest) continue;
        const Surface<Dim>& other = *bodies[size_t(contact.other)];
        const bool at_corner = contact.weight[1] == 1 && other.corner[size_t(contact.vertex[1])];
        if (at_corner) continue;
        faces_.push_back({ c, bend_below(*bodies[size_t(contact.body)], other, contact.face, contact.place) });
    }
}

// The foot stays where the point stands upright on the outline x(t) = sum of w_k(t) x_k, (x_p - x(t)) . x'(t) = 0, which says
// how t changes with the way; normal and weights follow.
template <int Dim>
void ContactTurning<Dim>::add(const std::vector<BarrierContact<Dim>>& contacts, const SurfaceField& way,
                              SurfaceField& forces) const
{
    for (const auto& [c, bend] : faces_) {
        const auto& contact = contacts[c];
        const Vec<Dim> n = contact.normal, t = contact.tangent();
        Vec<Dim> turned = Vec<Dim>::Zero(); // change of x'(t) where t stands
        for (int k = 0; k < face_vertices<Dim>; ++k)
            turned += bend.slope[k] * value_at<Dim>(way, contact.other, contact.vertex[k]);
        const double gap = contact.gap - contact.let;
        const double shift = (bend.length * t.dot(difference(contact, way)) + gap * n.dot(turned))
            / (bend.length * bend.length - gap * bend.second);
        const double angle = (n.dot(turned) + bend.second * shift) / bend.length;
        add_force<Dim>(contact, -contact.force * angle * t, forces);
        for (int k = 0; k < face_vertices<Dim>; ++k)
            value_at<Dim>(forces, contact.other, contact.vertex[k]) -= contact.force * shift * bend.slope[k] * n;
    }
}

template class ContactTurning<2>;

} // namespace softgrain
