#include "mpm/dynamics/fastest_mode.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

/// Change of the eigenvalue in an iteration that ends it.
constexpr double settled = 1e-3;
constexpr int most_iterations = 60;

/// Something of every mode: a fixed sequence without pattern.
Vec2 seed(std::size_t node) {
    const double turn = std::numbers::phi * static_cast<double>(node + 1);
    return {std::sin(40.0 * turn), std::cos(57.0 * turn)};
}

}  // namespace

FastestMode::FastestMode(const Grains& grains, const Mass& mass, double penalty, bool mean_dilatation)
    : grains_(grains),
      mass_(mass),
      forces_(static_cast<std::size_t>(omp_get_max_threads()),
              GrainForces(*grains.disc, *grains.pattern, mean_dilatation)),
      squared_(grains.size(), 0.0),
      deformation_(grains.size() * grains.disc->cell.size()),
      marked_(grains.size()) {
    double softest = std::numeric_limits<double>::infinity();
    for (const Grain& grain : grains.grain) softest = std::min(softest, grain.compliance());
    const double h = grains.disc->spacing();
    for (const Grain& grain : grains.grain) {
        const double own = grain.compliance(), wall = contact_stiffness(penalty, h, own, own),
                     other = 2.0 * contact_stiffness(penalty, h, own, softest);
        contact_.push_back(grain.radius * (grains.size() > 1 ? std::max(wall, other) : wall));
    }
    mode_.reserve(grains.all_nodes());
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (std::size_t m = 0; m < grains.nodes(); ++m) mode_.push_back(seed(m));
}

void FastestMode::find(std::span<const Vec2> q, std::span<const PlasticState> plastic) {
    if (found_ == 0) {
        // The mode of the first grain is nearly that of all others.
        marked_[0] = true;
        find_marked(q, plastic);
        for (std::size_t m = grains_.nodes(); m < mode_.size(); ++m) mode_[m] = mode_[m - grains_.nodes()];
    }
    std::fill(marked_.begin(), marked_.end(), char{true});
    find_marked(q, plastic);
}

void FastestMode::look_at(std::size_t g, std::span<const Mat2> F) {
    const std::vector<Cell>& cell = grains_.disc->cell;
    double largest = 0.0;
    for (std::size_t k = 0; k < cell.size(); ++k)
        largest = std::max(largest, (F[at(cell[k].first_point)] - deformation(g, k)).cwiseAbs().maxCoeff());
    marked_[g] = largest > change;
}

void FastestMode::refresh(std::span<const Vec2> q, std::span<const PlasticState> plastic) {
    if (std::ranges::find(marked_, char{true}) != marked_.end()) find_marked(q, plastic);
}

void FastestMode::find_marked(std::span<const Vec2> q, std::span<const PlasticState> plastic) {
    const std::size_t nodes = grains_.nodes(), points = grains_.points();
#pragma omp parallel if (grains_.threads)
    {
        std::vector<Mat2> stiffness(grains_.pattern->size());
#pragma omp for schedule(dynamic)
        for (std::size_t g = 0; g < grains_.size(); ++g) {
            if (!marked_[g]) continue;
            find_mode(g, forces_[at(omp_get_thread_num())], q.subspan(g * nodes, nodes),
                      plastic.empty() ? plastic : plastic.subspan(g * points, points), stiffness);
        }
    }
    largest_ = *std::ranges::max_element(squared_);
    found_ += std::ranges::count(marked_, char{true});
    std::fill(marked_.begin(), marked_.end(), char{false});
}

void FastestMode::find_mode(std::size_t g, GrainForces& forces, std::span<const Vec2> q,
                            std::span<const PlasticState> plastic, std::vector<Mat2>& stiffness) {
    const Grain& grain = grains_.grain[g];
    const std::size_t nodes = grains_.nodes();
    std::vector<Vec2> image(nodes, Vec2::Zero());
    forces.evaluate(grain, q, plastic, image, stiffness);
    for (std::size_t k = 0; k < grains_.disc->cell.size(); ++k)
        deformation(g, k) = forces.deformation()[at(grains_.disc->cell[k].first_point)];

    const std::span<Vec2> x = grains_.of(mode_, g);
    double before = 0.0, norm2 = mass_.squared(x);
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        apply(g, stiffness, x, image);
        double energy = 0.0;
        for (std::size_t m = 0; m < nodes; ++m) energy += x[m].dot(image[m]);
        squared_[g] = energy / norm2;
        // M x of the next x is the image of this one.
        std::copy(image.begin(), image.end(), x.begin());
        mass_.solve(x);
        norm2 = 0.0;
        for (std::size_t m = 0; m < nodes; ++m) norm2 += x[m].dot(image[m]);
        const double scale = 1.0 / std::sqrt(norm2);
        for (Vec2& v : x) v *= scale;
        norm2 = 1.0;
        if (std::abs(squared_[g] - before) < settled * squared_[g]) break;
        before = squared_[g];
    }
    squared_[g] /= grain.density * grain.area;
}

void FastestMode::apply(std::size_t g, std::span<const Mat2> stiffness, std::span<const Vec2> x,
                        std::span<Vec2> y) const {
    const StiffnessPattern& pattern = *grains_.pattern;
    std::fill(y.begin(), y.end(), Vec2::Zero());
    for (std::size_t m = 0; m < x.size(); ++m)
        for (int k = pattern.start[m]; k < pattern.start[m + 1]; ++k) {
            const std::size_t n = at(pattern.column[at(k)]);
            y[m] += stiffness[at(k)] * x[n];
            if (n != m) y[n] += stiffness[at(k)].transpose() * x[m];
        }
    if (contact_[g] == 0.0) return;
    const ShapeRows& surface = grains_.disc->surface;
    const double stiffness_of_point = contact_[g] * grains_.disc->surface_weight();
    for (std::size_t s = 0; s < surface.size(); ++s) {
        const Vec2 push = stiffness_of_point * surface.at(s, x);
        const auto node = surface.nodes(s);
        const auto N = surface.values(s);
        for (std::size_t k = 0; k < node.size(); ++k) y[at(node[k])] += N[k] * push;
    }
}

}  // namespace softgrain::mpm
