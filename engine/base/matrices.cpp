#include "engine/base/matrices.h"

#include <Eigen/Dense>
#include <unsupported/Eigen/MatrixFunctions>

namespace portrait {

Eigen::MatrixXd exponential(const Eigen::MatrixXd& A) { return A.exp(); }

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) { return A.eigenvalues(); }

}  // namespace portrait
