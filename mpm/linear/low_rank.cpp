#include "mpm/linear/low_rank.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

Eigen::Index index(std::size_t k) {
    return static_cast<Eigen::Index>(k);
}

/// Takes the lower triangle to its factor.
bool factor_lower(Eigen::MatrixXd& A) {
    return Eigen::internal::llt_inplace<double, Eigen::Lower>::blocked(A) < 0;
}

}  // namespace

bool LowRank::set(std::span<const ContactSpring> added, const FrontTree& tree) {
    std::vector<const ContactSpring*> spring;
    for (const ContactSpring& s : added) spring.push_back(&s);
    const auto split =
        std::stable_partition(spring.begin(), spring.end(), [](const auto* s) { return s->stiffness > 0.0; });
    const std::size_t fronts = tree.front.size();
    rows_.assign(fronts, {});
    std::vector<std::vector<int>> begin_here(fronts), children(fronts);
    for (std::size_t k = 0; k < spring.size(); ++k) {
        const auto& nodes = spring[k]->node;
        const int first = *std::min_element(
            nodes.begin(), nodes.end(), [&](int a, int b) { return tree.rank[at(a)] < tree.rank[at(b)]; });
        begin_here[at(tree.front_of[at(first)])].push_back(static_cast<int>(k));
    }
    first_.setZero(index(spring.size()), index(spring.size()));
    for (std::size_t f = 0; f < fronts; ++f) {
        solve_front(f, begin_here[f], children[f], spring, tree);
        for (const int child : children[f]) rows_[at(child)].rest.resize(0, 0);
        if (!rows_[f].column.empty() && tree.parent[f] >= 0)
            children[at(tree.parent[f])].push_back(static_cast<int>(f));
    }
    return factor(spring, split - spring.begin());
}

/// Forward substitution of the columns that begin here or come from the children.
void LowRank::solve_front(std::size_t f, std::span<const int> begin_here, std::span<const int> children,
                          std::span<const ContactSpring* const> spring, const FrontTree& tree) {
    const Front& front = tree.front[f];
    Rows& rows = rows_[f];
    rows.column.assign(begin_here.begin(), begin_here.end());
    for (const int child : children) {
        const auto& more = rows_[at(child)].column;
        rows.column.insert(rows.column.end(), more.begin(), more.end());
    }
    std::sort(rows.column.begin(), rows.column.end());
    if (rows.column.empty()) return;
    const Eigen::Index p = 2 * index(front.pivots.size()), r = 2 * index(front.rest.size()),
                       columns = index(rows.column.size());
    const auto place_of = [&](int k) {
        return std::lower_bound(rows.column.begin(), rows.column.end(), k) - rows.column.begin();
    };
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(p + r, columns);
    for (const int k : begin_here) {
        const ContactSpring& s = *spring[at(k)];
        const std::vector<int> place = tree.places(s.node, front);
        for (std::size_t a = 0; a < place.size(); ++a)
            whole.block<2, 1>(2 * place[a], place_of(k)) += s.by[a];
    }
    for (const int child : children) {
        const Rows& from = rows_[at(child)];
        for (std::size_t k = 0; k < from.column.size(); ++k)
            for (const Run& run : tree.runs[at(child)])
                whole.col(place_of(from.column[k])).segment(2 * run.to, 2 * run.count) +=
                    from.rest.col(index(k)).segment(2 * run.from, 2 * run.count);
    }
    rows.pivot = whole.topRows(p);
    front.diagonal().triangularView<Eigen::Lower>().solveInPlace(rows.pivot);
    rows.rest = whole.bottomRows(r);
    rows.rest.noalias() -= front.below() * rows.pivot;
    const Eigen::MatrixXd square = rows.pivot.transpose() * rows.pivot;
    for (Eigen::Index b = 0; b < columns; ++b)
        for (Eigen::Index a = b; a < columns; ++a)
            first_(rows.column[static_cast<std::size_t>(a)], rows.column[static_cast<std::size_t>(b)]) +=
                square(a, b);
}

/// C = [A B^T; B -E]: A is positive definite, and C has as many negative eigenvalues as there are negative
/// springs if E + B A^-1 B^T is so too.
bool LowRank::factor(std::span<const ContactSpring* const> spring, Eigen::Index positive) {
    const Eigen::Index negative = first_.rows() - positive;
    for (Eigen::Index k = 0; k < first_.rows(); ++k)
        first_(k, k) += 1.0 / spring[static_cast<std::size_t>(k)]->stiffness;
    second_ = -first_.bottomRightCorner(negative, negative);
    coupling_ = first_.bottomLeftCorner(negative, positive).transpose();
    first_ = first_.topLeftCorner(positive, positive).eval();
    // Eigen's products of matrices without rows divide by zero.
    if (positive > 0 && !factor_lower(first_)) return false;
    if (negative == 0) return true;
    if (positive > 0) {
        first_.triangularView<Eigen::Lower>().solveInPlace(coupling_);
        second_.selfadjointView<Eigen::Lower>().rankUpdate(coupling_.transpose());
    }
    return factor_lower(second_);
}

void LowRank::correct(const FrontTree& tree, std::span<Vec2> x) const {
    if (rows_.empty()) return;
    Eigen::VectorXd z = Eigen::VectorXd::Zero(first_.rows() + second_.rows()), own, some;
    const auto gather = [&](const Front& front) {
        own.resize(2 * index(front.pivots.size()));
        for (std::size_t k = 0; k < front.pivots.size(); ++k)
            own.segment<2>(index(2 * k)) = x[at(front.pivots[k])];
    };
    for (std::size_t f = 0; f < rows_.size(); ++f) {
        const Rows& rows = rows_[f];
        if (rows.column.empty()) continue;
        gather(tree.front[f]);
        some.noalias() = rows.pivot.transpose() * own;
        for (std::size_t k = 0; k < rows.column.size(); ++k) z[rows.column[k]] += some[index(k)];
    }
    auto u = z.head(first_.rows());
    auto v = z.tail(second_.rows());
    first_.triangularView<Eigen::Lower>().solveInPlace(u);
    v -= coupling_.transpose() * u;
    second_.triangularView<Eigen::Lower>().solveInPlace(v);
    second_.triangularView<Eigen::Lower>().transpose().solveInPlace(v);
    v = -v;
    u -= coupling_ * v;
    first_.triangularView<Eigen::Lower>().transpose().solveInPlace(u);
    for (std::size_t f = 0; f < rows_.size(); ++f) {
        const Rows& rows = rows_[f];
        if (rows.column.empty()) continue;
        some.resize(index(rows.column.size()));
        for (std::size_t k = 0; k < rows.column.size(); ++k) some[index(k)] = z[rows.column[k]];
        own.noalias() = rows.pivot * some;
        const auto& pivots = tree.front[f].pivots;
        for (std::size_t k = 0; k < pivots.size(); ++k) x[at(pivots[k])] -= own.segment<2>(index(2 * k));
    }
}

}  // namespace softgrain::mpm
