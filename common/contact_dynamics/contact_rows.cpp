#include "common/contact_dynamics/contact_rows.hpp"

#include <algorithm>
#include <bitset>
#include <map>
#include <numeric>

#include "common/contact_dynamics/row_batches.hpp"

namespace softgrain {
namespace {

constexpr std::size_t max_colours = 256;
using Colours = std::bitset<max_colours>;

/// A row to be, and the place of its pair in the list of candidates.
struct Row {
    int colour;
    std::size_t pair;
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

/// Rows inside blocks: block by block, in batches, singles at the end of each block.
class InsideRows {
  public:
    InsideRows(std::span<const Pair> pairs, const ContactBlocks& blocks)
        : start_(static_cast<std::size_t>(blocks.size()) + 1, 0) {
        const auto block_of = [&](const Pair& pair) {
            const int a = blocks.of_disc[static_cast<std::size_t>(pair.i)];
            return a == blocks.of_disc[static_cast<std::size_t>(pair.j)] ? a : -1;
        };
        for (const Pair& pair : pairs)
            if (const int block = block_of(pair); block >= 0) ++start_[static_cast<std::size_t>(block) + 1];
        std::partial_sum(start_.begin(), start_.end(), start_.begin());
        rows_.resize(static_cast<std::size_t>(start_.back()));
        std::vector<int> fill(start_.begin(), start_.end() - 1);
        Colouring colouring(blocks.of_disc.size());
        for (std::size_t k = 0; k < pairs.size(); ++k)
            if (const int block = block_of(pairs[k]); block >= 0)
                rows_[static_cast<std::size_t>(fill[static_cast<std::size_t>(block)]++)] = {
                    colouring.colour_of(pairs[k].i, pairs[k].j), k};
        first_single_.assign(start_.begin(), start_.end() - 1);
        for (std::size_t b = 0; b < first_single_.size(); ++b) put_into_batches(b);
    }

    const std::vector<Row>& rows() const { return rows_; }
    const std::vector<int>& start() const { return start_; }
    const std::vector<int>& first_single() const { return first_single_; }

  private:
    void put_into_batches(std::size_t block) {
        const auto first = rows_.begin() + start_[block], last = rows_.begin() + start_[block + 1];
        std::stable_sort(first, last, [](const Row& a, const Row& b) { return a.colour < b.colour; });
        std::vector<Row> singles;
        auto kept = first;
        for (auto row = first; row != last;) {
            const auto next = std::find_if(row, last, [&](const Row& r) { return r.colour != row->colour; });
            const auto whole = row + (next - row) / contact_sweep::batch_rows * contact_sweep::batch_rows;
            singles.insert(singles.end(), whole, next);
            kept = std::copy(row, whole, kept);
            row = next;
        }
        first_single_[block] = static_cast<int>(kept - rows_.begin());
        std::copy(singles.begin(), singles.end(), kept);
    }

    std::vector<Row> rows_;
    std::vector<int> start_, first_single_;
};

/// A row between two blocks.
struct SeamRow {
    int colour, a, b;
    std::size_t pair;
    friend auto operator<=>(const SeamRow&, const SeamRow&) = default;
};

std::vector<SeamRow> sorted_seam_rows(std::span<const Pair> pairs, const ContactBlocks& blocks) {
    std::vector<SeamRow> rows;
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto [a, b] = std::minmax(blocks.of_disc[static_cast<std::size_t>(pairs[k].i)],
                                        blocks.of_disc[static_cast<std::size_t>(pairs[k].j)]);
        if (a != b) rows.push_back({0, a, b, k});
    }
    std::sort(rows.begin(), rows.end());
    Colouring colouring(blocks.group_of_block.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const bool same = k > 0 && rows[k - 1].a == rows[k].a && rows[k - 1].b == rows[k].b;
        rows[k].colour = same ? rows[k - 1].colour : colouring.colour_of(rows[k].a, rows[k].b);
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

/// Notes where the seams begin; the first of their rows is `first`.
void mark_seams(const std::vector<SeamRow>& seam_rows, int first, ContactRows& rows) {
    for (std::size_t k = 0; k < seam_rows.size(); ++k) {
        const SeamRow& now = seam_rows[k];
        const int row = first + static_cast<int>(k);
        if (k == 0 || seam_rows[k - 1].colour != now.colour)
            rows.colour_start.push_back(static_cast<int>(rows.seams.size()));
        if (k == 0 || rows.seams.back().a != now.a || rows.seams.back().b != now.b)
            rows.seams.push_back({now.a, now.b, row, row});
        rows.seams.back().last = row + 1;
    }
    rows.colour_start.push_back(static_cast<int>(rows.seams.size()));
}

}  // namespace

ContactRows make_contact_rows(std::span<const Pair> pairs, const Discs& discs, const ContactBlocks& blocks,
                              RowContent content) {
    const InsideRows inside(pairs, blocks);
    const std::vector<SeamRow> seam_rows = sorted_seam_rows(pairs, blocks);
    const std::size_t n = pairs.size();
    ContactRows rows;
    rows.block_start = inside.start();
    rows.first_single = inside.first_single();
    mark_seams(seam_rows, inside.start().back(), rows);
    rows.i.reserve(n);
    rows.j.reserve(n);
    rows.share.reserve(n);
    rows.row_of_pair.resize(n);
    const auto append = [&](std::size_t pair) {
        rows.row_of_pair[pair] = static_cast<int>(rows.i.size());
        rows.i.push_back(pairs[pair].i);
        rows.j.push_back(pairs[pair].j);
        const double mi = discs.mass[static_cast<std::size_t>(pairs[pair].i)];
        const double mj = discs.mass[static_cast<std::size_t>(pairs[pair].j)];
        rows.share.push_back(mj / (mi + mj));
    };
    for (const Row& row : inside.rows()) append(row.pair);
    for (const SeamRow& row : seam_rows) append(row.pair);
    rows.direction.assign(n, Vec2::UnitX());
    rows.gap_speed.assign(n, 0.0);
    rows.normal.assign(n, 0.0);
    if (content.tangential) rows.tangential.assign(n, 0.0);
    if (content.rolling) rows.rolling.assign(n, 0.0);
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
    auto old = from.row_of_pair.begin();
    for (const int now : to.row_of_pair) {
        const auto b = static_cast<std::size_t>(now);
        const Pair pair{to.i[b], to.j[b]};
        const auto pair_of = [&](int row) {
            return Pair{from.i[static_cast<std::size_t>(row)], from.j[static_cast<std::size_t>(row)]};
        };
        while (old != from.row_of_pair.end() && pair_of(*old) < pair) ++old;
        if (old == from.row_of_pair.end()) return;
        if (pair_of(*old) != pair) continue;
        const auto a = static_cast<std::size_t>(*old);
        to.normal[b] = from.normal[a];
        if (!to.tangential.empty()) to.tangential[b] = from.tangential[a];
        if (!to.rolling.empty()) to.rolling[b] = from.rolling[a];
    }
}

void carry_impulses(const WallRows& from, WallRows& to) {
    std::map<std::pair<int, int>, double> impulse;
    for (std::size_t k = 0; k < from.size(); ++k) impulse[{from.disc[k], from.wall[k]}] = from.normal[k];
    for (std::size_t k = 0; k < to.size(); ++k)
        if (const auto found = impulse.find({to.disc[k], to.wall[k]}); found != impulse.end())
            to.normal[k] = found->second;
}

}  // namespace softgrain
