#pragma once
// Least-distance problem with inequalities, by non-negative least squares (Lawson and Hanson 1974, chapter
// 23) on the normal equations, whose Cholesky factor is updated as contacts enter and leave.
#include <Eigen/Dense>
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <vector>

namespace softgrain {

/// Cholesky factor of a matrix that grows and shrinks by one row and column.
class GrowingCholesky {
  public:
    explicit GrowingCholesky(Eigen::Index most) : l_(most, most) {}

    /// Appends a row (its products with the rows before) and its diagonal; false if it is dependent on them.
    bool append(const Eigen::VectorXd& products, double diagonal) {
        const Eigen::VectorXd row = forward(products);
        const double rest = diagonal - row.squaredNorm();
        if (size_ == l_.rows() || !(rest > 1e-13 * diagonal)) return false;
        l_.row(size_).head(size_) = row.transpose();
        l_(size_, size_) = std::sqrt(rest);
        ++size_;
        return true;
    }
    /// Takes out a row and column; rotations make the rest triangular again.
    void remove(Eigen::Index at) {
        --size_;
        for (Eigen::Index k = at; k < size_; ++k) l_.row(k).head(k + 2) = l_.row(k + 1).head(k + 2);
        for (Eigen::Index k = at; k < size_; ++k) {
            const double length = std::hypot(l_(k, k), l_(k, k + 1));
            const double c = l_(k, k) / length, s = l_(k, k + 1) / length;
            for (Eigen::Index below = k; below < size_; ++below) {
                const double a = l_(below, k), b = l_(below, k + 1);
                l_(below, k) = c * a + s * b;
                l_(below, k + 1) = c * b - s * a;
            }
        }
    }
    Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
        return l_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().transpose().solve(forward(b));
    }

  private:
    Eigen::VectorXd forward(const Eigen::VectorXd& b) const {
        return l_.topLeftCorner(size_, size_).triangularView<Eigen::Lower>().solve(b);
    }

    Eigen::MatrixXd l_;
    Eigen::Index size_ = 0;
};

/// The rows with a positive multiplier in min |y| with G y >= g, from W = G G^T and g; G has `unknowns`
/// columns. Means nothing if there is no such y.
inline std::vector<Eigen::Index> active_rows(const Eigen::SparseMatrix<double>& w, const Eigen::VectorXd& g,
                                             Eigen::Index unknowns) {
    // min |E x - f| with x >= 0, E = (G^T; g^T), f = (0, ..., 0, 1): E^T E = W + g g^T, E^T f = g.
    const Eigen::Index n = w.cols();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    std::vector<Eigen::Index> passive;
    std::vector<char> in(static_cast<std::size_t>(n), 0);
    GrowingCholesky factor(unknowns + 1);
    const auto gathered = [&](const auto& value) {
        Eigen::VectorXd part(static_cast<Eigen::Index>(passive.size()));
        for (Eigen::Index k = 0; k < part.size(); ++k) part[k] = value(passive[static_cast<std::size_t>(k)]);
        return part;
    };
    for (Eigen::Index round = 0; round < 20 * n; ++round) {
        Eigen::VectorXd gradient = g * (1.0 - g.dot(x)) - w * x;
        for (Eigen::Index k = 0; k < n; ++k)
            if (in[static_cast<std::size_t>(k)] != 0) gradient[k] = 0.0;
        Eigen::Index best = 0;
        while (gradient.maxCoeff(&best) > 1e-14) {
            const Eigen::VectorXd column = w.col(best);
            if (factor.append(gathered([&](Eigen::Index k) { return column[k] + g[k] * g[best]; }),
                              column[best] + g[best] * g[best]))
                break;
            gradient[best] = 0.0;
        }
        if (!(gradient[best] > 1e-14)) return passive;
        passive.push_back(best);
        in[static_cast<std::size_t>(best)] = 1;
        for (bool shortened = true; shortened && !passive.empty();) {
            const Eigen::VectorXd s = factor.solve(gathered([&](Eigen::Index k) { return g[k]; }));
            double length = 1.0;
            std::size_t first_out = passive.size();
            for (std::size_t k = 0; k < passive.size(); ++k) {
                const double now = x[passive[k]], next = s[static_cast<Eigen::Index>(k)];
                if (next > 0.0 || now / (now - next) > length) continue;
                length = now == 0.0 ? 0.0 : now / (now - next);
                first_out = k;
            }
            for (std::size_t k = 0; k < passive.size(); ++k)
                x[passive[k]] += length * (s[static_cast<Eigen::Index>(k)] - x[passive[k]]);
            shortened = first_out < passive.size();
            if (!shortened) continue;
            x[passive[first_out]] = 0.0;
            in[static_cast<std::size_t>(passive[first_out])] = 0;
            passive.erase(passive.begin() + static_cast<std::ptrdiff_t>(first_out));
            factor.remove(static_cast<Eigen::Index>(first_out));
        }
    }
    return passive;
}

}  // namespace softgrain
