// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/nlgs.hpp"

#include <cmath>

namespace softgrain {
namespace {

    /// A contact as the sweeps need it, short, so that all of them stay in cache. Velocities of all bodies stand
    /// in one array.
    template <int Dim> struct Local {
        int point, vertex[Dim];      ///< places in the array of velocities; a rigid plane has no vertices
        int body, other;
        double weight[Dim];
        Vec<Dim> normal, offset;     ///< offset: gap speed along the normal, less the drive of a rigid plane
        Vec<Dim> impulse;
        double inertia, friction;
        const ContactLaw<Dim>* law;
        const SignoriniCoulomb<Dim>* coulomb; ///< the law, if it is this one
    };

    template <int Dim> class Sweeper {
    public:
        explicit Sweeper(ContactProblem<Dim>& problem)
            : problem_(problem)
        {
            size_t count = 0;
            for (const Surface<Dim>* body : problem.bodies) {
                bodies_.push_back({ int(count), body->mobility, body->mesh });
                count += body->count;
            }
            velocity_.reserve(Dim * count);
            for (const Surface<Dim>* body : problem.bodies)
                velocity_.insert(velocity_.end(), body->velocity.begin(), body->velocity.end());
            locals_.reserve(problem.contacts.size());
            for (auto& contact : problem.contacts) {
                Local<Dim> local;
                local.body = contact.body;
                local.other = contact.other;
                local.point = bodies_[contact.body].first + contact.point;
                for (int k = 0; k < Dim; ++k) {
                    local.vertex[k] = contact.other < 0 ? 0 : bodies_[contact.other].first + contact.vertex[k];
                    local.weight[k] = contact.other < 0 ? 0 : contact.weight[k];
                }
                local.normal = contact.normal;
                local.offset = contact.gap_speed * contact.normal - contact.drive;
                local.impulse = contact.impulse;
                local.inertia = contact.inertia = 1 / delassus(local);
                local.friction = contact.friction;
                local.law = contact.law;
                local.coulomb = dynamic_cast<const SignoriniCoulomb<Dim>*>(contact.law);
                locals_.push_back(local);
                if (local.impulse != Vec<Dim>::Zero()) strike(local, local.impulse);
            }
        }

        /// One sweep; squared change of the impulses and their squared size.
        std::pair<double, double> sweep()
        {
            double change = 0, size = 0;
            for (Local<Dim>& local : locals_) {
                const Vec<Dim> trial = local.impulse - local.inertia * approach(local);
                const LocalContact<Dim> problem { local.normal, local.friction, trial };
                // the common law is called by name, so that it is inlined
                const Vec<Dim> impulse
                    = local.coulomb ? local.coulomb->SignoriniCoulomb<Dim>::reaction(problem) : local.law->reaction(problem);
                const Vec<Dim> step = impulse - local.impulse;
                if (step == Vec<Dim>::Zero()) continue;
                local.impulse = impulse;
                strike(local, step);
                change += step.squaredNorm();
                size += impulse.squaredNorm();
            }
            return { change, size };
        }

        void finish()
        {
            for (size_t i = 0; i < locals_.size(); ++i)
                problem_.contacts[i].impulse = locals_[i].impulse;
            for (size_t b = 0; b < bodies_.size(); ++b) {
                const double* from = velocity_.data() + Dim * bodies_[b].first;
                std::copy(from, from + problem_.bodies[b]->velocity.size(), problem_.bodies[b]->velocity.begin());
            }
        }

    private:
        struct Body {
            int first; ///< of its points among all
            double mobility;
            const Discretisation<Dim>* mesh;
        };

        /// Relative velocity with the gap.
        Vec<Dim> approach(const Local<Dim>& local) const
        {
            const double* v = velocity_.data();
            Vec<Dim> u;
            for (int d = 0; d < Dim; ++d) {
                u[d] = local.offset[d] + v[Dim * local.point + d];
                for (int k = 0; k < Dim; ++k)
                    u[d] -= local.weight[k] * v[Dim * local.vertex[k] + d];
            }
            return u;
        }

        /// Velocities of a body after an impulse on one of its points.
        void push(const Body& body, int point, const Vec<Dim>& impulse)
        {
            if (body.mobility == 0) return;
            const auto& mesh = *body.mesh;
            double step[Dim];
            for (int d = 0; d < Dim; ++d)
                step[d] = body.mobility * impulse[d];
            double* const v = velocity_.data() + Dim * body.first;
            const int end = mesh.delassus_row[point - body.first + 1];
            for (int j = mesh.delassus_row[point - body.first]; j < end; ++j) {
                double* at = v + Dim * mesh.delassus_column[j];
                const double value = mesh.delassus_value[j];
                double sum[Dim]; // all loads before the stores: one vector operation
                for (int d = 0; d < Dim; ++d)
                    sum[d] = at[d] + value * step[d];
                for (int d = 0; d < Dim; ++d)
                    at[d] = sum[d];
            }
        }

        /// An impulse on the point, and against it on the face.
        void strike(const Local<Dim>& local, const Vec<Dim>& impulse)
        {
            push(bodies_[local.body], local.point, impulse);
            if (local.other < 0) return;
            for (int k = 0; k < Dim; ++k)
                push(bodies_[local.other], local.vertex[k], -local.weight[k] * impulse);
        }

        double delassus(const Local<Dim>& local) const
        {
            const Body& body = bodies_[local.body];
            double sum = body.mobility > 0 ? body.mobility * body.mesh->delassus_diagonal[local.point - body.first] : 0;
            if (local.other < 0 || bodies_[local.other].mobility == 0) return sum;
            const Body& other = bodies_[local.other];
            for (int k = 0; k < Dim; ++k) {
                const int row = local.vertex[k] - other.first;
                sum += other.mobility * local.weight[k] * local.weight[k] * other.mesh->delassus_diagonal[row];
                for (int l = 0; l < k; ++l)
                    sum += 2 * other.mobility * local.weight[k] * local.weight[l]
                        * other.mesh->delassus(row, local.vertex[l] - other.first);
            }
            return sum;
        }

        ContactProblem<Dim>& problem_;
        std::vector<Body> bodies_;
        std::vector<double> velocity_;
        std::vector<Local<Dim>> locals_;
    };

} // namespace

template <int Dim> int NonlinearGaussSeidel::solve(ContactProblem<Dim>& problem) const
{
    if (problem.contacts.empty()) return 0;
    Sweeper<Dim> sweeper(problem);
    int sweeps = 0;
    while (sweeps < max_sweeps) {
        ++sweeps;
        const auto [change, size] = sweeper.sweep();
        if (change <= tolerance * tolerance * size) break;
    }
    sweeper.finish();
    return sweeps;
}

template int NonlinearGaussSeidel::solve<2>(ContactProblem<2>&) const;

} // namespace softgrain
