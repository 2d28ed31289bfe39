// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/rigid_contacts.hpp"

#include "solver/rigid_balance.hpp"

#include <map>

namespace softgrain {

template <int Dim> void RigidContacts<Dim>::begin(ContactProblem<Dim>& problem)
{
    problem_ = &problem;
    locals_.clear();
    for (auto& contact : problem.contacts) {
        if (!knows(problem, contact)) continue;
        Local local { &contact, problem.bodies[size_t(contact.body)]->rigid, nullptr, {}, {}, {}, contact.impulse, 0, 0 };
        const Vec<Dim> place = problem.bodies[size_t(contact.body)]->x(contact.point);
        local.offset = contact.offset - contact.drive;
        Mat<Dim> W = Mat<Dim>::Zero();
        const auto take = [&](const Body* body, Lever& lever) {
            lever.setZero();
            if (!body) return;
            lever = body->lever(place);
            W += lever * body->mobility * lever.transpose();
        };
        take(local.body, local.lever);
        if (contact.other >= 0) local.other = problem.bodies[size_t(contact.other)]->rigid;
        take(local.other, local.other_lever);
        const double normal = contact.normal.dot(W * contact.normal), tangential = (W.trace() - normal) / (Dim - 1);
        local.along = normal > 0 ? 1 / normal : 0; // blocked along it: no impulse does anything
        local.across = tangential > 0 ? 1 / tangential : 0;
        contact.inertia = local.along;
        contact.free = approach(local);
        locals_.push_back(local);
    }
    gather_light();
}

template <int Dim> void RigidContacts<Dim>::gather_light()
{
    constexpr double lighter = 30;
    std::map<const Body*, std::vector<size_t>> contacts;
    light_.clear();
    for (const Local& local : locals_) {
        if (!local.body || !local.other) continue;
        const double mine = local.body->mobility.trace(), its = local.other->mobility.trace();
        Body* const light = mine > lighter * its ? local.body : its > lighter * mine ? local.other : nullptr;
        if (light && contacts.try_emplace(light).second) light_.push_back({ light, {} });
    }
    if (light_.empty()) return;
    for (size_t i = 0; i < locals_.size(); ++i)
        for (const Body* body : { locals_[i].body, locals_[i].other })
            if (const auto at = contacts.find(body); body && at != contacts.end()) at->second.push_back(i);
    for (Light& light : light_)
        light.contacts = contacts[light.body];
}

template <int Dim> Vec<Dim> RigidContacts<Dim>::approach(const Local& local) const
{
    Vec<Dim> u = local.offset;
    if (local.body) u += local.lever * (local.body->twist + local.body->gain);
    if (local.other) u -= local.other_lever * (local.other->twist + local.other->gain);
    return u;
}

template <int Dim> void RigidContacts<Dim>::strike(const Local& local, const Vec<Dim>& impulse)
{
    if (local.body) local.body->twist += local.body->mobility * (local.lever.transpose() * impulse);
    if (local.other) local.other->twist -= local.other->mobility * (local.other_lever.transpose() * impulse);
}

template <int Dim> void RigidContacts<Dim>::start()
{
    for (Local& local : locals_)
        if (local.impulse != Vec<Dim>::Zero()) strike(local, local.impulse);
}

template <int Dim> void RigidContacts<Dim>::sweep(double share)
{
    change = size = 0;
    for (Local& local : locals_) {
        const Contact<Dim>& contact = *local.contact;
        const Vec<Dim> u = approach(local), along = u.dot(contact.normal) * contact.normal;
        const Vec<Dim> trial = local.impulse - local.along * along - local.across * (u - along);
        Vec<Dim> impulse = contact.law->reaction({ contact.normal, contact.friction, trial });
        if (contact.friction > 0) impulse = local.impulse + share * (impulse - local.impulse);
        const Vec<Dim> step = impulse - local.impulse;
        size += impulse.squaredNorm();
        if (step == Vec<Dim>::Zero()) continue;
        change += step.squaredNorm();
        local.impulse = impulse;
        strike(local, step);
    }
    for (const Light& light : light_)
        settle(light);
}

template <int Dim> void RigidContacts<Dim>::settle(const Light& light)
{
    constexpr double least = 1e-8; // of the other side's mobility over this one's: balance() wants it finite
    std::vector<RigidContact<Dim>> contacts;
    typename Body::Twist gain = Body::Twist::Zero();
    for (size_t i : light.contacts) {
        const Local& local = locals_[i];
        const bool of_point = local.body == light.body;
        const Body* const other = of_point ? local.other : local.body;
        const Lever lever = of_point ? local.lever : Lever(-local.other_lever),
                    its = of_point ? local.other_lever : local.lever;
        double softest = least * (lever * light.body->mobility * lever.transpose()).trace(); // in any direction
        if (other) softest += (its * other->mobility * its.transpose()).trace();
        contacts.push_back({ local.contact->law, local.contact->normal, local.contact->friction, 1 / softest, lever,
                             approach(local), local.impulse });
        gain += light.body->mobility * (lever.transpose() * local.impulse);
    }
    balance(*light.body, gain, contacts);
    for (size_t k = 0; k < contacts.size(); ++k) {
        Local& local = locals_[light.contacts[k]];
        const Vec<Dim> step = contacts[k].impulse - local.impulse;
        change += step.squaredNorm();
        local.impulse = contacts[k].impulse;
        strike(local, step);
    }
}

template <int Dim> void RigidContacts<Dim>::finish()
{
    const auto move = [this](int index) {
        if (index < 0) return;
        Surface<Dim>& surface = *problem_->bodies[size_t(index)];
        for (int p = 0; surface.rigid && p < surface.count; ++p)
            surface.v(p) = surface.rigid->lever(surface.x(p)) * surface.rigid->twist;
    };
    for (const Local& local : locals_) {
        local.contact->impulse = local.impulse;
        move(local.contact->body);
        move(local.contact->other);
    }
}

template class RigidContacts<2>;

} // namespace softgrain
