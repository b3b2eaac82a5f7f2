#pragma once
// The fast linear solver: dense elimination of grains, then of contacts, in fronts.
#include <atomic>
#include <vector>

#include "mpm/linear/elimination.hpp"
#include "mpm/linear/front.hpp"
#include "mpm/linear/linear_solver.hpp"
#include "mpm/linear/low_rank.hpp"

namespace softgrain::mpm {

/// Multifrontal Cholesky (Duff and Reid 1983) that knows its matrix: nodes that no contact touches are
/// eliminated grain by grain, what is left of grains and contacts are dense elements that fronts sum and
/// reduce one after the other. Few springs of contacts that change are a correction of low rank. The same
/// bits for any number of threads: every number is one thread's, and sums are in list order.
class FrontSolver final : public LinearSolver {
  public:
    explicit FrontSolver(const Grains& grains) : grains_(grains) {}
    bool factor_grains(const Stiffness& K) override;
    bool factor_contacts(const Stiffness& K) override;
    bool change_contacts(std::span<const ContactSpring> added) override;
    void begin(std::span<const Vec2> b) override;
    void solve_contacts(std::span<const Vec2> c, std::span<Vec2> x) override;
    void finish(std::span<Vec2> x) override;

    /// Floating-point operations of the last factorization, without those of sums.
    double operations() const { return grain_operations_ + contact_operations_; }

  private:
    /// Nodes without contact of a grain, and what they leave to the others.
    struct GrainFronts {
        std::vector<Front> front;            ///< nodes of the grain; the last without pivots: what is left
        std::vector<std::vector<Run>> runs;  ///< [fronts] places of the rest in the front that sums it
        std::vector<int> touched;            ///< of all nodes, as they are eliminated
    };

    void plan(const Stiffness& K);
    void plan_contacts(const Stiffness& K);
    void plan_grain(std::size_t g);
    bool factor_grain(const Stiffness& K, std::size_t g);
    void factor_front(const Stiffness& K, std::size_t f);
    void factor_subtree(const Stiffness& K, std::size_t f);

    const Grains& grains_;
    std::vector<std::vector<int>> planned_for_;  ///< nodes of the elements that the plan is for
    std::vector<GrainFronts> grain_;
    FrontTree tree_;                               ///< elements: of grains, of contacts, of fronts
    std::vector<std::vector<Run>> grain_runs_;     ///< [grains] places of what is left
    std::vector<std::vector<int>> contact_place_;  ///< [contacts] places of their nodes
    std::vector<double> subtree_operations_;       ///< [fronts]
    std::atomic<bool> positive_ = true;
    LowRank change_;
    std::vector<Vec2> begun_;  ///< right side after the grains' own elimination
    double grain_operations_ = 0.0, contact_operations_ = 0.0, contact_numbers_ = 0.0;
};

}  // namespace softgrain::mpm
