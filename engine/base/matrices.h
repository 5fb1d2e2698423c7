/// Functions of dense real matrices whose templates take long to compile: made once, called from everywhere.
#pragma once

#include <Eigen/Core>

namespace portrait {

/// e^A, A square. By scaling, squaring and Pade approximants (Eigen's).
Eigen::MatrixXd exponential(const Eigen::MatrixXd& A);

/// Of a square matrix, in no order.
/// accuracy  backward stable: an eigenvalue of multiplicity m has only one m-th of the digits
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A);

}  // namespace portrait
