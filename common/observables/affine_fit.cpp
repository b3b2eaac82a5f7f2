#include "common/observables/affine_fit.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace softgrain {
namespace {

constexpr double flat = 1e-12;  // smaller / larger principal moment of points on a line

/// Inverse of a symmetric matrix within the directions in which it is not zero.
Mat2 pseudo_inverse(const Mat2& symmetric) {
    Eigen::SelfAdjointEigenSolver<Mat2> solver;
    solver.computeDirect(symmetric);
    const double limit = flat * solver.eigenvalues()[1];
    Mat2 inverse = Mat2::Zero();
    for (int k = 0; k < 2; ++k) {
        const Vec2 axis = solver.eigenvectors().col(k);
        if (solver.eigenvalues()[k] > limit) inverse += axis * axis.transpose() / solver.eigenvalues()[k];
    }
    return inverse;
}

}  // namespace

AffineFit fit_affine(std::span<const Vec2> reference, std::span<const Vec2> position) {
    AffineFit fit;
    const std::size_t n = reference.size();
    if (n == 0) return fit;
    for (std::size_t k = 0; k < n; ++k) {
        fit.reference_middle += reference[k] / static_cast<double>(n);
        fit.middle += position[k] / static_cast<double>(n);
    }
    Mat2 moment = Mat2::Zero(), mixed = Mat2::Zero();
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 arm = reference[k] - fit.reference_middle;
        moment += arm * arm.transpose();
        mixed += (position[k] - fit.middle - arm) * arm.transpose();
    }
    fit.gradient += mixed * pseudo_inverse(moment);
    for (std::size_t k = 0; k < n; ++k)
        fit.residual += fit.non_affine(reference[k], position[k]).squaredNorm() / static_cast<double>(n);
    return fit;
}

}  // namespace softgrain
