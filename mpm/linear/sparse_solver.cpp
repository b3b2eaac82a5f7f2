#include "mpm/linear/sparse_solver.hpp"

namespace softgrain::mpm {

Eigen::SparseMatrix<double> assemble(const Grains& grains, const Stiffness& K) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](int m, int n, const Mat2& block) {
        for (int a = 0; a < 2; ++a)
            for (int b = 0; b < 2; ++b)
                if (2 * m + a >= 2 * n + b) entries.emplace_back(2 * m + a, 2 * n + b, block(a, b));
    };
    const StiffnessPattern& pattern = *grains.pattern;
    const auto nodes = static_cast<int>(grains.nodes());
    for (std::size_t g = 0; g < grains.size(); ++g) {
        const int first = static_cast<int>(g) * nodes;
        const Mat2* block = K.grain.data() + g * pattern.size();
        for (int m = 0; m < nodes; ++m)
            for (int k = pattern.start[static_cast<std::size_t>(m)];
                 k < pattern.start[static_cast<std::size_t>(m) + 1]; ++k)
                add(first + m, first + pattern.column[static_cast<std::size_t>(k)], block[k]);
    }
    std::vector<double> shift(grains.all_nodes(), K.shift);
    for (const ContactStiffness& c : K.contact)
        for (const int node : c.node) shift[static_cast<std::size_t>(node)] = K.shift + K.contact_shift;
    for (const ContactStiffness& c : K.contact)
        for (std::size_t a = 0; a < c.node.size(); ++a)
            for (std::size_t b = 0; b <= a; ++b)
                add(c.node[a], c.node[b],
                    c.matrix.block<2, 2>(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b)));
    const auto size = static_cast<Eigen::Index>(2 * grains.all_nodes());
    for (int d = 0; d < size; ++d) entries.emplace_back(d, d, shift[static_cast<std::size_t>(d / 2)]);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
}

bool SparseSolver::factor_contacts(const Stiffness& K) {
    matrix_ = assemble(grains_, K);
    cholesky_.compute(matrix_);
    return cholesky_.info() == Eigen::Success;
}

void SparseSolver::solve_contacts(std::span<const Vec2> c, std::span<Vec2> x) {
    for (std::size_t m = 0; m < x.size(); ++m) x[m] = given_[m] + c[m];
    Eigen::Map<Eigen::VectorXd> all(x.front().data(), static_cast<Eigen::Index>(2 * x.size()));
    all = cholesky_.solve(all).eval();
}

}  // namespace softgrain::mpm
