#include "mpm/linear/dense_cholesky.hpp"

#include <Eigen/Cholesky>

namespace softgrain::mpm {

bool factor_columns(Strided A) {
    auto top = A.topRows(A.cols());
    if (Eigen::internal::llt_inplace<double, Eigen::Lower>::blocked(top) >= 0) return false;
    auto below = A.bottomRows(A.rows() - A.cols());
    if (below.rows() > 0)
        top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    return true;
}

void find_lower_product(const Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>& A, Strided C,
                        Eigen::Index first, Eigen::Index last) {
    const Eigen::Index count = last - first, below = A.rows() - last;
    const auto own = A.middleRows(first, count);
    C.block(first, first, count, count).triangularView<Eigen::Lower>() = -1.0 * own * own.transpose();
    if (below > 0)
        C.block(last, first, below, count).noalias() = -1.0 * A.bottomRows(below) * own.transpose();
}

}  // namespace softgrain::mpm
