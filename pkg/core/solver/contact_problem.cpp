// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/contact_problem.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {

template <int Dim> void ContactProblem<Dim>::add(Contact<Dim> contact)
{
    if (bodies[contact.body]->rigid)
        contact.point = bodies[contact.body]->add(foot(contact));
    else if (contact.other >= 0 && bodies[contact.other]->rigid) {
        contact.vertex = { bodies[contact.other]->add(bodies[contact.body]->x(contact.point)) };
        contact.weight = { 1 };
    }
    contacts.push_back(contact);
}

template <int Dim> double ContactProblem<Dim>::residual() const
{
    double inertia = 0;
    for (const auto& contact : contacts)
        inertia += contact.inertia / double(contacts.size());
    double error = 0, r2 = 0, u2 = 0, q2 = 0;
    for (const auto& contact : contacts) {
        const Vec<Dim>&n = contact.normal, &r = contact.impulse;
        const Vec<Dim> u = inertia * (relative(contact, &Surface<Dim>::velocity) + contact.offset);
        const Vec<Dim> slide = u - u.dot(n) * n;
        const Vec<Dim> target = r - u - contact.friction * slide.norm() * n;
        error += (r - cone_projection(target, n, contact.friction)).squaredNorm();
        r2 += r.squaredNorm();
        u2 += u.squaredNorm();
        q2 += (inertia * contact.free).squaredNorm();
    }
    const double scale = std::sqrt(std::max({ r2, u2, q2 }));
    return scale > 0 ? std::sqrt(error) / scale : 0;
}

template struct ContactProblem<2>;

} // namespace softgrain
