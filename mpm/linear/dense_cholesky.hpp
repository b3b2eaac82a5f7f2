#pragma once
// Cholesky's method for the dense matrices of fronts, by Eigen.
#include <Eigen/Core>

namespace softgrain::mpm {

using Strided = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

/// Factors [rows x columns], columns <= rows, in place: its lower triangle and what is below. False if it is
/// not positive definite.
bool factor_columns(Strided A);

/// Columns [first, last) of the lower triangle of -A A^T.
void find_lower_product(const Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>& A, Strided C,
                        Eigen::Index first, Eigen::Index last);

}  // namespace softgrain::mpm
