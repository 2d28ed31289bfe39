// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/nlgs.hpp"

#include <cmath>

namespace softgrain {
namespace {

    /// Velocities of a surface after an impulse p on one of its points.
    template <int Dim> inline void strike(Surface<Dim>& surface, int point, const Vec<Dim>& p)
    {
        const auto& mesh = *surface.mesh;
        const Vec<Dim> step = surface.mobility * p;
        double* v = surface.velocity.data();
        for (int k = mesh.delassus_row[point]; k < mesh.delassus_row[point + 1]; ++k) {
            const double value = mesh.delassus_value[k];
            double* at = v + Dim * mesh.delassus_column[k];
            for (int d = 0; d < Dim; ++d)
                at[d] += value * step[d];
        }
    }

    template <int Dim> inline void apply(const Contact<Dim>& contact, const Vec<Dim>& p)
    {
        if (contact.body->mobility > 0) strike<Dim>(*contact.body, contact.point, p);
        if (contact.other && contact.other->mobility > 0)
            for (int k = 0; k < Dim; ++k)
                if (contact.weight[k] != 0) strike<Dim>(*contact.other, contact.vertex[k], -contact.weight[k] * p);
    }

    template <int Dim> double inertia_of(const Contact<Dim>& contact)
    {
        double delassus = 0;
        if (contact.body->mobility > 0)
            delassus += contact.body->mobility * contact.body->mesh->delassus(contact.point, contact.point);
        if (contact.other && contact.other->mobility > 0)
            for (int k = 0; k < Dim; ++k)
                for (int l = 0; l < Dim; ++l)
                    delassus += contact.other->mobility * contact.weight[k] * contact.weight[l]
                        * contact.other->mesh->delassus(contact.vertex[k], contact.vertex[l]);
        return 1 / delassus;
    }

} // namespace

template <int Dim> int NonlinearGaussSeidel::solve(std::vector<Contact<Dim>>& contacts) const
{
    for (auto& contact : contacts) {
        contact.inertia = inertia_of(contact);
        if (contact.impulse != Vec<Dim>::Zero()) apply(contact, contact.impulse);
    }
    int sweep = 0;
    while (sweep < max_sweeps && !contacts.empty()) {
        ++sweep;
        double change = 0, size = 0;
        for (auto& contact : contacts) {
            const Vec<Dim> u = contact.relative(&Surface<Dim>::velocity) + contact.gap_speed * contact.normal;
            const Vec<Dim> old = contact.impulse;
            contact.impulse = contact.law->reaction({ contact.normal, contact.friction, old - contact.inertia * u });
            const Vec<Dim> step = contact.impulse - old;
            if (step == Vec<Dim>::Zero()) continue;
            apply(contact, step);
            change += step.squaredNorm();
            size += contact.impulse.squaredNorm();
        }
        if (change <= tolerance * tolerance * size) break;
    }
    return sweep;
}

template int NonlinearGaussSeidel::solve<2>(std::vector<Contact<2>>&) const;

} // namespace softgrain
