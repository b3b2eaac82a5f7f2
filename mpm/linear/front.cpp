#include "mpm/linear/front.hpp"

#include <algorithm>

#include "common/at.hpp"
#include "mpm/linear/dense_cholesky.hpp"

namespace softgrain::mpm {
namespace {

/// Columns that a thread takes at once of what is left of a large front.
constexpr Eigen::Index shared_columns = 128;

/// The lower triangle of the first columns of a matrix.
void clear_lower(double* a, std::size_t stride, std::size_t columns) {
    for (std::size_t j = 0; j < columns; ++j) std::fill(a + j * stride + j, a + (j + 1) * stride, 0.0);
}

}  // namespace

std::vector<Run> runs_of(std::span<const int> places) {
    std::vector<Run> found;
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (!found.empty() && places[k] == found.back().to + found.back().count)
            ++found.back().count;
        else
            found.push_back({static_cast<int>(k), places[k], 1});
    }
    return found;
}

void Front::begin() {
    const std::size_t p = 2 * pivots.size(), r = 2 * rest.size();
    stride_ = p + r;
    left_stride_ = r;
    columns_.resize(stride_ * p);
    left_ = std::make_unique_for_overwrite<double[]>(left_stride_ * r);
    clear_lower(columns_.data(), stride_, p);
    if (p == 0) clear_lower(left_.get(), left_stride_, r);
}

void Front::add(Part part, const DenseElement& from, std::span<const Run> runs) {
    const std::size_t p = pivots.size();
    const std::size_t stride = part == Part::columns ? stride_ : left_stride_;
    const std::size_t above = part == Part::columns ? 0 : p;
    for (std::size_t first = 0; first < runs.size(); ++first)
        for (int b = 0; b < runs[first].count; ++b) {
            const int column = runs[first].to + b;
            if (part_of(column) != part) continue;
            double* const to = part == Part::columns ? columns_.data() + 2 * at(column) * stride
                                                     : left_.get() + 2 * (at(column) - p) * stride;
            const double* const source = from.data + 2 * at(runs[first].from + b) * from.stride;
            for (std::size_t k = first; k < runs.size(); ++k) {
                const int skip = k == first ? b : 0;
                const int count = 2 * (runs[k].count - skip);
                const double* const s = source + 2 * (runs[k].from + skip);
                double* const t = to + 2 * (at(runs[k].to + skip) - above);
                for (int i = 0; i < count; ++i) t[i] += s[i];
                const double* const s1 = s + from.stride;
                double* const t1 = t + stride;
                for (int i = 0; i < count; ++i) t1[i] += s1[i];
            }
        }
}

void Front::add(Part part, const Eigen::MatrixXd& from, std::span<const int> places) {
    for (std::size_t b = 0; b < places.size(); ++b)
        for (std::size_t a = b; a < places.size(); ++a) {
            const auto [column, row] = std::minmax(places[a], places[b]);
            if (part_of(column) != part) continue;
            const Mat2 block =
                from.block<2, 2>(static_cast<Eigen::Index>(2 * a), static_cast<Eigen::Index>(2 * b));
            add(row, column, places[a] >= places[b] ? block : Mat2(block.transpose()));
        }
}

void Front::add(int row, int column, const Mat2& block) {
    const std::size_t p = pivots.size(), r = at(row), c = at(column);
    const bool left = c >= p;
    const std::size_t stride = left ? left_stride_ : stride_;
    double* const to =
        left ? left_.get() + 2 * ((c - p) * stride + r - p) : columns_.data() + 2 * (c * stride + r);
    to[0] += block(0, 0);
    to[1] += block(1, 0);
    to[stride] += block(0, 1);
    to[stride + 1] += block(1, 1);
}

void Front::shift_pivots(double by) {
    for (std::size_t j = 0; j < 2 * pivots.size(); ++j) columns_[j * stride_ + j] += by;
}

bool Front::reduce(bool shared) {
    const std::size_t p = 2 * pivots.size(), r = 2 * rest.size();
    if (p == 0) return true;
    const auto index = [](std::size_t k) { return static_cast<Eigen::Index>(k); };
    const Strided columns(columns_.data(), index(p + r), index(p), Eigen::OuterStride<>(index(stride_)));
    if (!factor_columns(columns)) return false;
    const Strided left(left_.get(), index(r), index(r), Eigen::OuterStride<>(index(left_stride_)));
    // The same panels for any number of threads.
#pragma omp taskloop grainsize(1) if (shared)
    for (Eigen::Index first = 0; first < index(r); first += shared_columns)
        find_lower_product(columns.bottomRows(index(r)), left, first,
                           std::min(index(r), first + shared_columns));
    return true;
}

void Front::forward(std::span<Vec2> x) const {
    if (pivots.empty()) return;
    Eigen::VectorXd own(2 * size(pivots)), others(2 * size(rest));
    for (std::size_t k = 0; k < pivots.size(); ++k)
        own.segment<2>(static_cast<Eigen::Index>(2 * k)) = x[at(pivots[k])];
    diagonal().triangularView<Eigen::Lower>().solveInPlace(own);
    others.noalias() = below() * own;
    for (std::size_t k = 0; k < pivots.size(); ++k)
        x[at(pivots[k])] = own.segment<2>(static_cast<Eigen::Index>(2 * k));
    for (std::size_t k = 0; k < rest.size(); ++k)
        x[at(rest[k])] -= others.segment<2>(static_cast<Eigen::Index>(2 * k));
}

void Front::backward(std::span<Vec2> x) const {
    if (pivots.empty()) return;
    Eigen::VectorXd own(2 * size(pivots)), others(2 * size(rest));
    for (std::size_t k = 0; k < pivots.size(); ++k)
        own.segment<2>(static_cast<Eigen::Index>(2 * k)) = x[at(pivots[k])];
    for (std::size_t k = 0; k < rest.size(); ++k)
        others.segment<2>(static_cast<Eigen::Index>(2 * k)) = x[at(rest[k])];
    own.noalias() -= below().transpose() * others;
    diagonal().transpose().triangularView<Eigen::Upper>().solveInPlace(own);
    for (std::size_t k = 0; k < pivots.size(); ++k)
        x[at(pivots[k])] = own.segment<2>(static_cast<Eigen::Index>(2 * k));
}

double Front::operations() const {
    const auto cube = [](double x) { return x * x * x; };
    const auto p = 2.0 * static_cast<double>(pivots.size()), r = 2.0 * static_cast<double>(rest.size());
    return (cube(p + r) - cube(r)) / 3.0;
}

std::vector<int> FrontTree::places(std::span<const int> nodes, const Front& in) const {
    std::vector<int> found;
    found.reserve(nodes.size());
    const auto earlier = [&](int a, int b) { return rank[at(a)] < rank[at(b)]; };
    for (const int node : nodes) {
        const auto p = std::lower_bound(in.pivots.begin(), in.pivots.end(), node, earlier);
        if (p != in.pivots.end()) {
            found.push_back(static_cast<int>(p - in.pivots.begin()));
            continue;
        }
        const auto r = std::lower_bound(in.rest.begin(), in.rest.end(), node, earlier);
        found.push_back(static_cast<int>(in.pivots.size()) + static_cast<int>(r - in.rest.begin()));
    }
    return found;
}

}  // namespace softgrain::mpm
