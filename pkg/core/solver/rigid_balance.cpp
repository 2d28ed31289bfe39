// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/rigid_balance.hpp"

#include <cmath>

namespace softgrain {
namespace {

    template <int Dim> using Lever = Eigen::Matrix<double, Dim, RigidBody<Dim>::twists>;

    /// A contact law as an equation, r = law(r - inertia u), and its Newton step dr = step - turn dg at a change dg of the twist.
    template <int Dim> struct LawEquation {
        double inertia;    ///< of the whole contact, in no direction more: states of contacts would flip over
        Vec<Dim> reaction; ///< by the law
        Vec<Dim> step;
        Lever<Dim> turn;

        LawEquation(const Mat<RigidBody<Dim>::twists>& mobility, const RigidContact<Dim>& contact)
        {
            inertia = 1 / (1 / contact.inertia + (contact.lever * mobility * contact.lever.transpose()).trace());
            const Vec<Dim> trial = contact.impulse - inertia * contact.velocity;
            reaction = contact.law->reaction({ contact.normal, contact.friction, trial });
            Mat<Dim> slope = Mat<Dim>::Zero(); // of the law, which is linear but for kinks
            const double near = 1e-3 * reaction.norm();
            for (int d = 0; near > 0 && d < Dim; ++d) {
                const Vec<Dim> other = trial + near * Vec<Dim>::Unit(d);
                slope.col(d) = (contact.law->reaction({ contact.normal, contact.friction, other }) - reaction) / near;
            }
            const Mat<Dim> solved = (Mat<Dim>::Identity() - (1 - inertia / contact.inertia) * slope).inverse();
            step = solved * (reaction - contact.impulse);
            turn = inertia * solved * slope * contact.lever;
        }
    };

    /// Newton's method for a body of this mobility; false, with nothing of use left, when it does not converge.
    template <int Dim>
    bool converges(const Mat<RigidBody<Dim>::twists>& mobility, typename RigidBody<Dim>::Twist& gain,
                   std::vector<RigidContact<Dim>>& contacts)
    {
        using Twist = typename RigidBody<Dim>::Twist;
        constexpr int most = 30,
                      patience = 10; // steps; from the latter on half ones, so that states of contacts do not cycle
        constexpr double round_off = 1e-14, enough = 1e-6;
        thread_local std::vector<LawEquation<Dim>> equations;
        for (int round = 0;; ++round) {
            equations.clear();
            double change = 0, size = 0;
            Twist sum = Twist::Zero();
            for (const auto& contact : contacts) {
                equations.emplace_back(mobility, contact);
                change += (equations.back().reaction - contact.impulse).squaredNorm();
                size += equations.back().reaction.squaredNorm();
                sum += contact.lever.transpose() * equations.back().reaction;
            }
            if (round == most || (round > 0 && change <= round_off * round_off * size)) {
                for (size_t i = 0; i < contacts.size(); ++i)
                    contacts[i].impulse = equations[i].reaction;
                gain = mobility * sum;
                return change <= enough * enough * size;
            }
            Mat<RigidBody<Dim>::twists> resistance = Mat<RigidBody<Dim>::twists>::Zero();
            sum.setZero();
            for (size_t i = 0; i < contacts.size(); ++i) {
                sum += contacts[i].lever.transpose() * (contacts[i].impulse + equations[i].step);
                resistance += contacts[i].lever.transpose() * equations[i].turn;
            }
            const Mat<RigidBody<Dim>::twists> operation = Mat<RigidBody<Dim>::twists>::Identity() + mobility * resistance;
            const double share = round < patience ? 1 : 0.5;
            const Twist way = share * operation.partialPivLu().solve(mobility * sum - gain);
            gain += way;
            for (size_t i = 0; i < contacts.size(); ++i) {
                RigidContact<Dim>& contact = contacts[i];
                const Vec<Dim> step = share * equations[i].step - equations[i].turn * way;
                contact.impulse += step;
                contact.velocity += step / contact.inertia + contact.lever * way;
            }
        }
    }

} // namespace

template <int Dim>
void balance(const RigidBody<Dim>& body, typename RigidBody<Dim>::Twist& gain, std::vector<RigidContact<Dim>>& contacts)
{
    const auto start = gain;
    const auto given = contacts;
    constexpr double heaviest = 1e9;
    for (double heavier = 1; !converges<Dim>(body.mobility / heavier, gain, contacts) && heavier < heaviest; heavier *= 10) {
        gain = start;
        contacts = given;
    }
}

template void balance<2>(const RigidBody<2>&, RigidBody<2>::Twist&, std::vector<RigidContact<2>>&);

} // namespace softgrain
