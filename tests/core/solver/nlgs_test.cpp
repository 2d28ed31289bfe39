// SPDX-License-Identifier: GPL-2.0-or-later
#include "random_problem.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

NonlinearGaussSeidel<2> tight { 1e-12, 100000 }; // a little above round-off

// One contact: r_n = max(0, -q_n / W), and Coulomb's cut of the impulse that stops sliding.
TEST(NonlinearGaussSeidel, SolvesASingleContactInClosedForm)
{
    Random random(1);
    int open = 0, slides = 0;
    for (int trial = 0; trial < 200; ++trial) {
        RandomProblem p(random, 1, random.uniform(0, 1));
        Contact<2>& contact = p.problem.contacts[0];
        const double W = p.delassus()(0, 0);
        const Vec<2> q = p.free_approach().row(0).transpose(), n = contact.normal, t(-n.y(), n.x());
        const double rn = std::max(0.0, -q.dot(n) / W), most = contact.friction * rn;
        const double rt = std::clamp(-q.dot(t) / W, -most, most);
        EXPECT_LE(NonlinearGaussSeidel<2>().solve(p.problem), 2) << "the second only to see that nothing changes";
        EXPECT_LE((contact.impulse - rn * n - rt * t).norm(), 1e-13 * q.norm() / W);
        EXPECT_NEAR(contact.inertia * W, 1, 1e-12);
        open += rn == 0;
        slides += rn > 0 && std::abs(rt) == most;
    }
    EXPECT_GT(open, 20);
    EXPECT_GT(slides, 20);
}

TEST(NonlinearGaussSeidel, LeavesVelocitiesThatMatchItsImpulses)
{
    Random random(2);
    for (int trial = 0; trial < 30; ++trial) {
        RandomProblem p(random, random.integer(1, 9), 0.3);
        const int sweeps = tight.solve(p.problem);
        const auto expected = p.velocities();
        for (size_t b = 0; b < expected.size(); ++b)
            for (size_t i = 0; i < expected[b].size(); ++i)
                ASSERT_NEAR(p.problem.bodies[b]->velocity[i], expected[b][i], 1e-15 * (10 + sweeps)); // sums of the sweeps
    }
}

TEST(NonlinearGaussSeidel, LeavesNoResidual)
{
    Random random(3);
    for (double friction : { 0.0, 0.1, 0.3, 0.6 })
        for (int trial = 0; trial < 20; ++trial) {
            RandomProblem p(random, random.integer(1, 9), friction);
            const int sweeps = tight.solve(p.problem);
            EXPECT_LT(sweeps, tight.max_sweeps);
            EXPECT_LE(p.problem.residual(), 1e-11) << friction << " " << p.problem.contacts.size();
        }
}

// When sweeps contract the error by a factor rho, a change by the tolerance leaves an error of rho / (1 - rho) times the
// tolerance: of its order for most problems (the geometric mean), never with a change of order.
TEST(NonlinearGaussSeidel, ResidualFollowsTheTolerance)
{
    Random random(4);
    for (double tolerance : { 1e-2, 1e-4, 1e-6, 1e-8 }) {
        double sum = 0;
        int sweeps = 0;
        for (int trial = 0; trial < 60; ++trial) {
            RandomProblem p(random, 0, 0);
            p.press(random, 8, 0.2);
            sweeps += NonlinearGaussSeidel<2> { tolerance, 10000 }.solve(p.problem);
            sum += std::log(std::max(p.problem.residual(), 1e-16));
        }
        const double mean = std::exp(sum / 60);
        EXPECT_LE(mean, 2 * tolerance);
        EXPECT_GE(mean, 0.003 * tolerance);
        std::printf("tolerance %.0e: mean residual %.1e, %.1f sweeps (60 problems of 8 contacts)\n", tolerance, mean,
                    sweeps / 60.0);
    }
}

TEST(NonlinearGaussSeidel, StartsFromTheGivenImpulses)
{
    Random random(5);
    for (int trial = 0; trial < 20; ++trial) {
        RandomProblem p(random, 0, 0);
        p.press(random, 8, 0.2);
        const int cold = tight.solve(p.problem);
        const Eigen::MatrixXd solution = p.impulses();
        p.reset(false); // free velocities, but the solution's impulses
        const int warm = tight.solve(p.problem);
        EXPECT_GT(cold, warm);
        EXPECT_LE(warm, 3);
        EXPECT_LE((p.impulses() - solution).norm(), 1e-12 * solution.norm());
        const auto expected = p.velocities();
        for (size_t i = 0; i < expected[0].size(); ++i)
            ASSERT_NEAR(p.problem.bodies[0]->velocity[i], expected[0][i], 1e-15 * (10 + cold));
    }
}

TEST(NonlinearGaussSeidel, StopsAtTheSweepsAllowed)
{
    Random random(6);
    RandomProblem p(random, 0, 0);
    p.press(random, 8, 0.3);
    EXPECT_EQ((NonlinearGaussSeidel<2> { 1e-12, 3 }.solve(p.problem)), 3);
    const auto expected = p.velocities(); // consistent all the same
    for (size_t i = 0; i < expected[0].size(); ++i)
        EXPECT_NEAR(p.problem.bodies[0]->velocity[i], expected[0][i], 1e-14);
}

TEST(NonlinearGaussSeidel, HasNothingToDoWithoutContacts)
{
    Random random(7);
    RandomProblem p(random, 0, 0);
    EXPECT_EQ(tight.solve(p.problem), 0);
    EXPECT_EQ(p.problem.residual(), 0);
    for (size_t b = 0; b < p.free_velocity.size(); ++b)
        EXPECT_EQ(p.problem.bodies[b]->velocity, p.free_velocity[b]);
}

/// Frictionless: the one set A of closed contacts with r_A = -W_AA^-1 q_A >= 0 and u >= 0 elsewhere, by trying all.
Eigen::VectorXd by_enumeration(const Eigen::MatrixXd& W, const Eigen::VectorXd& q)
{
    const int n = int(q.size());
    for (int set = 0; set < 1 << n; ++set) {
        std::vector<int> closed;
        for (int c = 0; c < n; ++c)
            if (set >> c & 1) closed.push_back(c);
        Eigen::VectorXd r = Eigen::VectorXd::Zero(n);
        if (!closed.empty()) {
            const Eigen::MatrixXd A = W(closed, closed);
            const Eigen::VectorXd b = q(closed), x = A.ldlt().solve(-b);
            for (size_t k = 0; k < closed.size(); ++k)
                r[closed[k]] = x[k];
        }
        const Eigen::VectorXd u = W * r + q;
        if (r.minCoeff() >= -1e-14 * r.norm() && u.minCoeff() >= -1e-12 * q.norm()) return r;
    }
    throw std::logic_error("no set of closed contacts fits");
}

TEST(NonlinearGaussSeidel, AgreesWithTryingAllActiveSetsWithoutFriction)
{
    Random random(8);
    int mixed = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const int n = random.integer(2, 9);
        RandomProblem p(random, n, 0);
        Eigen::MatrixXd W = p.delassus();
        Eigen::VectorXd q(n);
        for (int i = 0; i < n; ++i) {
            q[i] = p.free_approach().row(i) * p.problem.contacts[i].normal;
            for (int j = 0; j < n; ++j)
                W(i, j) *= p.problem.contacts[i].normal.dot(p.problem.contacts[j].normal);
        }
        const Eigen::VectorXd expected = by_enumeration(W, q);
        tight.solve(p.problem);
        const Eigen::MatrixXd r = p.impulses();
        for (int i = 0; i < n; ++i)
            EXPECT_LE((r.row(i).transpose() - expected[i] * p.problem.contacts[i].normal).norm(), 1e-10 * expected.norm());
        mixed += expected.minCoeff() == 0 && expected.maxCoeff() > 0;
    }
    EXPECT_GT(mixed, 20);
}

/// With friction in the plane: every contact is open, sticks, or slides to one of two sides. All combinations that
/// fulfil the law are solutions (for small friction there is one).
std::vector<Eigen::VectorXd> by_enumeration(const Eigen::MatrixXd& W, const Eigen::MatrixXd& q,
                                            const std::vector<Contact<2>>& contacts)
{
    const int n = int(q.rows());
    const double small = 1e-10 * q.norm();
    std::vector<Eigen::VectorXd> solutions;
    for (int code = 0; code < 1 << (2 * n); ++code) {
        // unknowns (r_n, r_t) per contact; rows: what the state asks for
        Eigen::MatrixXd A = Eigen::MatrixXd::Zero(2 * n, 2 * n), T(2 * n, 2 * n); // T: velocities from (r_n, r_t)
        Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * n), free(2 * n);
        for (int i = 0; i < n; ++i) {
            const Vec<2> ni = contacts[i].normal, ti(-ni.y(), ni.x());
            free[2 * i] = q.row(i) * ni;
            free[2 * i + 1] = q.row(i) * ti;
            for (int j = 0; j < n; ++j) {
                const Vec<2> nj = contacts[j].normal, tj(-nj.y(), nj.x());
                T.block<2, 2>(2 * i, 2 * j) << ni.dot(nj), ni.dot(tj), ti.dot(nj), ti.dot(tj);
                T.block<2, 2>(2 * i, 2 * j) *= W(i, j);
            }
        }
        for (int i = 0; i < n; ++i) {
            const int state = code >> (2 * i) & 3; // open, stick, slide to either side
            for (int row = 2 * i; row < 2 * i + 2; ++row)
                if (state == 0)
                    A(row, row) = 1;
                else {
                    A.row(row) = T.row(row);
                    b[row] = -free[row];
                }
            if (state < 2) continue;
            A.row(2 * i + 1).setZero();
            A(2 * i + 1, 2 * i + 1) = 1;
            A(2 * i + 1, 2 * i) = (state == 2 ? 1 : -1) * contacts[i].friction;
            b[2 * i + 1] = 0;
        }
        const Eigen::VectorXd r = A.fullPivLu().solve(b), u = T * r + free;
        bool fits = (A * r - b).norm() <= 1e-9 * (1e-12 + b.norm());
        for (int i = 0; i < n && fits; ++i) {
            const double rn = r[2 * i], rt = r[2 * i + 1], un = u[2 * i], ut = u[2 * i + 1];
            const double none = small / W(i, i), most = contacts[i].friction * rn;
            fits = rn >= -none && un >= -small && std::abs(rt) <= most + none && std::abs(rn * un) <= none * small * 1e6
                && rt * ut <= none * small * 1e6 && (std::abs(ut) <= small || std::abs(rt) >= most - none);
        }
        if (fits) solutions.push_back(r);
    }
    return solutions;
}

TEST(NonlinearGaussSeidel, AgreesWithTryingAllStatesWithFriction)
{
    Random random(9);
    for (int trial = 0; trial < 25; ++trial) {
        const int n = random.integer(2, 4);
        RandomProblem p(random, n, random.uniform(0.05, 0.5));
        const auto solutions = by_enumeration(p.delassus(), p.free_approach(), p.problem.contacts);
        ASSERT_FALSE(solutions.empty());
        tight.solve(p.problem);
        Eigen::VectorXd found(2 * n);
        for (int i = 0; i < n; ++i) {
            const Vec<2> normal = p.problem.contacts[i].normal, r = p.problem.contacts[i].impulse;
            found[2 * i] = r.dot(normal);
            found[2 * i + 1] = r.dot(Vec<2>(-normal.y(), normal.x()));
        }
        double nearest = 1e300, size = 0;
        for (const auto& solution : solutions) {
            nearest = std::min(nearest, (solution - found).norm());
            size = std::max(size, solution.norm());
        }
        EXPECT_LE(nearest, 1e-9 * size + 1e-20) << "trial " << trial << ", solutions " << solutions.size();
    }
}

/// Holds whatever touches: closes the gap in a step and lets nothing slide.
class Glue final : public ContactLaw<2> {
public:
    Vec<2> reaction(const LocalContact<2>& contact) const override { return contact.trial; }
};

TEST(NonlinearGaussSeidel, TakesAnotherLaw)
{
    Random random(10);
    const Glue glue;
    for (int trial = 0; trial < 10; ++trial) {
        RandomProblem p(random, 6, 0);
        for (auto& contact : p.problem.contacts)
            contact.law = &glue;
        const Eigen::MatrixXd expected = p.delassus().ldlt().solve(-p.free_approach());
        tight.solve(p.problem);
        EXPECT_LE((p.impulses() - expected).norm(), 1e-10 * expected.norm());
    }
}

} // namespace
