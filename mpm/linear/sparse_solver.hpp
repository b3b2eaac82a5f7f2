#pragma once
// The plain linear solver: one sparse matrix, Eigen's Cholesky. The fast one is tested against it.
#include <Eigen/SparseCholesky>

#include "mpm/linear/linear_solver.hpp"

namespace softgrain::mpm {

class SparseSolver final : public LinearSolver {
  public:
    explicit SparseSolver(const Grains& grains) : grains_(grains) {}
    bool factor_grains(const Stiffness&) override { return true; }
    bool factor_contacts(const Stiffness& K) override;
    void begin(std::span<const Vec2> b) override { given_.assign(b.begin(), b.end()); }
    void solve_contacts(std::span<const Vec2> c, std::span<Vec2> x) override;
    void finish(std::span<Vec2>) override {}

  private:
    const Grains& grains_;
    std::vector<Vec2> given_;
    Eigen::SparseMatrix<double> matrix_;
    Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky_;
};

/// The lower triangle of K.
Eigen::SparseMatrix<double> assemble(const Grains& grains, const Stiffness& K);

}  // namespace softgrain::mpm
