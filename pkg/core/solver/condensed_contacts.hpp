// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/barrier_contact.hpp"

#include <Eigen/Sparse>

namespace softgrain {

/// The linear system of an interior-point iteration, condensed to the contacts,
///     (W + D) r = b,    W = H C H^T,
/// C the compliances of the surfaces (how all points of a body move under a force on one of them, everything inside
/// eliminated), H from surface points to relative ways along normals and, where there is friction, tangents, D > 0 diagonal.
/// Sparse Cholesky; the symbolic analysis is kept while the same bodies meet at the same number of points.
template <int Dim> class CondensedContacts {
public:
    /// Rows of the contacts among the unknowns, and who couples with whom.
    void analyse(const std::vector<BarrierContact<Dim>>& contacts, int bodies);
    /// W from compliances [point][point][Dim][Dim] [m/N] of each body, null for what does not move; `points` of each.
    /// Writes the compliance of each contact along its normal.
    void assemble(std::vector<BarrierContact<Dim>>& contacts, const std::vector<const double*>& compliance,
                  const std::vector<int>& points);
    /// False when the matrix is not positive definite.
    bool factorise(const Eigen::VectorXd& diagonal);
    Eigen::VectorXd solve(const Eigen::VectorXd& b) const { return solver_.solve(b); }

    int rows() const { return rows_; }
    int row(int contact) const { return row_[size_t(contact)]; }

private:
    struct Side {
        int contact;
        bool of_point; ///< the point is on this body, not the face
    };
    int rows_ = 0;
    std::vector<int> row_;
    std::vector<std::vector<Side>> sides_; ///< [body]
    Eigen::SparseMatrix<double> matrix_;   ///< lower triangle
    std::vector<int> place_;               ///< of every entry that assemble() adds, in its order
    std::vector<int> diagonal_place_;
    std::vector<double> W_; ///< values of the matrix without D
    std::vector<int> analysed_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
};

extern template class CondensedContacts<2>;

} // namespace softgrain
