// SPDX-License-Identifier: GPL-2.0-or-later
#include "step/implicit_step.hpp"

#include "step/smoothed_friction.hpp"

#include <cmath>
#include <map>
#include <tuple>

namespace softgrain {
namespace {

    constexpr double most_penetration = 1e-5; ///< [radius of the smaller body]
    constexpr int most_firmer = 8;
    constexpr double most_creep = 10; ///< [tolerance times what the contact gives way elastically]

} // namespace

template <int Dim>
ImplicitStep<Dim>::ImplicitStep(Assembly<Dim>& assembly)
    : assembly_(assembly)
    , grains_(assembly)
{
    for (const Grain<Dim>* grain : assembly.grains()) {
        const double modulus = grain->law->shear_modulus(grain->parameters.data());
        shear_modulus_ = std::max(shear_modulus_, modulus);
        least_force_ = std::max(least_force_, 1e-4 * modulus * grain->radius);
    }
    least_force_ *= std::sqrt(double(assembly.grains().size())); // norms of forces are those of all grains
}

/// Feet, normals, gaps and slides at the grains' places.
template <int Dim> void ImplicitStep<Dim>::locate()
{
    grains_.slide(way_);
    for (auto& contact : contacts) {
        const Surface<Dim>& body = *scene_->bodies[contact.body];
        if (contact.other < 0)
            contact.gap = contact.normal.dot(body.x(contact.point)) - contact.plane;
        else
            contact.locate(body, *scene_->bodies[contact.other]);
        if (contact.friction > 0)
            contact.slide = contact.creep + (difference(contact, way_) - contact.drive).dot(contact.tangent());
    }
}

template <int Dim> void ImplicitStep<Dim>::look_or_locate(double dt)
{
    if (grains_.farthest() > ahead / 4)
        renew_contacts(dt);
    else
        locate();
}

template <int Dim> void ImplicitStep<Dim>::start_values()
{
    // how much the guess misses, and the force that goes with it
    double missed = 0, size = 0, force = 0;
    int loaded = 0;
    for (const auto& contact : contacts) {
        missed = std::max(missed, -contact.gap);
        size = std::max(size, contact.size);
        if (contact.force > 0) {
            force += contact.force;
            ++loaded;
        }
    }
    missed = std::clamp(0.3 * missed, 1e-4 * size, ahead * size);
    double mobile = 0; // compliance of the most mobile contact
    for (const auto& contact : contacts)
        mobile = std::max(mobile, contact.compliance);
    const double rigid = mobile > 0 ? 1 / mobile : shear_modulus_;
    kappa_ = missed * std::max(loaded ? force / loaded : 0, rigid * missed);
    for (auto& contact : contacts) {
        const double before = contact.force > 0 ? std::min(kappa_ / contact.force, 10 * missed) : missed;
        contact.slack = std::max(contact.gap, before);
        contact.force = kappa_ / contact.slack;
        const double most = 0.9 * contact.friction * contact.force;
        contact.shear = std::clamp(contact.shear, -most, most);
    }
}

/// Looks for contacts anew where the grains are now; those that go on keep forces and slacks.
template <int Dim> void ImplicitStep<Dim>::renew_contacts(double dt)
{
    const auto key = [&](const BarrierContact<Dim>& c) { // places among the bodies may change
        const Surface<Dim>* other = c.other < 0 ? nullptr : scene_->bodies[size_t(c.other)];
        return std::make_tuple(scene_->bodies[size_t(c.body)], other, c.point, other ? 0.0 : c.normal[0] + 2 * c.normal[1]);
    };
    std::map<decltype(key(contacts[0])), const BarrierContact<Dim>*> known;
    const std::vector<BarrierContact<Dim>> before = std::move(contacts);
    for (const auto& contact : before)
        known[key(contact)] = &contact;
    grains_.mark();
    contacts = scene_->contacts(ahead, dt);
    make_room(dt);
    locate();
    for (auto& contact : contacts) {
        const auto found = known.find(key(contact));
        contact.slack = found != known.end() ? found->second->slack : std::max(contact.gap, 1e-2 * contact.size);
        contact.force = found != known.end() ? found->second->force : kappa_ / contact.slack;
        contact.shear = found != known.end() ? found->second->shear : 0;
        contact.compliance = found != known.end() ? found->second->compliance : 0;
    }
    sorted_ = false;
}

/// Potential with barriers, friction at the present bounds, and the price of gaps that are not their slacks.
template <int Dim> double ImplicitStep<Dim>::merit(double potential) const
{
    double sum = potential;
    for (const auto& contact : contacts) {
        sum -= kappa_ * std::log(contact.slack);
        sum += 2 * std::max(contact.force, contact.force + contact.force_step) * std::abs(contact.gap - contact.slack);
        if (contact.friction > 0) sum += SmoothedFriction(contact.slide, contact.friction * contact.force, kappa_).energy;
    }
    return sum;
}

/// Mean of the contacts' stiffnesses along their normals, those that are known, or about what a grain's is [N/m].
template <int Dim> double ImplicitStep<Dim>::mean_stiffness() const
{
    double sum = 0;
    int known = 0;
    for (const auto& contact : contacts)
        if (contact.compliance > 0) {
            sum += 1 / contact.compliance;
            ++known;
        }
    return known ? sum / known : shear_modulus_;
}

/// || r - P_K(r - u - mu |u_t| n) || / |r| with u = (gap, slide) in units of force through the mean stiffness. Not over
/// max(|r|, |u|), as Siconos has it: far points would hide what is wrong with those that touch.
template <int Dim> double ImplicitStep<Dim>::contact_residual() const
{
    const double stiffness = mean_stiffness();
    double error = 0, r2 = 0;
    for (const auto& contact : contacts) {
        const Vec<Dim> r = contact.total();
        const double cone = contact.gap + contact.friction * std::abs(contact.slide);
        const Vec<Dim> target = r - stiffness * (cone * contact.normal + contact.slide * contact.tangent());
        error += (r - cone_projection<Dim>(target, contact.normal, contact.friction)).squaredNorm();
        r2 += r.squaredNorm();
    }
    return std::sqrt(error) / std::max(std::sqrt(r2), least_force_);
}

/// For the values of the surfaces; looking for contacts may find other bodies. Rigid ones go their ways.
template <int Dim> void ImplicitStep<Dim>::make_room(double dt)
{
    points_.clear();
    for (SurfaceField* field : { &way_, &forces_, &moved_, &conjugate_ })
        field->resize(scene_->bodies.size());
    for (size_t b = 0; b < scene_->bodies.size(); ++b) {
        points_.push_back(scene_->bodies[b]->count);
        for (SurfaceField* field : { &way_, &forces_, &moved_, &conjugate_ })
            (*field)[b].assign(size_t(Dim) * scene_->bodies[b]->count, 0);
        if (b < assembly_.grains().size()) continue;
        for (size_t i = 0; i < way_[b].size(); ++i)
            way_[b][i] = dt * scene_->bodies[b]->velocity[i];
    }
}

/// The grains at the best of three guesses: as they are, going on at their velocities, or moving with the walls.
template <int Dim> void ImplicitStep<Dim>::begin(double dt, const Vec<Dim>& gravity)
{
    contacts = scene_->contacts(ahead, dt);
    make_room(dt);
    grains_.begin(dt, settings_, gravity, [&](const Vec<Dim>& x) { return scene_->prediction(x, dt); });
    using Start = typename ImplicitGrains<Dim>::Start;
    constexpr double too_far = 0.5; // radii
    double least = 1e300;
    Start best = Start::rest;
    for (Start start : { Start::rest, Start::velocity, Start::prediction }) {
        grains_.aim(start);
        place_ = grains_.evaluate(1);
        if (!place_.sound || grains_.farthest() > too_far) continue;
        look_or_locate(dt);
        double value = place_.potential;
        for (const auto& contact : contacts) { // what it costs to undo penetrations, about
            const double depth = std::max(0.0, -contact.gap);
            value += 2 * contact.force * depth + shear_modulus_ * depth * depth;
        }
        if (value < least) {
            least = value;
            best = start;
        }
    }
    grains_.aim(best);
    place_ = grains_.evaluate(1);
    if (const int inverted = grains_.turned_inside_out(); inverted >= 0)
        throw SimulationError("soft grain #" + std::to_string(assembly_.grains()[size_t(inverted)]->id)
                              + ": some of its points are turned inside out at the start of the implicit step; untangle() "
                                "it, or start from less deformation.");
    grains_.settle();
    look_or_locate(dt);
    sorted_ = false;
    for (auto& contact : contacts)
        contact.slack = contact.gap;
}

template <int Dim> void ImplicitStep<Dim>::clear(SurfaceField& field)
{
    for (auto& values : field)
        std::fill(values.begin(), values.end(), 0.0);
}

/// At the surfaces [N].
template <int Dim> SurfaceField& ImplicitStep<Dim>::contact_forces()
{
    clear(forces_);
    for (const auto& contact : contacts)
        add_force<Dim>(contact, contact.total(), forces_);
    return forces_;
}

/// What the present place and forces are worth.
template <int Dim> typename ImplicitGrains<Dim>::Forces ImplicitStep<Dim>::judge(Outcome& outcome)
{
    const auto balance = grains_.load(contact_forces());
    const double scale = std::max({ balance.contact, settings_.quasistatic ? 0 : balance.inertia, least_force_ });
    outcome.unbalanced = balance.unbalanced / scale;
    outcome.held = settings_.quasistatic ? balance.inertia / scale : 0;
    outcome.residual = contact_residual();
    outcome.penetration = outcome.distance = 0;
    double sum = 0;
    for (const auto& contact : contacts) {
        outcome.penetration = std::max(outcome.penetration, -contact.gap / contact.size);
        outcome.distance += contact.force * std::max(contact.gap, 0.0) / contact.size;
        sum += contact.force;
    }
    if (sum > 0) outcome.distance /= sum;
    return balance;
}

/// Goes along the search direction as far as no point inverts and the merit does not grow; each slack goes no further than to
/// a small share of itself, since one that waited for another would hold up all grains. False when there is no such place.
template <int Dim> bool ImplicitStep<Dim>::take_direction(double dt)
{
    using Contact = BarrierContact<Dim>;
    constexpr int most_cuts = 6; // of a merit that may err: the direction is one of descent but for friction's bounds
    const double dual = largest_share(&Contact::force, &Contact::force_step);
    double share = std::min(1.0, ahead / (4 * std::max(grains_.reach_of_step(), 1e-300)));
    const double before = merit(place_.potential), noise = 1e-9 * (std::abs(before) + 1e-3 * least_force_);
    const std::vector<Contact> start = contacts;
    int cuts = 0;
    for (;; ++cuts, share /= 2) {
        place_ = grains_.evaluate(share);
        if (place_.sound) {
            for (auto& contact : contacts)
                contact.slack
                    = std::max(contact.slack + share * contact.slack_step, (1 - fraction_to_boundary) * contact.slack);
            locate();
            if (merit(place_.potential) < before + noise || cuts > most_cuts) break;
        }
        contacts = start;
        if (cuts > 5 * most_cuts) return false;
    }
    grains_.settle();
    for (auto& contact : contacts) {
        contact.force += dual * contact.force_step;
        const double most = 0.999 * contact.friction * contact.force;
        contact.shear = std::clamp(contact.shear + dual * contact.shear_step, -most, most);
    }
    damping_ = cuts > 0 ? std::clamp(4 * damping_, 0.05, 4.0) : 0.8 * damping_;
    if (grains_.farthest() > ahead / 4) renew_contacts(dt);
    return true;
}

template <int Dim> void ImplicitStep<Dim>::choose_hold(const Outcome& outcome)
{
    constexpr double least = 0.01;
    constexpr int many = 10;
    if (outcome.stages > 1)
        hold = std::max(least, hold / 2);
    else if (outcome.iterations > many)
        hold = std::min(1.0, 2 * hold);
}

template <int Dim>
typename ImplicitStep<Dim>::Outcome ImplicitStep<Dim>::attempt(double dt, const ImplicitSettings& settings,
                                                               const Vec<Dim>& gravity, ImplicitScene<Dim>& scene)
{
    scene_ = &scene;
    settings_ = settings;
    settings_.regularisation *= hold;
    damping_ = kappa_ = 0;
    factor_age_ = 0;
    begin(dt, gravity);
    condense();
    start_values();
    Outcome outcome;
    int last = settings.most_iterations, firmer = 0; // iteration to end at; how often grains had to be held more firmly
    std::vector<BarrierContact<Dim>> held = contacts;
    for (;; ++outcome.iterations) {
        const auto balance = judge(outcome);
        const bool touching = outcome.residual < settings.tolerance && outcome.penetration < most_penetration;
        const bool free = outcome.held * std::max(balance.contact, least_force_)
            < std::max(settings.tolerance * balance.contact, 0.1 * least_force_);
        if (touching && outcome.unbalanced < settings.tolerance
            && (!settings.quasistatic || free || outcome.stages >= settings.most_stages)) {
            outcome.converged = true;
            if (settings.quasistatic) choose_hold(outcome);
            grains_.accept();
            fill_problem(dt);
            begun_.contacts.clear();
            if (!settings.quasistatic && settings.theta < 1) give_impulses(dt);
            take_stock(outcome);
            return outcome;
        }
        if (settings.quasistatic && touching && !free && outcome.stages < settings.most_stages
            && outcome.unbalanced < std::max(settings.tolerance, 0.5 * outcome.held)) {
            grains_.recentre();
            place_ = grains_.evaluate(0);
            held = contacts;
            ++outcome.stages;
            last = outcome.iterations + settings.most_iterations;
            judge(outcome);
        }
        bool sound = outcome.iterations < last;
        if (sound) {
            if (outcome.iterations > 0) condense();
            sound = find_direction(outcome) && take_direction(dt);
        }
        if (sound) continue;
        outcome.trouble = "forces on soft grain #" + std::to_string(assembly_.grains()[size_t(balance.worst)]->id)
            + " find no balance (" + shown(outcome.unbalanced, 2) + " of the contact forces; contact residual "
            + shown(outcome.residual, 2) + ", penetration " + shown(outcome.penetration, 2) + " radii)";
        if (!settings.quasistatic || ++firmer > most_firmer) break;
        grains_.back_to_centre();
        hold = std::min(1.0, 4 * hold);
        place_ = grains_.evaluate(0);
        contacts = held;
        renew_contacts(dt);
        last = outcome.iterations + settings.most_iterations;
    }
    grains_.restore();
    return outcome;
}

template <int Dim> void ImplicitStep<Dim>::fill_problem(double dt)
{
    grains_.slide(way_);
    problem.bodies = scene_->bodies;
    problem.contacts.clear();
    for (size_t g = 0; g < assembly_.grains().size(); ++g) {
        Surface<Dim>& surface = *scene_->bodies[g];
        for (size_t i = 0; i < surface.velocity.size(); ++i)
            surface.velocity[i] = surface.velocity_before[i] = way_[g][i] / dt;
    }
    const double stiffness = mean_stiffness();
    const double length = (settings_.quasistatic ? 1 : settings_.theta) * dt;
    for (auto& from : contacts) {
        Contact<Dim> contact;
        contact.body = from.body;
        contact.other = from.other;
        contact.point = from.point;
        contact.face = from.face;
        contact.vertex = from.vertex;
        contact.weight = from.weight;
        contact.normal = from.normal;
        contact.drive = from.drive / dt;
        contact.friction = from.friction;
        contact.law = nullptr;
        // points that stand off bear no force but what the barrier leaves
        const bool pressed = from.force > stiffness * from.gap;
        contact.impulse = pressed ? Vec<Dim>(length * from.total()) : Vec<Dim>(Vec<Dim>::Zero());
        const double most = most_creep * settings_.tolerance * std::min(from.friction, 1.0) * from.force * from.compliance;
        from.creep = pressed ? std::clamp(from.slide, -most, most) : 0;
        contact.inertia = length * dt * (from.compliance > 0 ? 1 / from.compliance : stiffness);
        const double rate = problem.relative(contact, &Surface<Dim>::velocity).dot(contact.normal);
        contact.offset = (from.gap / dt - rate) * from.normal;
        problem.contacts.push_back(contact);
    }
}

/// Impulses of the step where theta < 1. Those of the contact forces, which close the gaps at its end, would turn velocities
/// around in every step. Instead contacts give 1 - theta of these at the start, where they were and along the normals there,
/// and at the end what the law in velocities says, of points that press on each other.
template <int Dim> void ImplicitStep<Dim>::give_impulses(double dt)
{
    static const SignoriniCoulomb<Dim> law;
    const auto exchange_velocities = [&] {
        for (size_t g = 0; g < assembly_.grains().size(); ++g)
            scene_->bodies[g]->velocity.swap(moved_[g]);
    };
    grains_.strike(contact_forces(), -settings_.theta * dt);
    const std::vector<BarrierContact<Dim>> end = contacts;
    grains_.exchange_places();
    locate();
    grains_.exchange_places();
    clear(forces_);
    begun_ = problem;
    for (size_t c = 0; c < contacts.size(); ++c) {
        auto& begun = begun_.contacts[c];
        if (begun.impulse == Vec<Dim>::Zero()) continue;
        begun.weight = contacts[c].weight;
        begun.vertex = contacts[c].vertex;
        begun.normal = contacts[c].normal;
        begun.impulse = (1 - settings_.theta) * settings_.theta * dt * contacts[c].total();
        add_force<Dim>(contacts[c], begun.impulse, forces_);
    }
    contacts = end;
    grains_.strike(forces_, 1);
    grains_.velocities(moved_);
    ContactProblem<Dim> pressed;
    pressed.bodies = problem.bodies;
    for (auto& contact : problem.contacts) {
        if (contact.impulse == Vec<Dim>::Zero()) continue;
        contact.law = &law;
        contact.impulse *= settings_.theta;
        pressed.contacts.push_back(contact);
        pressed.contacts.back().offset.setZero();
    }
    exchange_velocities();
    velocity_solver_.tolerance = 1e-3 * settings_.tolerance;
    velocity_solver_.threads = settings_.threads;
    velocity_solver_.solve(pressed);
    exchange_velocities();
    clear(forces_);
    auto solved = pressed.contacts.begin();
    for (size_t c = 0; c < contacts.size(); ++c) {
        Vec<Dim>& impulse = problem.contacts[c].impulse;
        if (impulse == Vec<Dim>::Zero()) continue;
        impulse = (solved++)->impulse;
        add_force<Dim>(contacts[c], impulse, forces_);
    }
    grains_.strike(forces_, 1);
}

/// Energies of the step, and the impulses of its start and end together.
template <int Dim> void ImplicitStep<Dim>::take_stock(Outcome& outcome)
{
    const auto energy = grains_.energy();
    Assembly<Dim>::account(problem, outcome.work);
    Assembly<Dim>::account(begun_, outcome.work);
    for (size_t c = 0; c < begun_.contacts.size(); ++c)
        problem.contacts[c].impulse += begun_.contacts[c].impulse;
    outcome.dissipated = energy.dissipated;
    const double missing = energy.gained + outcome.dissipated + outcome.work.friction + outcome.work.contact_dissipation
        - outcome.work.external_work;
    double way = least_force_ / shear_modulus_; // of forces that count as none
    for (const auto& ways : way_)
        for (double along : ways)
            way = std::max(way, std::abs(along));
    double opened = 0; // work of gaps that open from where penetration is let pass
    for (const auto& contact : contacts)
        opened += contact.force * most_penetration * contact.size;
    const double created = -outcome.dissipated - outcome.work.contact_dissipation - opened;
    const double bent = settings_.theta < 1 ? std::abs(energy.bent) : 0;
    outcome.missing_energy = std::max({ std::abs(missing), created, bent }) / (energy.exchanged + least_force_ * way);
}

template class ImplicitStep<2>;

} // namespace softgrain
