// SPDX-License-Identifier: GPL-2.0-or-later
// Contact problems in which a rigid body is moved by the impulses.
#include "random_problem.hpp"

#include "solver/matrix_form.hpp"

#include <gtest/gtest.h>

#include <cstdio>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// A random problem whose rigid body is free: a disc with its points on the rim,
/// pushed more or less towards its centre, of this mass over that of the first grain.
struct FreeProblem : RandomProblem {
    RigidBody<2> body;
    RigidBody<2>::Twist before;

    FreeProblem(Random& random, int contacts, double friction, double mass_ratio)
        : RandomProblem(random, contacts, friction)
    {
        const double radius = 1e-3, mass = mass_ratio * grains[0].mass();
        body.centre = random.vector<2>(1e-2);
        for (int p = 0; p < rigid.count; ++p) {
            const double angle = 2 * M_PI * p / rigid.count;
            Eigen::Map<Vec<2>>(&rigid.position[size_t(2) * p])
                = body.centre + radius * Vec<2>(std::cos(angle), std::sin(angle));
        }
        body.mobility.setZero();
        body.mobility.diagonal() << 1 / mass, 1 / mass, 2 / (mass * radius * radius);
        body.twist << random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1) / radius;
        before = body.twist;
        for (Contact<2>& contact : problem.contacts) {
            if (contact.body != 3 && contact.other != 3) continue;
            const Vec<2> arm
                = contact.body == 3 ? Vec<2>(body.centre - rigid.x(contact.point)) : foot(contact) - body.centre;
            const double gap_speed = contact.offset.dot(contact.normal);
            contact.normal = Eigen::Rotation2Dd(random.uniform(-0.2, 0.2)) * arm.normalized();
            contact.offset = gap_speed * contact.normal;
        }
        rigid.rigid = &body;
        for (int p = 0; p < rigid.count; ++p)
            rigid.v(p) = body.lever(rigid.x(p)) * body.twist;
        free_velocity[3] = rigid.velocity;
    }

    /// On the body's face.
    Vec<2> foot(const Contact<2>& contact) const
    {
        Vec<2> place = Vec<2>::Zero();
        for (int k = 0; k < face_vertices<2>; ++k)
            place += contact.weight[k] * rigid.x(contact.vertex[k]);
        return place;
    }

    /// Relative velocities by a unit twist of the body, [contact, axis][twist].
    Eigen::MatrixXd levers() const
    {
        const Eigen::MatrixXd H = shares(3);
        Eigen::MatrixXd all = Eigen::MatrixXd::Zero(2 * H.rows(), 3);
        for (int i = 0; i < H.rows(); ++i)
            for (int p = 0; p < H.cols(); ++p) {
                const Vec<2> arm = rigid.x(p) - body.centre;
                all.block<2, 3>(2 * i, 0)
                    += H(i, p) * (Eigen::Matrix<double, 2, 3>() << 1, 0, -arm[1], 0, 1, arm[0]).finished();
            }
        return all;
    }

    /// Delassus operator, [contact, axis][contact, axis].
    Eigen::MatrixXd full_delassus() const
    {
        const Eigen::MatrixXd soft = delassus(), L = levers();
        Eigen::MatrixXd W = L * body.mobility * L.transpose();
        for (int i = 0; i < soft.rows(); ++i)
            for (int j = 0; j < soft.cols(); ++j)
                W.block<2, 2>(2 * i, 2 * j) += soft(i, j) * Mat<2>::Identity();
        return W;
    }

    static Eigen::VectorXd flat(const Eigen::MatrixXd& rows)
    {
        Eigen::VectorXd all(rows.size());
        for (int i = 0; i < rows.rows(); ++i)
            all.segment<2>(2 * i) = rows.row(i).transpose();
        return all;
    }
};

constexpr double ratios[] = { 1e-6, 1e-2, 1, 1e2, 1e6 };

TEST(FreeRigidBody, TwistAndSurfacesMatchTheImpulses)
{
    Random random(21);
    for (double ratio : ratios)
        for (int trial = 0; trial < 20; ++trial) {
            FreeProblem p(random, random.integer(1, 9), 0.3, ratio);
            NonlinearGaussSeidel<2>(1e-3, 20).solve(p.problem); // converged or not
            const auto levers = p.levers();
            const RigidBody<2>::Twist sum = levers.transpose() * FreeProblem::flat(p.impulses()),
                                      gain = p.body.twist - p.before;
            const RigidBody<2>::Twist scale
                = p.body.mobility * (levers.cwiseAbs().transpose() * FreeProblem::flat(p.impulses()).cwiseAbs());
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(gain[k], (p.body.mobility * sum)[k], 1e-15 * (10 * scale[k] + 2 * std::abs(p.body.twist[k])));
            const auto expected = p.velocities();
            for (int b = 0; b < 3; ++b)
                for (size_t i = 0; i < expected[b].size(); ++i)
                    ASSERT_NEAR(p.problem.bodies[b]->velocity[i], expected[b][i], 1e-12);
            for (int q = 0; q < p.rigid.count; ++q)
                EXPECT_LE((p.rigid.v(q) - p.body.lever(p.rigid.x(q)) * p.body.twist).norm(), 1e-15);
        }
}

TEST(FreeRigidBody, SweepsDoNotDependOnItsMass)
{
    Random random(22);
    for (double friction : { 0.0, 0.3 })
        for (double ratio : ratios) {
            int most = 0, sweeps = 0;
            double worst = 0;
            for (int trial = 0; trial < 60; ++trial) {
                FreeProblem p(random, random.integer(1, 9), friction, ratio);
                const int needed = NonlinearGaussSeidel<2>(1e-8, 10000).solve(p.problem);
                most = std::max(most, needed);
                sweeps += needed;
                worst = std::max(worst, p.problem.residual());
            }
            EXPECT_LT(most, 500) << friction << " " << ratio;
            EXPECT_LE(worst, 1e-7) << friction << " " << ratio;
            std::printf("friction %.1f, mass ratio %.0e: %.1f sweeps, at most %d, residual %.1e\n", friction, ratio,
                        sweeps / 60.0, most, worst);
        }
}

// Signorini's conditions and Coulomb's, from the dense operator.
TEST(FreeRigidBody, FulfilsTheLawByTheDenseOperator)
{
    Random random(23);
    for (double ratio : ratios)
        for (int trial = 0; trial < 30; ++trial) {
            FreeProblem p(random, random.integer(2, 9), trial % 2 ? 0.3 : 0, ratio);
            NonlinearGaussSeidel<2>(1e-13, 20000).solve(p.problem);
            const Eigen::VectorXd r = FreeProblem::flat(p.impulses()), q = FreeProblem::flat(p.free_approach());
            const Eigen::MatrixXd W = p.full_delassus();
            const Eigen::VectorXd u = W * r + q;
            const double small = 1e-9 * std::max(q.norm(), u.norm());
            for (size_t i = 0; i < p.problem.contacts.size(); ++i) {
                const Vec<2> n = p.problem.contacts[i].normal, t(-n.y(), n.x());
                const double rn = r.segment<2>(2 * i).dot(n), rt = r.segment<2>(2 * i).dot(t),
                             un = u.segment<2>(2 * i).dot(n), ut = u.segment<2>(2 * i).dot(t),
                             mu = p.problem.contacts[i].friction;
                EXPECT_GE(rn, 0);
                EXPECT_GE(un, -small);
                EXPECT_TRUE(rn == 0 || un <= small) << rn << " " << un;
                EXPECT_LE(std::abs(rt), (mu + 1e-12) * rn);
                EXPECT_TRUE(std::abs(ut) <= small || std::abs(rt + std::copysign(mu * rn, ut)) <= 1e-9 * rn)
                    << rt << " " << ut;
            }
        }
}

TEST(FreeRigidBody, HeavyIsDriven)
{
    Random heavy(24), driven(24);
    for (int trial = 0; trial < 20; ++trial) {
        FreeProblem a(heavy, 6, 0.3, 1e12), b(driven, 6, 0.3, 1);
        b.rigid.rigid = nullptr;
        NonlinearGaussSeidel<2>(1e-12, 10000).solve(a.problem);
        NonlinearGaussSeidel<2>(1e-12, 10000).solve(b.problem);
        EXPECT_LE((a.impulses() - b.impulses()).norm(), 1e-9 * b.impulses().norm());
    }
}

TEST(FreeRigidBody, KeepsBlockedVelocities)
{
    Random random(25);
    for (int trial = 0; trial < 20; ++trial) {
        FreeProblem p(random, 8, 0.3, 1);
        p.body.mobility(0, 0) = p.body.mobility(2, 2) = 0;
        NonlinearGaussSeidel<2>(1e-10, 1000).solve(p.problem);
        EXPECT_EQ(p.body.twist[0], p.before[0]);
        EXPECT_EQ(p.body.twist[2], p.before[2]);
        EXPECT_LE(p.problem.residual(), 1e-7);
    }
}

TEST(FreeRigidBody, IsInTheMatrixForm)
{
    Random random(26);
    for (int trial = 0; trial < 20; ++trial) {
        FreeProblem p(random, random.integer(1, 9), 0.3, 1);
        NonlinearGaussSeidel<2>().solve(p.problem);
        const auto form = matrix_form(p.problem);
        const Eigen::VectorXd expected = p.full_delassus() * FreeProblem::flat(p.impulses());
        const Eigen::VectorXd found = form.W * form.r;
        for (size_t i = 0; i < p.problem.contacts.size(); ++i) {
            const Vec<2> n = p.problem.contacts[i].normal, t(-n.y(), n.x()), u = expected.segment<2>(2 * i);
            EXPECT_LE((found.segment<2>(2 * i) - Vec<2>(u.dot(n), u.dot(t))).norm(), 1e-13 * expected.norm());
        }
        EXPECT_LE((form.u - found - form.q).norm(), 1e-12 * form.q.norm());
    }
}

/// A row of grains with rigid discs on three of them each, some of which lie far apart.
std::vector<Vec<2>> impulses_of_a_row(int threads)
{
    Random random(27);
    const SignoriniCoulomb<2> law;
    std::deque<Grain<2>> grains;
    std::deque<Surface<2>> surfaces;
    std::deque<RigidBody<2>> bodies;
    ContactProblem<2> problem;
    for (int g = 0; g < 400; ++g) {
        GrainStart start;
        start.centre = Vec<2>(2e-3 * g, 0);
        grains.push_back(make_grain(RandomProblem::mesh(), neo_hookean(), start));
        problem.bodies.push_back(&grains.back().surface);
        for (double& v : grains.back().surface.velocity)
            v = random.uniform(-1, 1);
    }
    for (int b = 0; b < 199; ++b) {
        bodies.emplace_back();
        bodies[b].centre = Vec<2>(4e-3 * b + 2e-3, 1e-3);
        bodies[b].mobility = Vec<3>(1e3, 1e3, b % 20 ? 1e8 : 0).asDiagonal();
        bodies[b].twist << random.uniform(-1, 1), random.uniform(-1, 1), 0;
        bodies[b].before = bodies[b].twist;
        for (int grain : { 2 * b, 2 * b + 1, b % 20 ? 2 * b + 2 : (2 * b + 200) % 400 }) {
            surfaces.emplace_back();
            surfaces.back().rigid = &bodies[b];
            problem.bodies.push_back(&surfaces.back());
            for (int point : { random.integer(0, 4), random.integer(5, 9) }) {
                Contact<2> contact {};
                contact.body = grain;
                contact.other = int(problem.bodies.size()) - 1;
                contact.point = point;
                contact.normal = -grains[0].mesh->surface[point].position.normalized();
                contact.drive = contact.impulse = Vec<2>::Zero();
                contact.offset = random.uniform(-1, 0) * contact.normal;
                contact.friction = 0.3;
                contact.law = &law;
                problem.add(contact);
            }
        }
    }
    EXPECT_GT(problem.contacts.size(), 1000u); // two threads' worth
    NonlinearGaussSeidel<2> solver(1e-6, 1000);
    solver.threads = threads;
    EXPECT_LT(solver.solve(problem), 1000);
    EXPECT_LE(problem.residual(), 1e-4);
    std::vector<Vec<2>> all;
    for (const auto& contact : problem.contacts)
        all.push_back(contact.impulse);
    return all;
}

TEST(FreeRigidBody, GivesTheSameForEveryNumberOfThreads)
{
    const auto one = impulses_of_a_row(1);
    for (int threads : { 2, 3 })
        EXPECT_EQ(impulses_of_a_row(threads), one);
}

} // namespace
