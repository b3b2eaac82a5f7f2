#include "common/contact_dynamics/contact_rows.hpp"

#include <algorithm>
#include <bitset>
#include <numeric>

#include "common/contact_dynamics/row_batches.hpp"

namespace softgrain {
namespace {

constexpr std::size_t max_colours = 256;
using Colours = std::bitset<max_colours>;

/// Where a row goes: a block's own rows come first, then the seams by colour.
struct Candidate {
    int seam_colour;  ///< -1 inside a block
    int a, b;         ///< blocks
    bool single;      ///< left over when the rows of a colour were put into batches
    int colour;       ///< inside a block
    Pair pair;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

/// Greedy colouring of the edges of a graph, in the order they come. Should 256 colours not do, each further
/// edge is a colour of its own.
class Colouring {
  public:
    explicit Colouring(std::size_t nodes) : taken_(nodes) {}

    int colour_of(int a, int b) {
        Colours& of_a = taken_[static_cast<std::size_t>(a)];
        Colours& of_b = taken_[static_cast<std::size_t>(b)];
        const Colours both = of_a | of_b;
        std::size_t colour = 0;
        while (colour < max_colours && both[colour]) ++colour;
        if (colour == max_colours) return static_cast<int>(max_colours) + overflow_++;
        of_a.set(colour);
        of_b.set(colour);
        return static_cast<int>(colour);
    }

  private:
    std::vector<Colours> taken_;
    int overflow_ = 0;
};

/// Moves the rows that fill no batch of their block and colour to the end of the block.
void set_singles_apart(std::vector<Candidate>& candidates) {
    const auto same_part = [](const Candidate& x, const Candidate& y) {
        return x.seam_colour == y.seam_colour && x.a == y.a && x.b == y.b;
    };
    for (auto first = candidates.begin(); first != candidates.end() && first->seam_colour < 0;) {
        const auto last =
            std::find_if(first, candidates.end(), [&](const Candidate& c) { return !same_part(c, *first); });
        for (auto row = first; row != last;) {
            const auto next =
                std::find_if(row, last, [&](const Candidate& c) { return c.colour != row->colour; });
            const auto left = (next - row) % contact_sweep::batch_rows;
            for (auto k = next - left; k != next; ++k) k->single = true;
            row = next;
        }
        std::stable_partition(first, last, [](const Candidate& c) { return !c.single; });
        first = last;
    }
}

std::vector<Candidate> sorted_candidates(std::span<const Pair> pairs, const Discs& discs,
                                         const ContactBlocks& blocks) {
    Colouring inside(discs.x.size());
    std::vector<Candidate> candidates;
    candidates.reserve(pairs.size());
    std::vector<std::pair<int, int>> seams;
    for (const Pair& pair : pairs) {
        const auto [a, b] = std::minmax(blocks.of_disc[static_cast<std::size_t>(pair.i)],
                                        blocks.of_disc[static_cast<std::size_t>(pair.j)]);
        if (a != b) seams.emplace_back(a, b);
        candidates.push_back({-1, a, b, false, a == b ? inside.colour_of(pair.i, pair.j) : 0, pair});
    }
    std::sort(seams.begin(), seams.end());
    seams.erase(std::unique(seams.begin(), seams.end()), seams.end());
    Colouring between(blocks.group_of_block.size());
    std::vector<int> colours;
    for (const auto& [a, b] : seams) colours.push_back(between.colour_of(a, b));
    for (Candidate& candidate : candidates) {
        if (candidate.a == candidate.b) continue;
        const auto seam = std::lower_bound(seams.begin(), seams.end(), std::pair(candidate.a, candidate.b));
        candidate.seam_colour = colours[static_cast<std::size_t>(seam - seams.begin())];
    }
    std::sort(candidates.begin(), candidates.end());
    set_singles_apart(candidates);
    return candidates;
}

/// Notes where blocks and seams begin.
void mark_parts(const std::vector<Candidate>& candidates, int blocks, ContactRows& rows) {
    rows.block_start.assign(static_cast<std::size_t>(blocks) + 1, 0);
    rows.first_single.assign(static_cast<std::size_t>(blocks), 0);
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const Candidate& now = candidates[k];
        const int row = static_cast<int>(k);
        if (now.seam_colour < 0) {
            const auto block = static_cast<std::size_t>(now.a);
            ++rows.block_start[block + 1];
            if (!now.single) ++rows.first_single[block];
            continue;
        }
        const bool first = rows.seams.empty();
        if (first || candidates[k - 1].seam_colour != now.seam_colour)
            rows.colour_start.push_back(static_cast<int>(rows.seams.size()));
        if (first || rows.seams.back().a != now.a || rows.seams.back().b != now.b)
            rows.seams.push_back({now.a, now.b, row, row});
        rows.seams.back().last = row + 1;
    }
    rows.colour_start.push_back(static_cast<int>(rows.seams.size()));
    std::partial_sum(rows.block_start.begin(), rows.block_start.end(), rows.block_start.begin());
    for (std::size_t b = 0; b < rows.first_single.size(); ++b) rows.first_single[b] += rows.block_start[b];
}

/// Row numbers in the order of (first, second).
std::vector<std::size_t> order_of(const std::vector<int>& first, const std::vector<int>& second) {
    std::vector<std::size_t> order(first.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return first[a] != first[b] ? first[a] < first[b] : second[a] < second[b];
    });
    return order;
}

/// Calls match(a, b) for every row a of one list that is row b of the other.
template <class Match>
void match_rows(const std::vector<int>& i0, const std::vector<int>& j0, const std::vector<int>& i1,
                const std::vector<int>& j1, Match match) {
    const std::vector<std::size_t> old_order = order_of(i0, j0);
    const std::vector<std::size_t> new_order = order_of(i1, j1);
    std::size_t a = 0;
    for (std::size_t b : new_order) {
        const auto before = [&](std::size_t k) { return i0[k] != i1[b] ? i0[k] < i1[b] : j0[k] < j1[b]; };
        while (a < old_order.size() && before(old_order[a])) ++a;
        if (a == old_order.size()) return;
        const std::size_t k = old_order[a];
        if (i0[k] == i1[b] && j0[k] == j1[b]) match(k, b);
    }
}

}  // namespace

ContactRows make_contact_rows(std::span<const Pair> pairs, const Discs& discs, const ContactBlocks& blocks,
                              RowContent content) {
    const std::vector<Candidate> candidates = sorted_candidates(pairs, discs, blocks);
    const std::size_t n = candidates.size();
    ContactRows rows;
    mark_parts(candidates, blocks.size(), rows);
    rows.i.resize(n);
    rows.j.resize(n);
    rows.share.resize(n);
    rows.direction.assign(n, Vec2::UnitX());
    rows.gap_speed.assign(n, 0.0);
    rows.normal.assign(n, 0.0);
    if (content.tangential) rows.tangential.assign(n, 0.0);
    if (content.rolling) rows.rolling.assign(n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
        rows.i[k] = candidates[k].pair.i;
        rows.j[k] = candidates[k].pair.j;
        const double mi = discs.mass[static_cast<std::size_t>(rows.i[k])];
        const double mj = discs.mass[static_cast<std::size_t>(rows.j[k])];
        rows.share[k] = mj / (mi + mj);
    }
    return rows;
}

WallRows make_wall_rows(const Discs& discs, const Box& box, double skin, const ContactBlocks& blocks) {
    struct Candidate {
        int block, disc, wall;
        auto operator<=>(const Candidate&) const = default;
    };
    std::vector<Candidate> candidates;
    for (std::size_t d = 0; d < discs.x.size(); ++d)
        for (int wall = 0; wall < 4; ++wall)
            if (box.distance(wall, discs.x[d]) < discs.radius[d] + skin)
                candidates.push_back({blocks.of_disc[d], static_cast<int>(d), wall});
    std::sort(candidates.begin(), candidates.end());

    WallRows rows;
    rows.block_start.assign(static_cast<std::size_t>(blocks.size()) + 1, 0);
    for (const Candidate& candidate : candidates) {
        rows.disc.push_back(candidate.disc);
        rows.wall.push_back(candidate.wall);
        ++rows.block_start[static_cast<std::size_t>(candidate.block) + 1];
    }
    std::partial_sum(rows.block_start.begin(), rows.block_start.end(), rows.block_start.begin());
    rows.gap_speed.assign(rows.size(), 0.0);
    rows.normal.assign(rows.size(), 0.0);
    return rows;
}

void carry_impulses(const ContactRows& from, ContactRows& to) {
    match_rows(from.i, from.j, to.i, to.j, [&](std::size_t a, std::size_t b) {
        to.normal[b] = from.normal[a];
        if (!to.tangential.empty()) to.tangential[b] = from.tangential[a];
        if (!to.rolling.empty()) to.rolling[b] = from.rolling[a];
    });
}

void carry_impulses(const WallRows& from, WallRows& to) {
    match_rows(from.disc, from.wall, to.disc, to.wall,
               [&](std::size_t a, std::size_t b) { to.normal[b] = from.normal[a]; });
}

}  // namespace softgrain
