#pragma once
// A front of the multifrontal method: some nodes that are eliminated at once, and what they leave.
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "common/vec.hpp"

namespace softgrain::mpm {

/// The lower triangle of a dense symmetric matrix; what is above the diagonal means nothing.
struct DenseElement {
    const double* data;
    std::size_t stride;
};

/// Places of the nodes of one list in another that is in the same order, as runs without gaps.
struct Run {
    int from, to, count;
};
std::vector<Run> runs_of(std::span<const int> places);

struct Front {
    std::vector<int> pivots, rest;  ///< in the order in which they are eliminated
    std::vector<int> elements;      ///< summed here

    using Columns = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
    /// Of the factor: the pivots by themselves, a lower triangle, and the rest by the pivots.
    Columns diagonal() const { return {columns_.data(), 2 * size(pivots), 2 * size(pivots), stride_of()}; }
    Columns below() const {
        return {columns_.data() + 2 * pivots.size(), 2 * size(rest), 2 * size(pivots), stride_of()};
    }
    /// What is left of the rest.
    DenseElement left() const { return {left_.get(), left_stride_}; }
    void forget_left() { left_.reset(); }

    /// A front is summed in two parts: its columns before reduce(), what is left after it; without pivots all
    /// of it after begin().
    enum class Part { columns, left };
    void begin();
    /// Adds a part of a matrix on some of the nodes.
    void add(Part part, const DenseElement& from, std::span<const Run> runs);
    /// The same in any order of nodes.
    void add(Part part, const Eigen::MatrixXd& from, std::span<const int> places);
    /// Adds 2 x 2 numbers; row >= column are places.
    void add(int row, int column, const Mat2& block);
    void shift_pivots(double by);
    /// False if the pivots are not positive definite. shared: among the threads of the team that calls it.
    bool reduce(bool shared = false);
    void forward(std::span<Vec2> x) const;
    void backward(std::span<Vec2> x) const;
    /// Floating-point operations of reduce().
    double operations() const;

  private:
    static Eigen::Index size(const std::vector<int>& nodes) {
        return static_cast<Eigen::Index>(nodes.size());
    }
    Eigen::OuterStride<> stride_of() const {
        return Eigen::OuterStride<>(static_cast<Eigen::Index>(stride_));
    }
    Part part_of(int column) const {
        return static_cast<std::size_t>(column) < pivots.size() ? Part::columns : Part::left;
    }

    std::vector<double> columns_;  ///< of the pivots [stride x 2 pivots]
    std::unique_ptr<double[]> left_;
    std::size_t stride_ = 0, left_stride_ = 0;
};

/// Fronts that add what they leave to their parents.
struct FrontTree {
    std::vector<Front> front;            ///< children before their parent
    std::vector<int> parent;             ///< [fronts] -1: none
    std::vector<std::vector<Run>> runs;  ///< [fronts] places of the rest in the parent
    std::vector<int> rank;               ///< [nodes] in which order they are eliminated; -1: not here
    std::vector<int> front_of;           ///< [nodes] that eliminates them

    /// Places in a front of nodes that are all there.
    std::vector<int> places(std::span<const int> nodes, const Front& in) const;
};

}  // namespace softgrain::mpm
