// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

#include "solver/contact_problem.hpp"

#include <Eigen/Sparse>

namespace softgrain {

/// A contact problem as a matrix and vectors, the form of Siconos and FCLIB (Acary et al. 2014): u = W r + q with
/// 0 <= r_n perp u_n >= 0 and Coulomb's friction. Vectors have Dim entries a contact: along its normal, then along its
/// tangents.
template <int Dim> struct MatrixForm {
    Eigen::SparseMatrix<double, Eigen::RowMajor> W; ///< Delassus operator [1/kg]
    Eigen::VectorXd q;  ///< relative velocities without impulses, less the drive, with gap / dt along the normal [m/s]
    Eigen::VectorXd mu; ///< coefficients of friction, one a contact
    Eigen::VectorXd r;  ///< impulses on the point side [N s]
    Eigen::VectorXd u;  ///< as q, with impulses: the velocities of the surfaces [m/s]
};

/// Of a problem that a solver has solved.
template <int Dim> MatrixForm<Dim> matrix_form(const ContactProblem<Dim>& problem);

extern template MatrixForm<2> matrix_form<2>(const ContactProblem<2>&);

} // namespace softgrain
