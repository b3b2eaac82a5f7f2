#pragma once
// K + G D G^T from the factor of K, for few columns of G (Woodbury's formula).
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mpm/contact/contact_model.hpp"
#include "mpm/linear/front.hpp"

namespace softgrain::mpm {

/// With V = L^-1 G and C = D^-1 + V^T V: (K + G D G^T)^-1 = L^-T (1 - V C^-1 V^T) L^-1. D has both signs; the
/// sum is positive definite if C has as many negative eigenvalues as D.
class LowRank {
  public:
    void clear() { rows_.clear(); }
    /// Each spring is on nodes of one front. False if the sum is not positive definite.
    bool set(std::span<const ContactSpring> added, const FrontTree& tree);
    /// From L^-1 b to that with which the backward substitution of K gives the solution.
    void correct(const FrontTree& tree, std::span<Vec2> x) const;

  private:
    /// Of V, by the pivots of a front.
    struct Rows {
        std::vector<int> column;  ///< that are not zero here, ascending
        Eigen::MatrixXd pivot;    ///< [2 pivots x columns]
        Eigen::MatrixXd rest;     ///< what goes on to the parent
    };
    void solve_front(std::size_t f, std::span<const int> begin_here, std::span<const int> children,
                     std::span<const ContactSpring* const> spring, const FrontTree& tree);
    bool factor(std::span<const ContactSpring* const> spring, Eigen::Index positive);

    std::vector<Rows> rows_;                     ///< [fronts]
    Eigen::MatrixXd first_, coupling_, second_;  ///< factor of C, positive springs first
};

}  // namespace softgrain::mpm
