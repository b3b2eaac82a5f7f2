#include "common/observables/forces.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/at.hpp"
#include "common/observables/stress.hpp"

namespace softgrain {
namespace {

/// Larger principal stress and its direction.
struct Major {
    double stress;
    Vec2 direction;
};
Major major_of(const Mat2& stress) {
    Eigen::SelfAdjointEigenSolver<Mat2> solver;
    solver.computeDirect(stress);
    return {solver.eigenvalues()[1], solver.eigenvectors().col(1)};
}

std::vector<Mat2> grain_stresses(const GrainView& view) {
    std::vector<Mat2> stress(view.free_size(), Mat2::Zero());
    for (const GrainContact& c : view.contacts) {
        const Vec2 whole = branch(view, c);
        if (view.at_boundary(c)) {
            stress[at(c.i)] -= c.force * whole.transpose();
            continue;
        }
        const double ri = std::sqrt(view.reference_area[at(c.i)]),
                     rj = std::sqrt(view.reference_area[at(c.j)]);
        stress[at(c.i)] -= c.force * whole.transpose() * (ri / (ri + rj));
        stress[at(c.j)] -= c.force * whole.transpose() * (rj / (ri + rj));
    }
    for (std::size_t g = 0; g < stress.size(); ++g)
        stress[g] = (0.5 / view.reference_area[g] * (stress[g] + stress[g].transpose())).eval();
    return stress;
}

/// First grain of what g is linked with so far.
int root_of(std::vector<int>& linked_with, int g) {
    while (linked_with[at(g)] != g) g = linked_with[at(g)] = linked_with[at(linked_with[at(g)])];
    return g;
}

/// Numbers what is linked, if it has 3 grains or more.
void number_chains(std::vector<int>& linked_with, ForceChains& result) {
    const std::size_t n = linked_with.size();
    std::vector<int> size(n, 0), number(n, -1);
    for (std::size_t g = 0; g < n; ++g) ++size[at(root_of(linked_with, static_cast<int>(g)))];
    for (std::size_t g = 0; g < n; ++g) {
        const std::size_t root = at(root_of(linked_with, static_cast<int>(g)));
        if (size[root] >= 3 && number[root] < 0) number[root] = result.chains++;
        result.chain.push_back(number[root]);
    }
}

}  // namespace

Histogram force_distribution(const GrainView& view, double bin) {
    double sum = 0.0, pressing = 0.0;
    for (const GrainContact& c : view.contacts)
        if (!view.at_boundary(c) && c.normal_force() > 0.0) {
            sum += c.normal_force();
            pressing += 1.0;
        }
    Histogram result{bin, {}};
    for (const GrainContact& c : view.contacts) {
        if (view.at_boundary(c) || !(c.normal_force() > 0.0)) continue;
        const auto k = static_cast<std::size_t>(c.normal_force() * pressing / sum / bin);
        if (k >= result.value.size()) result.value.resize(k + 1, 0.0);
        result.value[k] += 1.0 / (pressing * bin);
    }
    return result;
}

ForceChains force_chains(const GrainView& view, double turn) {
    ForceChains result{grain_stresses(view), {}, 0};
    std::vector<Major> major;
    double mean = 0.0;
    for (const Mat2& stress : result.stress) {
        major.push_back(major_of(stress));
        mean += major.back().stress / static_cast<double>(view.free_size());
    }
    std::vector<int> linked_with(view.free_size());
    std::iota(linked_with.begin(), linked_with.end(), 0);
    for (const GrainContact& c : view.contacts) {
        if (view.at_boundary(c)) continue;
        const Vec2 way = branch(view, c).normalized();
        const auto follows = [&](int g) {
            const Major& m = major[at(g)];
            return m.stress > mean && std::abs(m.direction.dot(way)) >= std::cos(turn);
        };
        if (!follows(c.i) || !follows(c.j)) continue;
        const int a = root_of(linked_with, c.i), b = root_of(linked_with, c.j);
        linked_with[at(std::max(a, b))] = std::min(a, b);
    }
    number_chains(linked_with, result);
    return result;
}

}  // namespace softgrain
