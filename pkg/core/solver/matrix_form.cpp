// SPDX-License-Identifier: GPL-2.0-or-later
#include "solver/matrix_form.hpp"

#include <map>

namespace softgrain {
namespace {

    using Triplets = std::vector<Eigen::Triplet<double>>;
    using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

    Sparse assembled(Eigen::Index rows, Eigen::Index columns, const Triplets& entries)
    {
        Sparse matrix(rows, columns);
        matrix.setFromTriplets(entries.begin(), entries.end());
        return matrix;
    }

    /// Rows: the normal, then the tangents, right-handed.
    template <int Dim> Mat<Dim> frame(const Vec<Dim>& normal)
    {
        Mat<Dim> axes;
        axes.row(0) = normal;
        axes.row(1) = normal.unitOrthogonal();
        if constexpr (Dim == 3) axes.row(2) = normal.cross(Vec<Dim>(axes.row(1)));
        return axes;
    }

} // namespace

// W = H D H^T + G M G^T: H from the velocities of surface points to relative velocities, D the Delassus operators of the
// surfaces, G from the twists of rigid bodies, M their mobilities.
template <int Dim> MatrixForm<Dim> matrix_form(const ContactProblem<Dim>& problem)
{
    const int contacts = int(problem.contacts.size());
    std::vector<int> first; // of a body's points among all
    Triplets operators, shares;
    int points = 0;
    for (const Surface<Dim>* body : problem.bodies) {
        first.push_back(points);
        for (int p = 0; body->mobility > 0 && p < body->count; ++p)
            for (int j = body->response->delassus_row[p]; j < body->response->delassus_row[p + 1]; ++j)
                operators.emplace_back(points + p, points + body->response->delassus_column[j],
                                       body->mobility * body->response->delassus_value[j]);
        points += body->count;
    }
    MatrixForm<Dim> form;
    form.mu.resize(contacts);
    for (Eigen::VectorXd* vector : { &form.q, &form.r, &form.u })
        vector->resize(Dim * contacts);
    std::vector<Mat<Dim>> frames;
    using Lever = Eigen::Matrix<double, Dim, RigidBody<Dim>::twists>;
    std::map<const RigidBody<Dim>*, std::map<int, Lever>> levers; // of each contact, in its frame
    for (int c = 0; c < contacts; ++c) {
        const Contact<Dim>& contact = problem.contacts[c];
        shares.emplace_back(c, first[contact.body] + contact.point, 1);
        for (int k = 0; contact.other >= 0 && k < face_vertices<Dim>; ++k)
            shares.emplace_back(c, first[contact.other] + contact.vertex[k], -contact.weight[k]);
        frames.push_back(frame<Dim>(contact.normal));
        const auto add_lever = [&](const Surface<Dim>& body, int p, double share) {
            if (!body.rigid) return;
            const auto lever = levers[body.rigid].try_emplace(c, Lever::Zero()).first;
            lever->second += share * frames[c] * body.rigid->lever(body.x(p));
        };
        add_lever(*problem.bodies[contact.body], contact.point, 1);
        for (int k = 0; contact.other >= 0 && k < face_vertices<Dim>; ++k)
            add_lever(*problem.bodies[contact.other], contact.vertex[k], -contact.weight[k]);
        const Vec<Dim> u = problem.relative(contact, &Surface<Dim>::velocity) + contact.offset;
        form.q.template segment<Dim>(Dim * c) = frames[c] * contact.free;
        form.r.template segment<Dim>(Dim * c) = frames[c] * contact.impulse;
        form.u.template segment<Dim>(Dim * c) = frames[c] * u;
        form.mu[c] = contact.friction;
    }
    const Sparse H = assembled(contacts, points, shares), D = assembled(points, points, operators);
    const Sparse isotropic = H * D * Sparse(H.transpose());
    Triplets entries;
    for (int row = 0; row < contacts; ++row)
        for (Sparse::InnerIterator entry(isotropic, row); entry; ++entry) {
            const Mat<Dim> block = entry.value() * frames[row] * frames[entry.col()].transpose();
            for (int i = 0; i < Dim; ++i)
                for (int j = 0; j < Dim; ++j)
                    entries.emplace_back(Dim * row + i, Dim * int(entry.col()) + j, block(i, j));
        }
    for (const auto& [body, of_contact] : levers)
        for (const auto& [row, left] : of_contact)
            for (const auto& [column, right] : of_contact) {
                const Mat<Dim> block = left * body->mobility * right.transpose();
                for (int i = 0; i < Dim; ++i)
                    for (int j = 0; j < Dim; ++j)
                        entries.emplace_back(Dim * row + i, Dim * column + j, block(i, j));
            }
    form.W = assembled(Dim * contacts, Dim * contacts, entries);
    return form;
}

template MatrixForm<2> matrix_form<2>(const ContactProblem<2>&);

} // namespace softgrain
