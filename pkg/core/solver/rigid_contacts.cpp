// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/rigid_contacts.hpp"

#include "base/lanes.hpp"
#include "solver/rigid_balance.hpp"

#include <map>
#include <typeinfo>

namespace softgrain {

template <int Dim> void RigidContacts<Dim>::begin(ContactProblem<Dim>& problem)
{
    problem_ = &problem;
    locals_.clear();
    bodies_.assign(1, { nullptr, Twist::Zero() });
    place_.assign(problem.bodies.size(), 0);
    place_of_.clear();
    for (auto& contact : problem.contacts) {
        if (!knows(problem, contact)) continue;
        const Vec<Dim> place = problem.bodies[size_t(contact.body)]->x(contact.point), zero = Vec<Dim>::Zero();
        const bool coulomb = typeid(*contact.law) == typeid(SignoriniCoulomb<Dim>);
        Local local { side(contact.body, place),
                      side(contact.other, place),
                      contact.normal,
                      contact.offset - contact.drive,
                      contact.impulse,
                      zero,
                      zero,
                      0,
                      0,
                      contact.friction,
                      contact.law,
                      coulomb ? static_cast<const SignoriniCoulomb<Dim>*>(contact.law) : nullptr,
                      &contact };
        const Mat<Dim> W = local.point.lever * local.point.response + local.face.lever * local.face.response;
        const double normal = contact.normal.dot(W * contact.normal), tangential = (W.trace() - normal) / (Dim - 1);
        local.along = normal > 0 ? 1 / normal : 0; // blocked along it: no impulse does anything
        local.across = tangential > 0 ? 1 / tangential : 0;
        contact.inertia = local.along;
        contact.free = approach(local);
        locals_.push_back(local);
    }
    gather_light();
    change_before_ = change = 0;
}

template <int Dim> typename RigidContacts<Dim>::Side RigidContacts<Dim>::side(int surface, const Vec<Dim>& place)
{
    Body* const body = surface < 0 ? nullptr : problem_->bodies[size_t(surface)]->rigid;
    if (!body) return {};
    size_t& at = place_[size_t(surface)];
    if (at == 0) {
        const auto [known, added] = place_of_.try_emplace(body, bodies_.size());
        if (added) bodies_.push_back({ body, body->twist + body->gain });
        at = known->second;
    }
    const Lever lever = body->lever(place);
    return { at, lever, body->mobility * lever.transpose() };
}

template <int Dim> void RigidContacts<Dim>::gather_light()
{
    constexpr double lighter = 30;
    std::map<size_t, std::vector<size_t>> contacts;
    light_.clear();
    for (const Local& local : locals_) {
        if (local.point.body == 0 || local.face.body == 0) continue;
        const double mine = bodies_[local.point.body].body->mobility.trace(),
                     its = bodies_[local.face.body].body->mobility.trace();
        const size_t light = mine > lighter * its ? local.point.body : its > lighter * mine ? local.face.body : 0;
        if (light > 0 && contacts.try_emplace(light).second) light_.push_back({ light, {} });
    }
    if (light_.empty()) return;
    for (size_t i = 0; i < locals_.size(); ++i)
        for (size_t body : { locals_[i].point.body, locals_[i].face.body })
            if (const auto at = contacts.find(body); at != contacts.end()) at->second.push_back(i);
    for (Light& light : light_)
        light.contacts = contacts[light.body];
}

template <int Dim> void RigidContacts<Dim>::fetch_twists()
{
    for (size_t b = 1; b < bodies_.size(); ++b)
        bodies_[b].twist = bodies_[b].body->twist + bodies_[b].body->gain;
}

template <int Dim> void RigidContacts<Dim>::store_twists()
{
    for (size_t b = 1; b < bodies_.size(); ++b)
        bodies_[b].body->twist = bodies_[b].twist - bodies_[b].body->gain;
}

template <int Dim> SOFTGRAIN_INLINE Vec<Dim> RigidContacts<Dim>::reaction(const Local& local, const Vec<Dim>& trial) const
{
    const LocalContact<Dim> problem { local.normal, local.friction, trial };
    // the common law is called by name, so that it is inlined
    return local.coulomb ? local.coulomb->SignoriniCoulomb<Dim>::reaction(problem) : local.law->reaction(problem);
}

template <int Dim> SOFTGRAIN_INLINE Vec<Dim> RigidContacts<Dim>::approach(const Local& local) const
{
    return local.offset + local.point.lever * bodies_[local.point.body].twist
        - local.face.lever * bodies_[local.face.body].twist;
}

template <int Dim> SOFTGRAIN_INLINE void RigidContacts<Dim>::strike(const Local& local, const Vec<Dim>& impulse)
{
    bodies_[local.point.body].twist += local.point.response * impulse;
    bodies_[local.face.body].twist -= local.face.response * impulse;
}

template <int Dim> void RigidContacts<Dim>::start()
{
    fetch_twists();
    for (const Local& local : locals_)
        if (local.impulse != Vec<Dim>::Zero()) strike(local, local.impulse);
    store_twists();
}

/// From the impulses of the last sweep, by a step of conjugate gradients after Fletcher and Reeves; anew where sweeps diverge.
template <int Dim> void RigidContacts<Dim>::go_on()
{
    const double ratio = change_before_ > 0 ? change / change_before_ : 0;
    const bool anew = !(ratio > 0 && ratio <= 1);
    change_before_ = change;
    for (Local& local : locals_) {
        if (anew) {
            local.way = ratio > 1 ? Vec<Dim>(Vec<Dim>::Zero()) : local.step;
            continue;
        }
        const Vec<Dim> impulse = reaction(local, local.impulse + ratio * local.way);
        local.way = ratio * local.way + local.step;
        if (impulse != local.impulse) strike(local, impulse - local.impulse);
        local.impulse = impulse;
    }
}

template <int Dim> void RigidContacts<Dim>::sweep(double share)
{
    fetch_twists();
    go_on();
    change = size = 0;
    for (Local& local : locals_) {
        const Vec<Dim> u = approach(local), along = u.dot(local.normal) * local.normal;
        Vec<Dim> impulse = reaction(local, local.impulse - local.along * along - local.across * (u - along));
        if (local.friction > 0) impulse = local.impulse + share * (impulse - local.impulse);
        local.step = impulse - local.impulse;
        size += impulse.squaredNorm();
        if (local.step == Vec<Dim>::Zero()) continue;
        change += local.step.squaredNorm();
        local.impulse = impulse;
        strike(local, local.step);
    }
    for (const Light& light : light_)
        settle(light);
    store_twists();
}

template <int Dim> void RigidContacts<Dim>::settle(const Light& light)
{
    constexpr double least = 1e-8; // of the other side's mobility over this one's: balance() wants it finite
    const Body& body = *bodies_[light.body].body;
    std::vector<RigidContact<Dim>> contacts;
    Twist gain = Twist::Zero();
    for (size_t i : light.contacts) {
        const Local& local = locals_[i];
        const bool of_point = local.point.body == light.body;
        const Side &mine = of_point ? local.point : local.face, &its = of_point ? local.face : local.point;
        const double softest // in any direction
            = least * (mine.lever * mine.response).trace() + (its.lever * its.response).trace();
        const Lever lever = of_point ? mine.lever : Lever(-mine.lever);
        contacts.push_back({ local.law, local.normal, local.friction, 1 / softest, lever, approach(local), local.impulse });
        gain += body.mobility * (lever.transpose() * local.impulse);
    }
    balance(body, gain, contacts);
    for (size_t k = 0; k < contacts.size(); ++k) {
        Local& local = locals_[light.contacts[k]];
        const Vec<Dim> step = contacts[k].impulse - local.impulse;
        change += step.squaredNorm();
        local.step += step;
        local.impulse = contacts[k].impulse;
        strike(local, step);
    }
}

template <int Dim> void RigidContacts<Dim>::finish()
{
    for (const Local& local : locals_)
        local.contact->impulse = local.impulse;
}

template class RigidContacts<2>;

} // namespace softgrain
