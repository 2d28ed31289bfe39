// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/nlgs.hpp"

#include <cmath>

namespace softgrain {
namespace {

    /// One surface point of a contact, with its row of the Delassus operator; plain pointers for the sweeps.
    struct Row {
        const int* column;
        const double* value;
        double* velocity; ///< of the whole surface
        double weight;    ///< share in the relative velocity: 1 for the point, minus its weight for a vertex
        double mobility;
        int count, at;    ///< entries of the row, place of the point in `velocity`
    };

    template <int Dim> struct Local {
        Row row[Dim + 1];
        int rows;
        Vec<Dim> offset; ///< gap speed along the normal, less the drive of a rigid plane
        Contact<Dim>* contact;

        explicit Local(Contact<Dim>& c)
            : rows(0)
            , offset(c.gap_speed * c.normal - c.drive)
            , contact(&c)
        {
            add(*c.body, c.point, 1);
            if (c.other)
                for (int k = 0; k < Dim; ++k)
                    if (c.weight[k] != 0) add(*c.other, c.vertex[k], -c.weight[k]);
        }

        void add(Surface<Dim>& surface, int point, double weight)
        {
            Row& fresh = row[rows++];
            fresh = { nullptr, nullptr, surface.velocity.data(), weight, surface.mobility, 0, Dim * point };
            if (surface.mobility == 0) return;
            const auto& mesh = *surface.mesh;
            const int first = mesh.delassus_row[point];
            fresh.column = mesh.delassus_column.data() + first;
            fresh.value = mesh.delassus_value.data() + first;
            fresh.count = mesh.delassus_row[point + 1] - first;
        }

        /// Relative velocity with the gap.
        Vec<Dim> approach() const
        {
            Vec<Dim> u = offset;
            for (int k = 0; k < rows; ++k)
                for (int d = 0; d < Dim; ++d)
                    u[d] += row[k].weight * row[k].velocity[row[k].at + d];
            return u;
        }

        /// Velocities after an impulse on the point, and against it on the face.
        void strike(const Vec<Dim>& impulse) const
        {
            for (int k = 0; k < rows; ++k) {
                double step[Dim];
                for (int d = 0; d < Dim; ++d)
                    step[d] = row[k].mobility * row[k].weight * impulse[d];
                double* const velocity = row[k].velocity;
                for (int j = 0; j < row[k].count; ++j) {
                    double* v = velocity + Dim * row[k].column[j];
                    for (int d = 0; d < Dim; ++d)
                        v[d] += row[k].value[j] * step[d];
                }
            }
        }

        /// Diagonal entry of the Delassus operator.
        double delassus() const
        {
            double sum = 0;
            for (int k = 0; k < rows; ++k)
                for (int l = 0; l < rows; ++l) {
                    if (row[k].velocity != row[l].velocity) continue;
                    for (int j = 0; j < row[k].count; ++j)
                        if (Dim * row[k].column[j] == row[l].at)
                            sum += row[k].mobility * row[k].weight * row[l].weight * row[k].value[j];
                }
            return sum;
        }
    };

} // namespace

template <int Dim> int NonlinearGaussSeidel::solve(std::vector<Contact<Dim>>& contacts) const
{
    std::vector<Local<Dim>> locals;
    locals.reserve(contacts.size());
    for (auto& contact : contacts) {
        locals.emplace_back(contact);
        contact.inertia = 1 / locals.back().delassus();
    }
    for (const auto& local : locals)
        if (local.contact->impulse != Vec<Dim>::Zero()) local.strike(local.contact->impulse);
    int sweep = 0;
    while (sweep < max_sweeps && !contacts.empty()) {
        ++sweep;
        double change = 0, size = 0;
        for (const auto& local : locals) {
            Contact<Dim>& contact = *local.contact;
            const Vec<Dim> trial = contact.impulse - contact.inertia * local.approach();
            const Vec<Dim> impulse = contact.law->reaction({ contact.normal, contact.friction, trial });
            const Vec<Dim> step = impulse - contact.impulse;
            if (step == Vec<Dim>::Zero()) continue;
            contact.impulse = impulse;
            local.strike(step);
            change += step.squaredNorm();
            size += impulse.squaredNorm();
        }
        if (change <= tolerance * tolerance * size) break;
    }
    return sweep;
}

template int NonlinearGaussSeidel::solve<2>(std::vector<Contact<2>>&) const;

} // namespace softgrain
