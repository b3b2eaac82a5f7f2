#include "common/neighbors.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/neighbor_grid.hpp"

namespace softgrain {
namespace {

constexpr std::size_t worth_threads = 20'000;  ///< grains
constexpr std::size_t blocks = 32;

struct Partner {
    int j;
    Image image;
};

/// Pairs of all blocks, in an order that does not depend on the number of threads.
std::array<std::vector<FoundPair>, blocks> find_in_blocks(const NeighborGrid& grid) {
    std::array<std::vector<FoundPair>, blocks> found;
    const std::size_t n = grid.size();
#pragma omp parallel for schedule(dynamic) if (n > worth_threads)
    for (std::size_t b = 0; b < blocks; ++b) {
        found[b].reserve(4 * n / blocks);
        grid.find(b * n / blocks, (b + 1) * n / blocks, found[b]);
    }
    return found;
}

}  // namespace

void NeighborList::build(std::span<const Vec2> x, std::span<const double> reach, double skin) {
    build(x, reach, skin, Box{});
}

void NeighborList::build(std::span<const Vec2> x, std::span<const double> reach, double skin,
                         const Box& cell) {
    skin_ = skin;
    built_cell_ = cell;
    built_at_.assign(x.begin(), x.end());
    built_reach_.assign(reach.begin(), reach.end());
    pairs_.clear();
    images_.clear();
    if (x.empty()) return;
    const NeighborGrid grid(x, reach, skin, cell);
    const auto found = find_in_blocks(grid);

    // Counting sort by i, then each grain's partners by j.
    const std::size_t n = x.size();
    std::vector<std::size_t> start(n + 1, 0);
    for (const auto& block : found)
        for (const FoundPair& p : block) ++start[static_cast<std::size_t>(p.i) + 1];
    for (std::size_t i = 0; i < n; ++i) start[i + 1] += start[i];
    std::vector<Partner> partner(start[n]);
    std::vector<std::size_t> fill(start.begin(), start.end() - 1);
    for (const auto& block : found)
        for (const FoundPair& p : block) partner[fill[static_cast<std::size_t>(p.i)]++] = {p.j, p.image};

    pairs_.resize(partner.size());
    if (cell.periodic) images_.resize(partner.size());
#pragma omp parallel for schedule(static) if (n > worth_threads)
    for (std::size_t i = 0; i < n; ++i) {
        const auto begin = partner.begin() + static_cast<std::ptrdiff_t>(start[i]);
        const auto end = partner.begin() + static_cast<std::ptrdiff_t>(start[i + 1]);
        std::sort(begin, end, [](const Partner& a, const Partner& b) { return a.j < b.j; });
        for (std::size_t k = start[i]; k < start[i + 1]; ++k) {
            pairs_[k] = {static_cast<int>(i), partner[k].j};
            if (cell.periodic) images_[k] = partner[k].image;
        }
    }
}

bool NeighborList::stale(std::span<const Vec2> x, std::span<const double> reach) const {
    return stale(x, reach, Box{});
}

/// A difference r = r0 F + (motion against the cell), F the cell's deformation since the build. An unlisted
/// pair began at |r0| >= sum of reaches + skin, and |F r0| >= s |r0|, s the smaller stretch of F.
bool NeighborList::stale(std::span<const Vec2> x, std::span<const double> reach, const Box& cell) const {
    const std::size_t n = built_at_.size();
    if (x.size() != n || cell.periodic != built_cell_.periodic) return true;
    if (n == 0) return false;
    Mat2 F = Mat2::Identity();
    Vec2 shift = Vec2::Zero();
    double loss = 0.0;  // 1 - s
    if (cell.periodic) {
        F = cell.lattice() * built_cell_.lattice().inverse();
        shift = cell.origin() - F * built_cell_.origin();
        const double mean = std::hypot(F(0, 0) + F(1, 1), F(0, 1)),
                     half = std::hypot(F(0, 0) - F(1, 1), F(0, 1));
        loss = std::max(0.0, 1.0 - 0.5 * (mean - half));
    }
    const double half_skin = 0.5 * skin_ * (1.0 - loss);
    const double xx = F(0, 0), xy = F(0, 1), yy = F(1, 1);
    const double* const now = x.data()->data();
    const double* const then = built_at_.data()->data();
    const double* const grown = reach.data();
    const double* const built = built_reach_.data();
    int stale = 0;
#pragma omp parallel for simd schedule(static) reduction(| : stale) if (parallel : n > worth_threads)
    for (std::size_t k = 0; k < n; ++k) {
        const double dx = now[2 * k] - (shift.x() + xx * then[2 * k] + xy * then[2 * k + 1]);
        const double dy = now[2 * k + 1] - (shift.y() + yy * then[2 * k + 1]);
        const double room = half_skin - (grown[k] - built[k]) - loss * built[k];
        stale |= static_cast<int>(room <= 0.0) | static_cast<int>(dx * dx + dy * dy >= room * room);
    }
    return stale != 0;
}

}  // namespace softgrain
