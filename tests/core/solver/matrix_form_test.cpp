// SPDX-License-Identifier: GPL-2.0-or-later
#include "random_problem.hpp"

#include "solver/matrix_form.hpp"

#include <gtest/gtest.h>

using namespace softgrain;
using namespace softgrain::testing_support;

namespace {

/// Vectors of all contacts, [contact][axis], along each contact's normal and the tangent to its left.
Eigen::VectorXd in_frames(const std::vector<Contact<2>>& contacts, const Eigen::MatrixXd& vectors)
{
    Eigen::VectorXd local(2 * contacts.size());
    for (size_t c = 0; c < contacts.size(); ++c) {
        const Vec<2> n = contacts[c].normal, v = vectors.row(c).transpose();
        local.segment<2>(2 * c) = Vec<2>(v.dot(n), v.dot(Vec<2>(-n.y(), n.x())));
    }
    return local;
}

TEST(MatrixForm, IsThatOfTheDenseOperators)
{
    Random random(1);
    for (int trial = 0; trial < 20; ++trial) {
        RandomProblem p(random, random.integer(1, 9), 0.3);
        NonlinearGaussSeidel<2>().solve(p.problem);
        const auto form = matrix_form(p.problem);
        const auto& contacts = p.problem.contacts;
        const Eigen::MatrixXd W = p.delassus(), q = p.free_approach(), r = p.impulses();
        const int n = int(contacts.size());
        ASSERT_EQ(form.W.rows(), 2 * n);
        ASSERT_EQ(form.W.cols(), 2 * n);
        EXPECT_LE((form.q - in_frames(contacts, q)).norm(), 1e-14 * q.norm());
        EXPECT_LE((form.r - in_frames(contacts, r)).norm(), 1e-15 * r.norm());
        EXPECT_LE((form.W * form.r + form.q - in_frames(contacts, W * r + q)).norm(), 1e-13 * q.norm());
        EXPECT_LE((form.u - form.W * form.r - form.q).norm(), 1e-13 * q.norm()); // the surfaces move as the impulses ask
        EXPECT_EQ(form.mu, Eigen::VectorXd::Constant(n, 0.3));
        for (int column = 0; column < 2 * n; ++column) { // entry by entry: what an impulse along one axis does
            Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(n, 2);
            const Vec<2> normal = contacts[column / 2].normal;
            unit.row(column / 2) << (column % 2 == 0 ? normal : Vec<2>(-normal.y(), normal.x())).transpose();
            EXPECT_LE((form.W.col(column).toDense() - in_frames(contacts, W * unit)).norm(), 1e-13 * W.norm());
        }
    }
}

TEST(MatrixForm, OfNoContactsIsEmpty)
{
    Random random(2);
    RandomProblem p(random, 0, 0);
    const auto form = matrix_form(p.problem);
    EXPECT_EQ(form.W.rows(), 0);
    EXPECT_EQ(form.q.size(), 0);
}

} // namespace
