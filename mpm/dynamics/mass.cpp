#include "mpm/dynamics/mass.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <stdexcept>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

std::vector<double> mass_in_pattern(const ReferenceDisc& disc, const StiffnessPattern& pattern) {
    std::vector<double> value(pattern.size(), 0.0);
    for (std::size_t k = 0; k < disc.cell.size(); ++k) {
        const Cell& c = disc.cell[k];
        for (int p = c.first_point; p < c.first_point + c.points; ++p) {
            const auto N = disc.at_points.values(at(p));
            const int* place = pattern.place.data() + pattern.cell_start[k];
            for (std::size_t a = 0; a < N.size(); ++a)
                for (std::size_t b = 0; b <= a; ++b, ++place)
                    value[at(*place)] += disc.weight[at(p)] * N[a] * N[b];
        }
    }
    return value;
}

}  // namespace

Mass::Mass(const ReferenceDisc& disc, const StiffnessPattern& pattern)
    : disc_(disc), pattern_(pattern), value_(mass_in_pattern(disc, pattern)) {
    const auto n = static_cast<int>(disc.nodes());
    std::vector<Eigen::Triplet<double>> entries;
    for (int m = 0; m < n; ++m)
        for (int k = pattern.start[at(m)]; k < pattern.start[at(m) + 1]; ++k)
            entries.emplace_back(m, pattern.column[at(k)], value_[at(k)]);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> cholesky(matrix);
    if (cholesky.info() != Eigen::Success) throw std::logic_error("the mass of a disc is not positive");

    for (int m = 0; m < n; ++m) place_.push_back(cholesky.permutationP().indices()[m]);
    const Eigen::SparseMatrix<double> L = cholesky.matrixL();
    start_.push_back(0);
    for (int column = 0; column < n; ++column) {
        for (Eigen::SparseMatrix<double>::InnerIterator entry(L, column); entry; ++entry) {
            if (entry.row() == column) {
                inverse_diagonal_.push_back(1.0 / entry.value());
                continue;
            }
            row_.push_back(static_cast<int>(entry.row()));
            lower_.push_back(entry.value());
        }
        start_.push_back(static_cast<int>(row_.size()));
    }
}

void Mass::solve(std::span<Vec2> x) const {
    const std::size_t n = x.size();
    std::vector<Vec2> y(n);
    for (std::size_t m = 0; m < n; ++m) y[at(place_[m])] = x[m];
    for (std::size_t c = 0; c < n; ++c) {
        const Vec2 pivot = y[c] *= inverse_diagonal_[c];
        for (int k = start_[c]; k < start_[c + 1]; ++k) y[at(row_[at(k)])] -= lower_[at(k)] * pivot;
    }
    for (std::size_t c = n; c-- > 0;) {
        // Two sums, so that neither waits for the other.
        Vec2 sum = y[c], other = Vec2::Zero();
        int k = start_[c];
        for (; k + 1 < start_[c + 1]; k += 2) {
            sum -= lower_[at(k)] * y[at(row_[at(k)])];
            other -= lower_[at(k + 1)] * y[at(row_[at(k + 1)])];
        }
        if (k < start_[c + 1]) sum -= lower_[at(k)] * y[at(row_[at(k)])];
        y[c] = inverse_diagonal_[c] * (sum + other);
    }
    for (std::size_t m = 0; m < n; ++m) x[m] = y[at(place_[m])];
}

void Mass::apply(std::span<const Vec2> x, std::span<Vec2> y) const {
    std::fill(y.begin(), y.end(), Vec2::Zero());
    for (std::size_t m = 0; m < x.size(); ++m) {
        const int diagonal = pattern_.start[m + 1] - 1;
        Vec2 sum = value_[at(diagonal)] * x[m];
        for (int k = pattern_.start[m]; k < diagonal; ++k) {
            const std::size_t other = at(pattern_.column[at(k)]);
            sum += value_[at(k)] * x[other];
            y[other] += value_[at(k)] * x[m];
        }
        y[m] += sum;
    }
}

double Mass::squared(std::span<const Vec2> x) const {
    double sum = 0.0;
    for (std::size_t m = 0; m < x.size(); ++m) {
        const int diagonal = pattern_.start[m + 1] - 1;
        Vec2 row = 0.5 * value_[at(diagonal)] * x[m];
        for (int k = pattern_.start[m]; k < diagonal; ++k)
            row += value_[at(k)] * x[at(pattern_.column[at(k)])];
        sum += 2.0 * x[m].dot(row);
    }
    return sum;
}

/// The splines sum to 1.
Vec2 Mass::momentum(std::span<const Vec2> v) const {
    Vec2 sum = Vec2::Zero();
    for (std::size_t m = 0; m < v.size(); ++m) sum += disc_.integral[m] * v[m];
    return sum;
}

double Mass::angular_momentum(std::span<const Vec2> q, std::span<const Vec2> v) const {
    std::vector<Vec2> momentum(v.size());
    apply(v, momentum);
    double sum = 0.0;
    for (std::size_t m = 0; m < v.size(); ++m) sum += cross(q[m], momentum[m]);
    return sum;
}

RigidMotion Mass::rigid_motion(std::span<const Vec2> q, std::span<const Vec2> v) const {
    double area = 0.0;
    for (const double m : disc_.integral) area += m;
    const Vec2 center = momentum(q) / area, velocity = momentum(v) / area;
    std::vector<Vec2> arm(q.size());
    for (std::size_t m = 0; m < q.size(); ++m) arm[m] = q[m] - center;
    return {center, velocity, angular_momentum(arm, v) / squared(arm)};
}

}  // namespace softgrain::mpm
