// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/nlgs.hpp"

#include <algorithm>
#include <cmath>
#include <typeinfo>

namespace softgrain {
namespace {

    /// Bodies in a strip, about: fewer make more contacts between strips, more leave threads without work.
    constexpr int strip_bodies = 60;
    constexpr int most_strips = 32;

    /// Strip of each body along the longer side of the scene.
    template <int Dim> std::vector<int> strips_of(const std::vector<Surface<Dim>*>& bodies)
    {
        Vec<Dim> lo = Vec<Dim>::Constant(1e300), hi = -lo;
        int soft = 0;
        for (const Surface<Dim>* body : bodies) {
            if (body->mobility == 0) continue;
            ++soft;
            lo = lo.cwiseMin(body->min);
            hi = hi.cwiseMax(body->max);
        }
        const int count = std::clamp(soft / strip_bodies, 1, most_strips);
        int axis = 0;
        (hi - lo).maxCoeff(&axis);
        const double length = std::max(hi[axis] - lo[axis], 1e-300);
        std::vector<int> strips;
        for (const Surface<Dim>* body : bodies) {
            const double middle = ((body->min[axis] + body->max[axis]) / 2 - lo[axis]) / length;
            strips.push_back(std::clamp(int(middle * count), 0, count - 1));
        }
        return strips;
    }

    /// A contact as the sweeps need it, short, so that all of them stay in cache. Velocities of all bodies stand
    /// in one array.
    template <int Dim> struct Local {
        int point, vertex[face_vertices<Dim>]; ///< places in the array of velocities; a rigid plane has no vertices
        int body, other;
        double weight[face_vertices<Dim>];
        Vec<Dim> normal, offset;     ///< offset: gap speed along the normal, less the drive of a rigid plane
        Vec<Dim> impulse;
        Contact<Dim>* contact;
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
            group(problem);
        }

        /// Phases of a sweep: inside strips, between even and next, between odd and next, all others.
        static constexpr int phases = 4;
        int groups(int phase) const { return int(phase_[phase + 1] - phase_[phase]); }

        /// Starts from the impulses of the contacts of a group.
        void start(int phase, int which)
        {
            each(phase, which, [&](Local<Dim>& local) {
                prepare(local);
                if (local.impulse != Vec<Dim>::Zero()) strike(local, local.impulse);
            });
        }

        /// Treats the contacts of a group once.
        void sweep(int phase, int which)
        {
            double change = 0, size = 0;
            each(phase, which, [&](Local<Dim>& local) {
                const Vec<Dim> trial = local.impulse - local.inertia * approach(local);
                const LocalContact<Dim> problem { local.normal, local.friction, trial };
                // the common law is called by name, so that it is inlined
                const Vec<Dim> impulse
                    = local.coulomb ? local.coulomb->SignoriniCoulomb<Dim>::reaction(problem) : local.law->reaction(problem);
                const Vec<Dim> step = impulse - local.impulse;
                if (step == Vec<Dim>::Zero()) return;
                local.impulse = impulse;
                strike(local, step);
                change += step.squaredNorm();
                size += impulse.squaredNorm();
            });
            progress_[phase_[phase] + which] = { change, size };
        }

        /// The last sweep changed the impulses by less than this, relative to those it changed.
        bool converged(double tolerance) const
        {
            double change = 0, size = 0;
            for (const auto& [part, whole] : progress_) {
                change += part;
                size += whole;
            }
            return change <= tolerance * tolerance * size;
        }

        void finish()
        {
            for (const Local<Dim>& local : locals_)
                local.contact->impulse = local.impulse;
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

        /// Sorts the contacts by the group they are treated in.
        void group(ContactProblem<Dim>& problem)
        {
            const std::vector<int> strip = strips_of(problem.bodies);
            const int strips = 1 + *std::max_element(strip.begin(), strip.end());
            phase_ = { 0, size_t(strips), size_t(strips + strips / 2), size_t(2 * strips - 1), size_t(2 * strips) };
            const auto group_of = [&](const Contact<Dim>& contact) -> size_t {
                const bool one = contact.other < 0 || problem.bodies[contact.other]->mobility == 0
                    || problem.bodies[contact.body]->mobility == 0;
                const int moving = problem.bodies[contact.body]->mobility == 0 ? contact.other : contact.body;
                const int a = strip[moving], b = one ? a : strip[contact.other];
                const int first = std::min(a, b), apart = std::abs(a - b);
                if (apart == 0) return size_t(first);
                if (apart > 1) return phase_[3];
                return (first % 2 == 0 ? phase_[1] : phase_[2]) + size_t(first / 2);
            };
            first_.assign(phase_[phases] + 1, 0);
            for (const auto& contact : problem.contacts)
                ++first_[group_of(contact) + 1];
            for (size_t g = 1; g < first_.size(); ++g)
                first_[g] += first_[g - 1];
            std::vector<size_t> next(first_.begin(), first_.end() - 1);
            locals_.resize(problem.contacts.size());
            for (auto& contact : problem.contacts)
                locals_[next[group_of(contact)]++].contact = &contact;
            progress_.assign(phase_[phases], {});
        }

        template <class Work> void each(int phase, int which, const Work& work)
        {
            const size_t g = phase_[phase] + which;
            for (size_t i = first_[g]; i < first_[g + 1]; ++i)
                work(locals_[i]);
        }

        void prepare(Local<Dim>& local) const
        {
            Contact<Dim>& contact = *local.contact;
            local.body = contact.body;
            local.other = contact.other;
            local.point = bodies_[contact.body].first + contact.point;
            for (int k = 0; k < face_vertices<Dim>; ++k) {
                local.vertex[k] = contact.other < 0 ? 0 : bodies_[contact.other].first + contact.vertex[k];
                local.weight[k] = contact.other < 0 ? 0 : contact.weight[k];
            }
            local.normal = contact.normal;
            local.offset = contact.gap_speed * contact.normal - contact.drive;
            local.impulse = contact.impulse;
            local.inertia = contact.inertia = 1 / delassus(local);
            local.friction = contact.friction;
            local.law = contact.law;
            local.coulomb = typeid(*contact.law) == typeid(SignoriniCoulomb<Dim>)
                ? static_cast<const SignoriniCoulomb<Dim>*>(contact.law)
                : nullptr;
        }

        /// Relative velocity with the gap.
        Vec<Dim> approach(const Local<Dim>& local) const
        {
            const double* v = velocity_.data();
            Vec<Dim> u;
            for (int d = 0; d < Dim; ++d) {
                u[d] = local.offset[d] + v[Dim * local.point + d];
                for (int k = 0; k < face_vertices<Dim>; ++k)
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
            for (int k = 0; k < face_vertices<Dim>; ++k)
                push(bodies_[local.other], local.vertex[k], -local.weight[k] * impulse);
        }

        double delassus(const Local<Dim>& local) const
        {
            const Body& body = bodies_[local.body];
            double sum = body.mobility > 0 ? body.mobility * body.mesh->delassus_diagonal[local.point - body.first] : 0;
            if (local.other < 0 || bodies_[local.other].mobility == 0) return sum;
            const Body& other = bodies_[local.other];
            for (int k = 0; k < face_vertices<Dim>; ++k) {
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
        std::vector<Local<Dim>> locals_;  ///< group after group
        std::array<size_t, phases + 1> phase_; ///< first group of each phase
        std::vector<size_t> first_;            ///< first contact of each group
        std::vector<std::pair<double, double>> progress_; ///< of each group: squared change and size of its impulses
    };

} // namespace

template <int Dim> int NonlinearGaussSeidel::solve(ContactProblem<Dim>& problem) const
{
    if (problem.contacts.empty()) return 0;
    Sweeper<Dim> sweeper(problem);
    // below this a sweep is over before threads have met
    constexpr int least_contacts_of_a_thread = 500;
    const int team = std::clamp(int(problem.contacts.size()) / least_contacts_of_a_thread, 1, std::max(1, threads));
    int sweeps = 0;
    bool done = false;
#pragma omp parallel num_threads(team)
    {
        for (int phase = 0; phase < Sweeper<Dim>::phases; ++phase)
#pragma omp for schedule(static, 1)
            for (int g = 0; g < sweeper.groups(phase); ++g)
                sweeper.start(phase, g);
        while (!done) {
            for (int phase = 0; phase < Sweeper<Dim>::phases; ++phase) {
                if (sweeper.groups(phase) == 0) continue;
#pragma omp for schedule(static, 1)
                for (int g = 0; g < sweeper.groups(phase); ++g)
                    sweeper.sweep(phase, g);
            }
#pragma omp single
            {
                ++sweeps;
                done = sweeps >= max_sweeps || sweeper.converged(tolerance);
            }
        }
    }
    sweeper.finish();
    return sweeps;
}

template int NonlinearGaussSeidel::solve<2>(ContactProblem<2>&) const;

} // namespace softgrain
