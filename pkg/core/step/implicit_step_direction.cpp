// SPDX-License-Identifier: GPL-2.0-or-later
// The search direction of an iteration.
#include "step/implicit_step.hpp"
#include "step/smoothed_friction.hpp"

#include <cmath>

namespace softgrain {

/// Says which contacts count in the linear system. One that comes near does at once; those that stand off are left out when
/// they are many, since the system is then analysed anew.
template <int Dim> void ImplicitStep<Dim>::sort_contacts()
{
    const auto stands_off = [&](const BarrierContact<Dim>& contact) {
        return contact.slack > 0.3 * ahead * contact.size && contact.force < 0.05 * shear_modulus_ * contact.slack;
    };
    int idle = 0, counted = 0;
    for (auto& contact : contacts) {
        const bool off = stands_off(contact);
        contact.aloof &= off;
        counted += !contact.aloof;
        idle += off && !contact.aloof;
    }
    if (!sorted_ || 4 * idle > counted)
        for (auto& contact : contacts)
            contact.aloof = stands_off(contact);
    sorted_ = true;
    system_.analyse(contacts, int(scene_->bodies.size()));
}

/// Stiffnesses, and the contact system without its diagonal. Pressure stiffens the search direction of a grain where full
/// steps have failed. Factors serve several iterations: what they are off by is made up for by conjugate gradients.
template <int Dim> void ImplicitStep<Dim>::condense()
{
    std::vector<double> damping(assembly_.grains().size(), 0);
    for (const auto& contact : contacts)
        for (int body : { contact.body, contact.other })
            if (body >= 0 && size_t(body) < damping.size()) damping[size_t(body)] += contact.force; // rigid ones come last
    for (size_t g = 0; g < damping.size(); ++g)
        damping[g] *= damping_ / (2 * M_PI * assembly_.grains()[g]->radius);
    const bool anew = factor_age_ == 0;
    grains_.condense(damping, anew);
    factor_age_ = (factor_age_ + 1) % most_uses_of_factors;
    sort_contacts();
    auto compliance = grains_.compliance();
    compliance.resize(scene_->bodies.size(), nullptr);
    system_.assemble(contacts, compliance, points_);
}

/// Ways along normals and tangents of the contacts, from those of the surfaces.
template <int Dim> Eigen::VectorXd ImplicitStep<Dim>::at_contacts(const SurfaceField& way) const
{
    Eigen::VectorXd rows(system_.rows());
    for (size_t c = 0; c < contacts.size(); ++c) {
        if (contacts[c].aloof) continue;
        const Vec<Dim> apart = difference(contacts[c], way);
        const int row = system_.row(int(c));
        rows[row] = contacts[c].normal.dot(apart);
        if (contacts[c].friction > 0) rows[row + 1] = contacts[c].tangent().dot(apart);
    }
    return rows;
}

/// Forces at the surfaces, from those along normals and tangents of the contacts.
template <int Dim> SurfaceField& ImplicitStep<Dim>::at_surfaces(const Eigen::VectorXd& rows)
{
    clear(forces_);
    for (size_t c = 0; c < contacts.size(); ++c) {
        if (contacts[c].aloof) continue;
        const int row = system_.row(int(c));
        Vec<Dim> force = rows[row] * contacts[c].normal;
        if (contacts[c].friction > 0) force += rows[row + 1] * contacts[c].tangent();
        add_force<Dim>(contacts[c], force, forces_);
    }
    return forces_;
}

/// Changes of forces and slacks towards r s = kappa, less a correction of second order, for grains that go `moved_` besides
/// what forces change.
template <int Dim> Eigen::VectorXd ImplicitStep<Dim>::solve_contacts(double kappa, const Eigen::VectorXd& correction)
{
    for (size_t c = 0; c < contacts.size(); ++c) {
        auto& contact = contacts[c];
        const int row = system_.row(int(c));
        contact.force_step = contact.shear_step = contact.slack_step = 0;
        if (contact.aloof) continue;
        contact.slack_step = (kappa - correction[Eigen::Index(c)]) / contact.force - contact.slack;
        target_[row] = contact.slack + contact.slack_step - contact.gap;
        if (contact.friction > 0) {
            const double bound = contact.friction * contact.force;
            const double slope = SmoothedFriction::slope_for(contact.shear, contact.slide, bound, kappa_);
            target_[row + 1] = (-SmoothedFriction(contact.slide, bound, kappa_).force - contact.shear) / slope;
        }
    }
    const Eigen::VectorXd change = system_.solve(target_ - free_);
    change_forces(change);
    return change;
}

/// Adds changes of forces, and what they do to the slacks, to the search direction.
template <int Dim> void ImplicitStep<Dim>::change_forces(const Eigen::VectorXd& by)
{
    for (size_t c = 0; c < contacts.size(); ++c) {
        auto& contact = contacts[c];
        if (contact.aloof) continue;
        const int row = system_.row(int(c));
        contact.force_step += by[row];
        contact.slack_step -= contact.slack * by[row] / contact.force;
        if (contact.friction > 0) contact.shear_step += by[row + 1];
    }
}

/// Search direction: changes of forces and slacks, and the grains' way. False when the contact system is singular.
template <int Dim> bool ImplicitStep<Dim>::find_direction(const Outcome& outcome)
{
    using Contact = BarrierContact<Dim>;
    constexpr double least_left = 1e-2; // of kappa, after an iteration
    Eigen::VectorXd diagonal(system_.rows()), change(system_.rows());
    target_.resize(system_.rows());
    grains_.solve(moved_);
    free_ = at_contacts(moved_);
    if (system_.rows() > 0) {
        for (size_t c = 0; c < contacts.size(); ++c) {
            const auto& contact = contacts[c];
            if (contact.aloof) continue;
            const int row = system_.row(int(c));
            diagonal[row] = contact.slack / contact.force;
            if (contact.friction == 0) continue;
            diagonal[row + 1]
                = 1 / SmoothedFriction::slope_for(contact.shear, contact.slide, contact.friction * contact.force, kappa_);
        }
        if (!system_.factorise(diagonal)) return false;
        // Mehrotra 1992: how far kappa could fall at once says how far it is taken down
        Eigen::VectorXd correction = Eigen::VectorXd::Zero(Eigen::Index(contacts.size()));
        solve_contacts(0, correction);
        const double primal = largest_share(&Contact::slack, &Contact::slack_step),
                     dual = largest_share(&Contact::force, &Contact::force_step);
        double now = 0, then = 0, floor = 0;
        int counted = 0;
        for (size_t c = 0; c < contacts.size(); ++c) {
            const auto& contact = contacts[c];
            if (contact.aloof) continue;
            ++counted;
            now += contact.slack * contact.force;
            then += (contact.slack + primal * contact.slack_step) * (contact.force + dual * contact.force_step);
            floor += contact.force * std::min(contact.size, 1e4 * contact.force * contact.compliance);
            correction[Eigen::Index(c)] = primal * dual * contact.slack_step * contact.force_step;
        }
        for (double* sum : { &now, &then, &floor })
            *sum /= counted;
        // once low enough kappa need not fall further; it must not rise again either, or the two would take turns
        const double low = 1e-8 * settings_.tolerance * floor;
        floor = outcome.residual > 0.5 * settings_.tolerance ? low : std::clamp(kappa_, low, 1e3 * low);
        kappa_ = std::max(floor, now * std::clamp(std::pow(then / now, 3), least_left, 1.0));
        change = solve_contacts(kappa_, correction);
    } else
        kappa_ *= least_left;
    grains_.solve(moved_, &at_surfaces(change));
    refine(change);
    grains_.take_direction(moved_);
    for (auto& contact : contacts)
        if (contact.aloof) {
            contact.slack_step = contact.gap - contact.slack + contact.normal.dot(difference(contact, moved_));
            contact.force_step = (kappa_ - contact.force * contact.slack_step) / contact.slack - contact.force;
        }
    return true;
}

/// The direction so far solves Newton's equations with K, the stiffness of grains made positive definite, in place of the
/// whole second derivative A, which knows of pressures, of the turning of contacts and of the present place. Conjugate
/// gradients with K and the contact system as the preconditioner make up for it; all their iterates keep the equations of the
/// contacts (Gould, Hribar and Nocedal 2001). They end when the direction is good to a tenth, in the norm of K and contacts,
/// or where the potential hardly curves upwards.
template <int Dim> void ImplicitStep<Dim>::refine(const Eigen::VectorXd& change)
{
    constexpr int most = 10;
    constexpr double good = 0.1, least_curvature = 0.1; // over that of K and the contacts
    turning_.look(contacts, scene_->bodies);
    turning_.add(contacts, moved_, at_surfaces(change));
    const double size = grains_.begin_conjugate(forces_) + target_.dot(change); // work of the direction
    Eigen::VectorXd total = Eigen::VectorXd::Zero(system_.rows()), along = total;
    clear(conjugate_);
    double before = 1, stiff = 0;
    for (int k = 0; k < most; ++k) {
        grains_.precondition(moved_);
        const Eigen::VectorXd forces = system_.rows() == 0 ? total : Eigen::VectorXd(system_.solve(-at_contacts(moved_)));
        const double now = grains_.precondition(moved_, &at_surfaces(forces)), share = k == 0 ? 0 : now / before;
        if (!(now > good * good * size)) break;
        before = now;
        stiff = now + share * share * stiff;
        grains_.turn_conjugate(share);
        along = forces + share * along;
        for (size_t b = 0; b < conjugate_.size(); ++b)
            for (size_t i = 0; i < conjugate_[b].size(); ++i)
                conjugate_[b][i] = moved_[b][i] + share * conjugate_[b][i];
        turning_.add(contacts, conjugate_, at_surfaces(along));
        const double curvature = grains_.curvature(forces_);
        if (!(curvature > least_curvature * stiff)) break;
        grains_.go_conjugate(now / curvature);
        total += now / curvature * along;
        if (k + 1 == most) factor_age_ = 0;
    }
    change_forces(total);
}

template <int Dim>
double ImplicitStep<Dim>::largest_share(double BarrierContact<Dim>::*value, double BarrierContact<Dim>::*step) const
{
    double share = 1;
    for (const auto& contact : contacts)
        if (contact.*step < 0) share = std::min(share, -fraction_to_boundary * contact.*value / contact.*step);
    return share;
}

template class ImplicitStep<2>;

} // namespace softgrain
