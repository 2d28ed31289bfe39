// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/nlgs.hpp"

#include "solver/rigid_balance.hpp"
#include "solver/rigid_contacts.hpp"
#include "solver/strips.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <typeinfo>
#include <utility>

namespace softgrain {
namespace {

    /// A contact as the sweeps need it, short, so that all of them stay in cache. Velocities of all bodies stand
    /// in one array.
    template <int Dim> struct Local {
        int point, vertex[face_vertices<Dim>]; ///< places in the array of velocities; a rigid plane has no vertices
        double weight[face_vertices<Dim>];
        Vec<Dim> normal, offset; ///< offset: of the contact, less the drive of a rigid plane
        Vec<Dim> impulse;
        double inertia, friction;
        const ContactLaw<Dim>* law;
        const SignoriniCoulomb<Dim>* coulomb; ///< the law, if it is this one
        size_t response;                      ///< of its face's body to a unit impulse, in Group::responses
        Contact<Dim>* contact;
    };

} // namespace

/// Works on one problem after the other and keeps its arrays, which change little from step to step.
template <int Dim> class NonlinearGaussSeidel<Dim>::Sweeper {
public:
    void begin(ContactProblem<Dim>& problem)
    {
        problem_ = &problem;
        bodies_.assign(problem.bodies.size(), {});
        velocity_.clear();
        rigid_ = false;
        round_off_ = 0;
        among_rigid_.begin(problem);
        for (const auto& contact : problem.contacts) {
            if (RigidContacts<Dim>::knows(problem, contact)) continue;
            take(contact.body);
            if (contact.other >= 0) take(contact.other);
        }
        divide();
        if (rigid_) gather_rigid();
    }

    /// Phases of a sweep: inside strips, between even and next, between odd and next, all others.
    static constexpr int phases = 4;
    int groups(int phase) const { return phase_[phase + 1] - phase_[phase]; }

    /// Reads the contacts of a group.
    void prepare(int phase, int which)
    {
        Group& group = groups_[phase_[phase] + which];
        thread_local std::vector<double> scratch; // zero between the calls
        scratch.resize(velocity_.size() / Dim, 0);
        for (Block& block : group.blocks)
            prepare(group, block, scratch);
    }

    /// Starts from the impulses of the contacts of a group.
    void start(int phase, int which)
    {
        Group& group = groups_[phase_[phase] + which];
        for (const Local<Dim>& local : group.locals)
            if (local.impulse != Vec<Dim>::Zero()) strike(group, local, local.impulse);
        for (Rigid& rigid : group.rigid) {
            for (auto& [of, index, lever] : rigid.contacts)
                groups_[of].locals[index].contact->free += lever * rigid.body->twist;
            settle(group, rigid);
        }
    }
    void start_among_rigid() { among_rigid_.start(); }

    /// On the contacts of two bodies before those of the next.
    struct Effort {
        int rounds;    ///< at most
        double enough; ///< squared change of their impulses at which that ends, relative to their size
        double share;  ///< of the way to the law's impulse that is gone with friction; below 1, contacts do not cycle
    };

    /// Treats the contacts of a group once.
    void sweep(int phase, int which, const Effort& effort)
    {
        Group& group = groups_[phase_[phase] + which];
        group.change = group.size = 0;
        for (const Block& block : group.blocks)
            solve(group, block, effort);
        for (Rigid& rigid : group.rigid)
            settle(group, rigid);
    }

    /// Treats the contacts that no soft body has a part in once.
    void sweep_among_rigid(double share) { among_rigid_.sweep(share); }

    /// The last sweep changed the impulses by less than this, relative to their size, or by no more than round-off.
    bool converged(double tolerance) const
    {
        double change = among_rigid_.change, size = among_rigid_.size;
        for (const Group& group : groups_) {
            change += group.change;
            size += group.size;
        }
        return change <= tolerance * tolerance * size + round_off_;
    }

    void finish()
    {
        for (const Group& group : groups_)
            for (const Local<Dim>& local : group.locals) {
                local.contact->impulse = local.impulse;
                local.contact->inertia = local.inertia;
            }
        for (const Group& group : groups_)
            for (const Rigid& rigid : group.rigid) {
                rigid.body->twist += std::exchange(rigid.body->gain, RigidBody<Dim>::Twist::Zero());
                for (const auto& [of, index, lever] : rigid.contacts) {
                    Contact<Dim>& contact = *groups_[of].locals[index].contact;
                    const auto along = (contact.normal.transpose() * lever).eval();
                    contact.inertia = 1 / (1 / contact.inertia + along.dot(along * rigid.body->mobility));
                }
            }
        for (size_t b = 0; b < bodies_.size(); ++b) {
            Surface<Dim>& surface = *problem_->bodies[b];
            for (int p = 0; surface.rigid && p < surface.count; ++p)
                surface.v(p) = surface.rigid->lever(surface.x(p)) * surface.rigid->twist;
            if (bodies_[b].first < 0 || surface.rigid) continue;
            const double* from = velocity_.data() + Dim * bodies_[b].first;
            std::copy(from, from + surface.velocity.size(), surface.velocity.begin());
        }
        among_rigid_.finish();
    }

private:
    struct Body {
        int first = -1; ///< of its points among all; none: no contact is on it
        double mobility = 0;
        const SurfaceOperator<Dim>* response = nullptr;
    };
    /// The contacts of two bodies.
    struct Block {
        size_t first, count; ///< in Group::locals
        size_t delassus;     ///< of the block, count x count, in Group::delassus
    };
    /// A rigid body that impulses move. In sweeps over its contacts it is driven by its twist, which is renewed when they
    /// have been treated: velocities stand at 0 on its surfaces, and in the offsets of the contacts.
    struct Rigid {
        struct Place {
            int group;
            size_t index;                                             ///< in Group::locals
            Eigen::Matrix<double, Dim, RigidBody<Dim>::twists> lever; ///< see RigidContact
        };
        RigidBody<Dim>* body;
        typename RigidBody<Dim>::Twist seen; ///< by its contacts: their offsets know of it
        std::vector<Place> contacts;
    };
    /// What one thread treats in a phase.
    struct Group {
        std::vector<Local<Dim>> locals;
        std::vector<Block> blocks;
        std::vector<Rigid> rigid;      ///< whose contacts are all here; or, of the last group, in several
        std::vector<double> responses; ///< changes of velocities by unit impulses, at the columns of the face's rows [1/kg]
        std::vector<double> delassus;
        std::vector<Vec<Dim>> velocity, before; ///< relative velocities, and impulses before, of the block in hand
        double change = 0, size = 0;            ///< squared change and size of the impulses in the last sweep
        void clear()
        {
            locals.clear();
            blocks.clear();
            rigid.clear();
            responses.clear();
            delassus.clear();
        }
    };

    void take(int index)
    {
        Body& body = bodies_[index];
        if (body.first >= 0) return;
        const Surface<Dim>& surface = *problem_->bodies[index];
        body = { int(velocity_.size()) / Dim, surface.mobility, surface.response };
        velocity_.insert(velocity_.end(), surface.velocity.begin(), surface.velocity.end());
        if (surface.mobility > 0) {
            const double momentum = 1e-14 * surface.speed / surface.mobility;
            round_off_ += momentum * momentum;
        }
        if (!surface.rigid) return;
        rigid_ = true;
        std::fill(velocity_.begin() + Dim * body.first, velocity_.end(), 0);
    }

    /// Sorts the contacts into groups, and in each by the two bodies they belong to: neighbours in the problem.
    void divide()
    {
        std::vector<const Surface<Dim>*> touched(problem_->bodies.begin(), problem_->bodies.end());
        for (size_t b = 0; b < touched.size(); ++b)
            if (bodies_[b].first < 0) touched[b] = nullptr;
        const std::vector<int> strip = strips_of(touched);
        const int strips = 1 + *std::max_element(strip.begin(), strip.end());
        phase_ = { 0, strips, strips + strips / 2, 2 * strips - 1, 2 * strips };
        groups_.resize(phase_[phases]);
        for (Group& group : groups_)
            group.clear();
        const auto group_of = [&](const Contact<Dim>& contact) {
            const bool one = contact.other < 0 || problem_->bodies[contact.other]->mobility == 0
                || problem_->bodies[contact.body]->mobility == 0;
            const int moving = problem_->bodies[contact.body]->mobility == 0 ? contact.other : contact.body;
            const int a = strip[moving], b = one ? a : strip[contact.other];
            const int first = std::min(a, b), apart = std::abs(a - b);
            if (apart == 0) return first;
            if (apart > 1) return phase_[3];
            return (first % 2 == 0 ? phase_[1] : phase_[2]) + first / 2;
        };
        std::pair<int, int> last { -2, -2 };
        for (auto& contact : problem_->contacts) {
            if (RigidContacts<Dim>::knows(*problem_, contact)) continue;
            Group& group = groups_[group_of(contact)];
            const std::pair<int, int> bodies = std::minmax(contact.body, contact.other);
            if (bodies != last) group.blocks.push_back({ group.locals.size(), 0, 0 });
            last = bodies;
            ++group.blocks.back().count;
            group.locals.emplace_back().contact = &contact;
        }
    }

    /// Who has contacts with which rigid body. These are inside strips, as the soft body's are with what does not move.
    void gather_rigid()
    {
        std::map<const RigidBody<Dim>*, size_t> places;
        std::vector<Rigid> all;
        for (int g = 0; g < phase_[1]; ++g)
            for (size_t i = 0; i < groups_[g].locals.size(); ++i) {
                const Contact<Dim>& contact = *groups_[g].locals[i].contact;
                const bool of_point = problem_->bodies[contact.body]->rigid;
                if (!of_point && contact.other < 0) continue;
                const Surface<Dim>& surface = *problem_->bodies[of_point ? contact.body : contact.other];
                if (!surface.rigid) continue;
                const auto [at, added] = places.try_emplace(surface.rigid, all.size());
                if (added) all.push_back({ surface.rigid, RigidBody<Dim>::Twist::Zero(), {} });
                const Vec<Dim> place = of_point ? Vec<Dim>(surface.x(contact.point)) : problem_->foot(contact);
                all[at->second].contacts.push_back({ g, i, (of_point ? 1 : -1) * surface.rigid->lever(place) });
            }
        for (Rigid& rigid : all) {
            const int first = rigid.contacts.front().group, last = rigid.contacts.back().group;
            groups_[first == last ? first : phase_[phases] - 1].rigid.push_back(std::move(rigid));
        }
    }

    void prepare(Group& group, Block& block, std::vector<double>& scratch) const
    {
        Local<Dim>* const locals = &group.locals[block.first];
        for (size_t i = 0; i < block.count; ++i) {
            Local<Dim>& local = locals[i];
            const Contact<Dim>& contact = *local.contact;
            local.point = bodies_[contact.body].first + contact.point;
            for (int k = 0; k < face_vertices<Dim>; ++k) {
                local.vertex[k] = contact.other < 0 ? 0 : bodies_[contact.other].first + contact.vertex[k];
                local.weight[k] = contact.other < 0 ? 0 : contact.weight[k];
            }
            local.normal = contact.normal;
            local.offset = contact.offset - contact.drive;
            local.impulse = contact.impulse;
            local.contact->free = approach(local);
            local.friction = contact.friction;
            local.law = contact.law;
            local.coulomb = typeid(*contact.law) == typeid(SignoriniCoulomb<Dim>)
                ? static_cast<const SignoriniCoulomb<Dim>*>(contact.law)
                : nullptr;
        }
        block.delassus = group.delassus.size();
        group.delassus.resize(block.delassus + block.count * block.count);
        double* const delassus = &group.delassus[block.delassus];
        for (size_t j = 0; j < block.count; ++j) {
            locals[j].response = group.responses.size();
            respond(*locals[j].contact, group.responses);
            each_response(group, locals[j], [&](int at, double value) { scratch[at] += value; });
            for (size_t i = j; i < block.count; ++i) {
                double value = scratch[locals[i].point];
                for (int k = 0; k < face_vertices<Dim>; ++k)
                    value -= locals[i].weight[k] * scratch[locals[i].vertex[k]];
                delassus[i * block.count + j] = delassus[j * block.count + i] = value;
            }
            each_response(group, locals[j], [&](int point, double) { scratch[point] = 0; });
            locals[j].inertia = 1 / delassus[j * block.count + j];
        }
    }

    /// Appends what a unit impulse against the face does to its body.
    void respond(const Contact<Dim>& contact, std::vector<double>& responses) const
    {
        if (contact.other < 0 || bodies_[contact.other].mobility == 0) return;
        const Body& body = bodies_[contact.other];
        const auto& rows = body.response->face_rows[contact.face];
        const size_t first = responses.size(), count = rows.column.size();
        responses.resize(first + count);
        double scale[face_vertices<Dim>];
        for (int k = 0; k < face_vertices<Dim>; ++k)
            scale[k] = -body.mobility * contact.weight[k];
        for (size_t j = 0; j < count; ++j) {
            double sum = 0;
            for (int k = 0; k < face_vertices<Dim>; ++k)
                sum += scale[k] * rows.value[k][j];
            responses[first + j] = sum;
        }
    }

    /// Calls visit(place among the velocities, change of velocity by a unit impulse [1/kg]).
    template <class Visit> void each_response(const Group& group, const Local<Dim>& local, const Visit& visit) const
    {
        const Contact<Dim>& contact = *local.contact;
        if (const Body& body = bodies_[contact.body]; body.mobility > 0) {
            const auto& response = *body.response;
            for (int j = response.delassus_row[contact.point]; j < response.delassus_row[contact.point + 1]; ++j)
                visit(body.first + response.delassus_column[j], body.mobility * response.delassus_value[j]);
        }
        if (contact.other < 0 || bodies_[contact.other].mobility == 0) return;
        const Body& body = bodies_[contact.other];
        const auto& column = body.response->face_rows[contact.face].column;
        for (size_t j = 0; j < column.size(); ++j)
            visit(body.first + column[j], group.responses[local.response + j]);
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

    /// Brings the contacts of two bodies to rest with each other, all else held: they are coupled most, being next
    /// to each other, and cheaply, by their own Delassus operator.
    void solve(Group& group, const Block& block, const Effort& effort)
    {
        Local<Dim>* const locals = &group.locals[block.first];
        auto &velocity = group.velocity, &before = group.before;
        velocity.resize(std::max(velocity.size(), block.count));
        before.resize(velocity.size());
        for (size_t i = 0; i < block.count; ++i) {
            velocity[i] = approach(locals[i]);
            before[i] = locals[i].impulse;
        }
        for (int round = 0; round < effort.rounds; ++round) {
            double change = 0, size = 0;
            for (size_t i = 0; i < block.count; ++i) {
                Local<Dim>& local = locals[i];
                const LocalContact<Dim> problem { local.normal, local.friction,
                                                  local.impulse - local.inertia * velocity[i] };
                // the common law is called by name, so that it is inlined
                Vec<Dim> impulse
                    = local.coulomb ? local.coulomb->SignoriniCoulomb<Dim>::reaction(problem) : local.law->reaction(problem);
                if (effort.share < 1 && local.friction > 0)
                    impulse = local.impulse + effort.share * (impulse - local.impulse);
                const Vec<Dim> step = impulse - local.impulse;
                size += impulse.squaredNorm();
                if (step == Vec<Dim>::Zero()) continue;
                local.impulse = impulse;
                change += step.squaredNorm();
                const double* const row = &group.delassus[block.delassus + i * block.count];
                for (size_t j = 0; j < block.count; ++j)
                    velocity[j] += row[j] * step;
            }
            if (change <= effort.enough * size) break;
        }
        for (size_t i = 0; i < block.count; ++i) {
            const Vec<Dim> step = locals[i].impulse - before[i];
            group.size += locals[i].impulse.squaredNorm();
            if (step == Vec<Dim>::Zero()) continue;
            group.change += step.squaredNorm();
            strike(group, locals[i], step);
        }
    }

    /// Brings the twist of a rigid body and the impulses of its contacts together.
    void settle(Group& group, Rigid& rigid)
    {
        thread_local std::vector<RigidContact<Dim>> contacts;
        contacts.clear();
        const auto struck = (rigid.body->twist - std::exchange(rigid.seen, rigid.body->twist)).eval();
        for (const auto& [of, index, lever] : rigid.contacts) {
            Local<Dim>& local = groups_[of].locals[index];
            local.offset += lever * struck;
            contacts.push_back(
                { local.law, local.normal, local.friction, local.inertia, lever, approach(local), local.impulse });
        }
        const auto before = rigid.body->gain;
        balance(*rigid.body, rigid.body->gain, contacts);
        for (size_t i = 0; i < contacts.size(); ++i) {
            const auto& [of, index, lever] = rigid.contacts[i];
            Local<Dim>& local = groups_[of].locals[index];
            local.offset += lever * (rigid.body->gain - before);
            const Vec<Dim> step = contacts[i].impulse - local.impulse;
            if (step == Vec<Dim>::Zero()) continue;
            group.change += step.squaredNorm();
            local.impulse = contacts[i].impulse;
            strike(groups_[of], local, step);
        }
    }

    void strike(const Group& group, const Local<Dim>& local, const Vec<Dim>& impulse)
    {
        double* const v = velocity_.data();
        each_response(group, local, [&](int point, double value) {
            double* at = v + Dim * point;
            double sum[Dim]; // all loads before the stores: one vector operation
            for (int d = 0; d < Dim; ++d)
                sum[d] = at[d] + value * impulse[d];
            for (int d = 0; d < Dim; ++d)
                at[d] = sum[d];
        });
    }

    ContactProblem<Dim>* problem_ = nullptr;
    std::vector<Body> bodies_;
    std::vector<double> velocity_;
    double round_off_;                  ///< squared, in the impulses of bodies as fast as these
    bool rigid_;                        ///< some bodies with contacts are rigid and moved by impulses
    std::vector<Group> groups_;         ///< phase after phase
    std::array<int, phases + 1> phase_; ///< first group of each phase
    RigidContacts<Dim> among_rigid_;
};

template <int Dim>
NonlinearGaussSeidel<Dim>::NonlinearGaussSeidel(double tolerance_, int max_sweeps_)
    : tolerance(tolerance_)
    , max_sweeps(max_sweeps_)
    , sweeper_(std::make_unique<Sweeper>())
{
}

template <int Dim> NonlinearGaussSeidel<Dim>::~NonlinearGaussSeidel() = default;

template <int Dim> int NonlinearGaussSeidel<Dim>::solve(ContactProblem<Dim>& problem)
{
    if (problem.contacts.empty()) return 0;
    Sweeper& sweeper = *sweeper_;
    sweeper.begin(problem);
    // below this a sweep is over before threads have met
    constexpr int least_contacts_of_a_thread = 500;
    // from so many sweeps on: pairs are treated thoroughly, then with care
    constexpr int slow = 16, stuck = 64;
    constexpr typename Sweeper::Effort quick { 8, 1e-4, 1 }, thorough { 200, 1e-8, 1 }, careful { 200, 1e-8, 0.5 };
    int sweeps = 0;
    typename Sweeper::Effort effort = quick;
    bool done = false;
#pragma omp parallel num_threads(team(threads, problem.contacts.size() / least_contacts_of_a_thread))
    {
        for (int phase = 0; phase < Sweeper::phases; ++phase)
#pragma omp for schedule(static, 1)
            for (int g = 0; g < sweeper.groups(phase); ++g)
                sweeper.prepare(phase, g);
        for (int phase = 0; phase < Sweeper::phases; ++phase)
#pragma omp for schedule(static, 1)
            for (int g = 0; g < sweeper.groups(phase); ++g)
                sweeper.start(phase, g);
#pragma omp single
        sweeper.start_among_rigid();
        while (!done) {
            for (int phase = 0; phase < Sweeper::phases; ++phase) {
                if (sweeper.groups(phase) == 0) continue;
#pragma omp for schedule(static, 1)
                for (int g = 0; g < sweeper.groups(phase); ++g)
                    sweeper.sweep(phase, g, effort);
            }
#pragma omp single
            {
                sweeper.sweep_among_rigid(effort.share);
                ++sweeps;
                done = sweeps >= max_sweeps || sweeper.converged(tolerance * effort.share);
                effort = sweeps < slow ? quick : sweeps < stuck ? thorough : careful;
            }
        }
    }
    sweeper.finish();
    return sweeps;
}

template class NonlinearGaussSeidel<2>;

} // namespace softgrain
