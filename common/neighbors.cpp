#include "common/neighbors.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

constexpr std::size_t worth_threads = 20'000;        ///< grains of a build
constexpr std::size_t worth_stale_threads = 50'000;  ///< grains of a look: it takes 2 ns for each
constexpr std::size_t blocks = 32;
constexpr std::size_t pairs_expected = 3;  ///< of a grain, to make room for at once

template <class... Vectors>
void free_all(Vectors&... vectors) {
    ((vectors = Vectors()), ...);
}

}  // namespace

CellChange cell_change(const Box& before, const Box& now) {
    CellChange change;
    const Mat2& F = change.F = now.lattice() * before.lattice().inverse();
    change.shift = now.origin() - F * before.origin();
    const double mean = std::hypot(F(0, 0) + F(1, 1), F(0, 1)), half = std::hypot(F(0, 0) - F(1, 1), F(0, 1));
    change.loss = std::max(0.0, 1.0 - 0.5 * (mean - half));
    return change;
}

/// Pairs of all blocks of grains, in an order that does not depend on the number of threads.
void NeighborList::find_pairs() {
    const std::size_t n = grid_.size();
    found_.resize(blocks);
#pragma omp parallel for schedule(dynamic) if (n > worth_threads)
    for (std::size_t b = 0; b < blocks; ++b) {
        found_[b].clear();
        if (lean_) found_[b].reserve(pairs_expected * (n / blocks + 1));
        grid_.find(b * n / blocks, (b + 1) * n / blocks, found_[b]);
    }
}

void NeighborList::build(std::span<const Vec2> x, std::span<const double> reach, double skin) {
    build(x, reach, skin, Box{});
}

void NeighborList::build(std::span<const Vec2> x, std::span<const double> reach, double skin,
                         const Box& cell) {
    built_at_.assign(x.begin(), x.end());
    built_reach_.assign(reach.begin(), reach.end());
    build_pairs(skin, cell);
}

void NeighborList::build(std::vector<Vec2>&& x, std::vector<double>&& reach, double skin, const Box& cell) {
    built_at_ = std::move(x);
    built_reach_ = std::move(reach);
    build_pairs(skin, cell);
}

void NeighborList::build_pairs(double skin, const Box& cell) {
    skin_ = skin;
    built_cell_ = cell;
    pairs_.clear();
    images_.clear();
    if (built_at_.empty()) return;
    grid_.build(built_at_, built_reach_, skin, cell);
    find_pairs();
    if (lean_) grid_ = {};

    // Counting sort by i, then each grain's partners by j.
    const std::size_t n = built_at_.size();
    start_.assign(n + 1, 0);
    for (const auto& block : found_)
        for (const FoundPair& p : block) ++start_[static_cast<std::size_t>(p.i) + 1];
    for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
    partner_.resize(start_[n]);
    fill_.assign(start_.begin(), start_.end() - 1);
    for (const auto& block : found_)
        for (const FoundPair& p : block) partner_[fill_[static_cast<std::size_t>(p.i)]++] = {p.j, p.image};
    if (lean_) free_all(found_, fill_);

    pairs_.resize(partner_.size());
    if (cell.periodic) images_.resize(partner_.size());
#pragma omp parallel for schedule(static) if (n > worth_threads)
    for (std::size_t i = 0; i < n; ++i) {
        std::sort(partner_.begin() + start_[i], partner_.begin() + start_[i + 1],
                  [](const Partner& a, const Partner& b) { return a.j < b.j; });
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
            pairs_[k] = {static_cast<int>(i), partner_[k].j};
            if (cell.periodic) images_[k] = partner_[k].image;
        }
    }
    if (lean_) free_all(partner_, start_);
}

void NeighborList::forget_pairs() {
    free_all(pairs_, images_);
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
    const CellChange change = cell.periodic ? cell_change(built_cell_, cell) : CellChange{};
    const double loss = change.loss, half_skin = 0.5 * skin_ * (1.0 - loss);
    const double xx = change.F(0, 0), xy = change.F(0, 1), yy = change.F(1, 1);
    const double shift_x = change.shift.x(), shift_y = change.shift.y();
    const double* const now = x.data()->data();
    const double* const then = built_at_.data()->data();
    const double* const grown = reach.data();
    const double* const built = built_reach_.data();
    int stale = 0;
#pragma omp parallel for simd schedule(static) reduction(| : stale) if (parallel : n > worth_stale_threads)
    for (std::size_t k = 0; k < n; ++k) {
        const double dx = now[2 * k] - (shift_x + xx * then[2 * k] + xy * then[2 * k + 1]);
        const double dy = now[2 * k + 1] - (shift_y + yy * then[2 * k + 1]);
        const double room = half_skin - (grown[k] - built[k]) - loss * built[k];
        stale |= static_cast<int>(room <= 0.0) | static_cast<int>(dx * dx + dy * dy >= room * room);
    }
    return stale != 0;
}

}  // namespace softgrain
