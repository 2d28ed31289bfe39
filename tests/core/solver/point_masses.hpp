// SPDX-License-Identifier: GPL-2.0-or-later
// Point masses on a line or in the plane, one surface point each, that meet in contacts whose normals are given.
#pragma once

#include "law/newton_impact.hpp"
#include "solver/nlgs.hpp"

#include <deque>

namespace softgrain::testing_support {

class PointMasses {
public:
    explicit PointMasses(const std::vector<double>& masses)
    {
        for (double mass : masses) {
            operators_.emplace_back().build({ { { 0, 1 } }, { { 1, 1 } }, { { 2, 1 } }, { { 3, 1 } } },
                                            std::vector<double>(4, mass));
            Surface<2>& body = surfaces_.emplace_back();
            body.resize(4); // the first counts; a face follows four vertices
            body.mobility = 1;
            body.response = &operators_.back();
            problem.bodies.push_back(&body);
        }
    }
    PointMasses(const PointMasses&) = delete; // the problem points into it

    ContactProblem<2> problem;
    double friction = 0;
    NewtonImpact<2> impact;

    Eigen::Map<Vec<2>> v(int mass) { return problem.bodies[size_t(mass)]->v(0); }
    /// Of the velocities as they are, without a step's forces.
    void begin()
    {
        problem.contacts.clear();
        for (auto* body : problem.bodies)
            body->velocity_before = body->velocity;
    }
    /// A contact of `first` with `second` (-1: a plane at rest), the normal towards `first`; `pressed`: it bore a force before.
    void touch(int first, int second, const Vec<2>& normal, double gap_speed = 0, bool pressed = false)
    {
        ContactPoint<2> point {};
        point.normal = normal;
        if (pressed) point.force = normal;
        const Contact<2> plain { first,          second,         0,      0,
                                 { 3, 0, 1, 2 }, { 0, 1, 0, 0 }, normal, gap_speed * normal,
                                 Vec<2>::Zero(), friction,       &law_,  Vec<2>::Zero() };
        problem.add(plain);
        Contact<2>& contact = problem.contacts.back();
        contact.offset = impact.offset(point, contact.offset, problem.relative(contact, &Surface<2>::velocity_before),
                                       problem.relative(contact, &Surface<2>::velocity));
    }
    void solve() { NonlinearGaussSeidel<2>(1e-13, 1000).solve(problem); }

private:
    SignoriniCoulomb<2> law_;
    std::deque<SurfaceOperator<2>> operators_;
    std::deque<Surface<2>> surfaces_;
};

/// Work that the contacts of a solved problem take in: impulses times the mean of the velocities before and after.
inline double dissipated(const ContactProblem<2>& problem)
{
    double sum = 0;
    for (const auto& contact : problem.contacts)
        sum -= contact.impulse.dot(problem.relative(contact, &Surface<2>::velocity)
                                   + problem.relative(contact, &Surface<2>::velocity_before))
            / 2;
    return sum;
}

} // namespace softgrain::testing_support
