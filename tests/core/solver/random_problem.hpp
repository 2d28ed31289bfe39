// SPDX-License-Identifier: GPL-2.0-or-later
// Random contact problems between three soft grains, a rigid body and planes, and their dense operators. Contacts
// share no surface points, so that their Delassus operator is regular.
#pragma once

#include "solver/nlgs.hpp"
#include "support/dense.hpp"
#include "support/grains.hpp"
#include "support/random.hpp"

#include <deque>
#include <optional>
#include <set>

namespace softgrain::testing_support {

struct RandomProblem {
    std::deque<Grain<2>> grains;
    Surface<2> rigid; ///< moved by nothing
    ContactProblem<2> problem;
    SignoriniCoulomb<2> law;
    std::vector<std::vector<double>> free_velocity; ///< of the bodies, without impulses

    RandomProblem(Random& random, int contacts, double friction)
    {
        for (int g = 0; g < 3; ++g) {
            grains.push_back(
                make_grain(mesh(), neo_hookean(), {}, random.log_uniform(0.3e-3, 3e-3), random.log_uniform(300, 3000)));
            problem.bodies.push_back(&grains.back().surface);
        }
        rigid.resize(40);
        problem.bodies.push_back(&rigid);
        for (Surface<2>* body : problem.bodies) {
            for (double& v : body->velocity)
                v = random.uniform(-1, 1);
            body->velocity_before = body->velocity;
            free_velocity.push_back(body->velocity);
        }
        while (int(problem.contacts.size()) < contacts)
            if (const auto c = contact(random, friction)) problem.contacts.push_back(*c);
    }

    RandomProblem(const RandomProblem&) = delete; // the problem points into it

    /// An arc of a grain pressed on planes, in place of the contacts: neighbours feel each other well.
    void press(Random& random, int contacts, double friction)
    {
        problem.contacts.clear();
        for (int c = 0; c < contacts; ++c) {
            Contact<2> contact {};
            contact.body = 0;
            contact.other = -1;
            contact.point = c;
            contact.normal = -grains[0].mesh->surface[c].position;
            contact.offset = random.uniform(-2, 0) * contact.normal;
            contact.drive.setZero();
            contact.friction = friction;
            contact.law = &law;
            contact.impulse.setZero();
            problem.contacts.push_back(contact);
        }
    }

    /// Coarse, so that contacts feel each other.
    static std::shared_ptr<const Discretisation<2>> mesh()
    {
        static const auto coarse = disc_mesh(60);
        return coarse;
    }
    static const Eigen::MatrixXd& surface_delassus()
    {
        static const Eigen::MatrixXd W = dense_delassus(*mesh());
        return W;
    }

    /// Nothing if its points are taken.
    std::optional<Contact<2>> contact(Random& random, double friction)
    {
        Contact<2> c {};
        c.body = random.integer(0, 2);
        c.other = random.integer(-1, 3);
        if (c.other == c.body) c.other = -1;
        if (c.other == 3 && random.integer(0, 1)) std::swap(c.body, c.other); // points of the rigid body too
        c.point = random.integer(0, problem.bodies[c.body]->count - 1);
        if (c.other >= 0) {
            const int first = random.integer(0, problem.bodies[c.other]->count - 4);
            const double t = random.uniform(0, 1), s = random.uniform(-0.1, 0.1);
            c.face = first + 1;
            c.vertex = { first, first + 1, first + 2, first + 3 };
            c.weight = { s, 1 - t, t, -s };
            for (int vertex : c.vertex)
                if (used_.count({ c.other, vertex })) return {};
        }
        if (used_.count({ c.body, c.point })) return {};
        used_.insert({ c.body, c.point });
        if (c.other >= 0)
            for (int vertex : c.vertex)
                used_.insert({ c.other, vertex });
        c.normal = random.unit<2>();
        c.offset = random.uniform(-0.2, 0.5) * c.normal;
        c.drive = c.other < 0 ? random.vector<2>(0.5) : Vec<2>(0, 0);
        c.friction = friction;
        c.law = &law;
        c.impulse = Vec<2>::Zero();
        return c;
    }

    /// Shares of the surface points of one body in the relative velocities, [contact][point].
    Eigen::MatrixXd shares(int body) const
    {
        Eigen::MatrixXd H = Eigen::MatrixXd::Zero(problem.contacts.size(), problem.bodies[body]->count);
        for (size_t i = 0; i < problem.contacts.size(); ++i) {
            const Contact<2>& c = problem.contacts[i];
            if (c.body == body) H(i, c.point) += 1;
            if (c.other == body)
                for (int k = 0; k < face_vertices<2>; ++k)
                    H(i, c.vertex[k]) -= c.weight[k];
        }
        return H;
    }

    /// Delassus operator between contacts, isotropic in space [1/kg]: sum over the grains of H N M^-1 N^T H^T.
    Eigen::MatrixXd delassus() const
    {
        Eigen::MatrixXd W = Eigen::MatrixXd::Zero(problem.contacts.size(), problem.contacts.size());
        for (int g = 0; g < 3; ++g)
            W += grains[g].surface.mobility * shares(g) * surface_delassus() * shares(g).transpose();
        return W;
    }

    /// Relative velocities without impulses, gap and drive included, [contact][axis].
    Eigen::MatrixXd free_approach() const
    {
        Eigen::MatrixXd q(problem.contacts.size(), 2);
        for (size_t i = 0; i < problem.contacts.size(); ++i)
            q.row(i) = (problem.contacts[i].offset - problem.contacts[i].drive).transpose();
        for (size_t b = 0; b < problem.bodies.size(); ++b)
            q += shares(int(b))
                * Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>>(free_velocity[b].data(),
                                                                                              problem.bodies[b]->count, 2);
        return q;
    }

    Eigen::MatrixXd impulses() const
    {
        Eigen::MatrixXd r(problem.contacts.size(), 2);
        for (size_t i = 0; i < problem.contacts.size(); ++i)
            r.row(i) = problem.contacts[i].impulse.transpose();
        return r;
    }

    /// Velocities of the bodies as the impulses ask for, by the dense operators.
    std::vector<std::vector<double>> velocities() const
    {
        std::vector<std::vector<double>> all = free_velocity;
        for (int g = 0; g < 3; ++g) {
            Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>> v(all[g].data(), grains[g].surface.count,
                                                                                    2);
            v += grains[g].surface.mobility * surface_delassus() * shares(g).transpose() * impulses();
        }
        return all;
    }

    /// Back to the free velocities and, if asked for, no impulses.
    void reset(bool impulses = true)
    {
        for (size_t b = 0; b < problem.bodies.size(); ++b)
            problem.bodies[b]->velocity = free_velocity[b];
        if (impulses)
            for (auto& c : problem.contacts)
                c.impulse.setZero();
    }

private:
    std::set<std::pair<int, int>> used_; ///< body, point
};

} // namespace softgrain::testing_support
