// SPDX-License-Identifier: GPL-2.0-or-later
// A contact problem as plain data: who touches whom, and where. Solvers stand apart and are judged by one
// residual.
#pragma once

#include "contact/surface.hpp"
#include "law/contact_law.hpp"

#include <array>

namespace softgrain {

/// Projection on the Coulomb cone { r : |r_t| <= mu r_n }.
template <int Dim> Vec<Dim> cone_projection(const Vec<Dim>& r, const Vec<Dim>& n, double mu)
{
    const double normal = r.dot(n);
    const Vec<Dim> tangential = r - normal * n;
    const double size = tangential.norm();
    if (mu * size <= -normal) return Vec<Dim>::Zero(); // first: without friction it holds the whole axis below
    if (size <= mu * normal) return r;
    const double kept = (normal + mu * size) / (1 + mu * mu);
    return kept * n + (size > 0 ? mu * kept / size : 0) * tangential;
}

/// What a gap [m] adds to the relative velocity along the normal [m/s]: all of it may close in the step; of a penetration the share
/// `recovery` is taken back.
inline double gap_speed(double gap, double recovery, double dt) { return (gap > 0 ? gap : recovery * gap) / dt; }

template <int Dim> struct Contact {
    int body;  ///< that the point is on, place in ContactProblem::bodies
    int other; ///< that the face is on; -1: a rigid plane
    int point;
    int face;                                      ///< segment (2D)
    std::array<int, face_vertices<Dim>> vertex;    ///< that the face follows
    std::array<double, face_vertices<Dim>> weight; ///< of the vertices, sum 1
    Vec<Dim> normal;                               ///< from the face to the point
    Vec<Dim> offset; ///< of the relative velocity that the law sees: gap / dt along the normal [m/s]
    Vec<Dim> drive;  ///< velocity of the rigid plane [m/s]
    double friction;
    const ContactLaw<Dim>* law;
    Vec<Dim> impulse;                 ///< on the point side: start value, then solution [N s]
    double inertia = 0;               ///< 1 / (normal entry of the Delassus operator) [kg]; set by the solver
    Vec<Dim> free = Vec<Dim>::Zero(); ///< relative velocity with the gap, without any impulses [m/s]; set by the solver
};

template <int Dim> struct ContactProblem {
    std::vector<Surface<Dim>*> bodies;
    std::vector<Contact<Dim>> contacts;

    /// Velocity of a contact's point relative to its face, from one of the velocity fields of the surfaces.
    Vec<Dim> relative(const Contact<Dim>& contact, std::vector<double> Surface<Dim>::*field) const
    {
        const auto value
            = [&](int body, int p) { return Eigen::Map<const Vec<Dim>>(&(bodies[body]->*field)[size_t(Dim) * p]); };
        Vec<Dim> u = value(contact.body, contact.point);
        if (contact.other < 0) return u - contact.drive;
        for (int k = 0; k < face_vertices<Dim>; ++k)
            u -= contact.weight[k] * value(contact.other, contact.vertex[k]);
        return u;
    }

    /// Where a contact is on the other body.
    Vec<Dim> foot(const Contact<Dim>& contact) const
    {
        Vec<Dim> sum = Vec<Dim>::Zero();
        for (int k = 0; k < face_vertices<Dim>; ++k)
            sum += contact.weight[k] * bodies[contact.other]->x(contact.vertex[k]);
        return sum;
    }

    /// Adds a contact. A free rigid body meets a soft one where that is: its side of the contact becomes a point that is added to
    /// its surface there. Else impulses would act on the two in places a gap apart, and friction turn the pair.
    void add(Contact<Dim> contact);

    /// || r - P_K(r - u - mu |u_t| n) || over the contacts, divided by max(|q|, |r|, |u|): Siconos's measure of a
    /// frictional contact problem (Acary and Brogliato 2008; u with the gap, q its value without impulses).
    /// Velocities count in units of impulse through the mean contact inertia.
    double residual() const;
};

extern template struct ContactProblem<2>;

} // namespace softgrain
