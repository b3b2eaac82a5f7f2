#pragma once
// The fast linear solver: dense elimination of grains, then of contacts, in fronts.
#include <vector>

#include <Eigen/Core>

#include "mpm/linear/elimination.hpp"
#include "mpm/linear/linear_solver.hpp"

namespace softgrain::mpm {

/// Multifrontal Cholesky (Duff and Reid 1983) that knows its matrix: nodes that no contact touches are
/// eliminated grain by grain, what is left of grains and contacts are dense elements that fronts sum and
/// reduce one after the other. The same bits for any number of threads: a front is one thread's, and sums are
/// in list order.
class FrontSolver final : public LinearSolver {
  public:
    explicit FrontSolver(const Grains& grains) : grains_(grains) {}
    bool factor_grains(const Stiffness& K) override;
    bool factor_contacts(const Stiffness& K) override;
    void begin(std::span<const Vec2> b) override;
    void solve_contacts(std::span<const Vec2> c, std::span<Vec2> x) override;
    void finish(std::span<Vec2> x) override;

    /// Floating-point operations of the last factorization, without those of sums.
    double operations() const { return operations_; }

  private:
    /// Factored columns of some nodes, and the dense element that is left.
    struct Front {
        std::vector<int> pivots, rest;  ///< ascending
        std::vector<int> elements;      ///< summed here
        Eigen::MatrixXd columns;        ///< of the pivots [2 (pivots + rest) x 2 pivots]
        Eigen::MatrixXd left;           ///< what they leave of the rest; lower triangle

        void clear();
        /// Adds the lower triangle of a matrix on some of the nodes.
        void add(const Eigen::MatrixXd& from, const std::vector<int>& nodes);
        /// False if the pivots are not positive definite.
        bool reduce();
        void forward(std::span<Vec2> x) const;
        void backward(std::span<Vec2> x) const;
    };
    /// Nodes without contact of a grain, and what they leave to the others.
    struct GrainFronts {
        std::vector<Front> front;  ///< nodes of the grain; the last without pivots: what is left
        std::vector<int> touched;  ///< of all nodes
    };
    struct Element {
        const std::vector<int>& nodes;
        const Eigen::MatrixXd& matrix;
    };

    void plan(const Stiffness& K);
    void plan_grain(std::size_t g, std::span<const char> touched);
    void plan_contacts(const Stiffness& K);
    bool factor_grain(const Stiffness& K, std::size_t g);
    bool factor_front(const Stiffness& K, std::size_t f);
    Element element(const Stiffness& K, int number) const;

    const Grains& grains_;
    std::vector<std::vector<int>> planned_for_;  ///< nodes of the elements that the plan is for
    std::vector<GrainFronts> grain_;
    std::vector<Front> front_;
    std::vector<int> level_start_;  ///< fronts of a level need only fronts of levels before
    std::vector<int> by_level_;
    std::vector<Vec2> begun_;  ///< right side after the grains' own elimination
    double operations_ = 0.0;
};

}  // namespace softgrain::mpm
