#include "common/contact_dynamics/contact_rows.hpp"

#include <algorithm>
#include <bitset>
#include <numeric>

namespace softgrain {
namespace {

constexpr std::size_t max_colours = 256;
using Colours = std::bitset<max_colours>;

struct Candidate {
    int block;  ///< group, or the number of groups for a pair between groups
    int colour;
    Pair pair;
    friend auto operator<=>(const Candidate&, const Candidate&) = default;
};

/// Greedy colouring in the order of the pairs. Should 256 colours not do, each further row is a colour of its
/// own.
class Colouring {
  public:
    explicit Colouring(std::size_t discs) : taken_(discs) {}

    int colour_of(const Pair& pair) {
        Colours& a = taken_[static_cast<std::size_t>(pair.i)];
        Colours& b = taken_[static_cast<std::size_t>(pair.j)];
        const Colours both = a | b;
        std::size_t colour = 0;
        while (colour < max_colours && both[colour]) ++colour;
        if (colour == max_colours) return static_cast<int>(max_colours) + overflow_++;
        a.set(colour);
        b.set(colour);
        return static_cast<int>(colour);
    }

  private:
    std::vector<Colours> taken_;
    int overflow_ = 0;
};

std::vector<Candidate> sorted_candidates(std::span<const Pair> pairs, const Discs& discs, int groups) {
    Colouring within(discs.x.size());
    Colouring between(discs.x.size());
    std::vector<Candidate> candidates;
    candidates.reserve(pairs.size());
    for (const Pair& pair : pairs) {
        const int group = discs.group[static_cast<std::size_t>(pair.i)];
        const bool same = group == discs.group[static_cast<std::size_t>(pair.j)];
        candidates.push_back(
            {same ? group : groups, same ? within.colour_of(pair) : between.colour_of(pair), pair});
    }
    std::sort(candidates.begin(), candidates.end());
    return candidates;
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

ContactRows make_contact_rows(std::span<const Pair> pairs, const Discs& discs, int groups) {
    const std::vector<Candidate> candidates = sorted_candidates(pairs, discs, groups);
    const std::size_t n = candidates.size();
    ContactRows rows;
    rows.i.resize(n);
    rows.j.resize(n);
    rows.share.resize(n);
    rows.direction.assign(n, Vec2::UnitX());
    for (std::vector<double>* column : {&rows.gap_speed, &rows.normal, &rows.tangential})
        column->assign(n, 0.0);
    rows.block_start.assign(static_cast<std::size_t>(groups) + 1, 0);
    for (std::size_t k = 0; k < n; ++k) {
        const Candidate& candidate = candidates[k];
        rows.i[k] = candidate.pair.i;
        rows.j[k] = candidate.pair.j;
        const double mi = discs.mass[static_cast<std::size_t>(candidate.pair.i)];
        const double mj = discs.mass[static_cast<std::size_t>(candidate.pair.j)];
        rows.share[k] = mj / (mi + mj);
        if (candidate.block < groups) {
            ++rows.block_start[static_cast<std::size_t>(candidate.block) + 1];
        } else if (rows.colour_start.empty() || candidates[k - 1].colour != candidate.colour) {
            rows.colour_start.push_back(static_cast<int>(k));
        }
    }
    std::partial_sum(rows.block_start.begin(), rows.block_start.end(), rows.block_start.begin());
    rows.colour_start.push_back(static_cast<int>(n));
    return rows;
}

WallRows make_wall_rows(const Discs& discs, const Box& box, double skin, int groups) {
    struct Candidate {
        int group, disc, wall;
        auto operator<=>(const Candidate&) const = default;
    };
    std::vector<Candidate> candidates;
    for (std::size_t d = 0; d < discs.x.size(); ++d)
        for (int wall = 0; wall < 4; ++wall)
            if (box.distance(wall, discs.x[d]) < discs.radius[d] + skin)
                candidates.push_back({discs.group[d], static_cast<int>(d), wall});
    std::sort(candidates.begin(), candidates.end());

    WallRows rows;
    rows.block_start.assign(static_cast<std::size_t>(groups) + 1, 0);
    for (const Candidate& candidate : candidates) {
        rows.disc.push_back(candidate.disc);
        rows.wall.push_back(candidate.wall);
        ++rows.block_start[static_cast<std::size_t>(candidate.group) + 1];
    }
    std::partial_sum(rows.block_start.begin(), rows.block_start.end(), rows.block_start.begin());
    rows.gap_speed.assign(rows.size(), 0.0);
    rows.normal.assign(rows.size(), 0.0);
    return rows;
}

void carry_impulses(const ContactRows& from, ContactRows& to) {
    match_rows(from.i, from.j, to.i, to.j, [&](std::size_t a, std::size_t b) {
        to.normal[b] = from.normal[a];
        to.tangential[b] = from.tangential[a];
    });
}

void carry_impulses(const WallRows& from, WallRows& to) {
    match_rows(from.disc, from.wall, to.disc, to.wall,
               [&](std::size_t a, std::size_t b) { to.normal[b] = from.normal[a]; });
}

}  // namespace softgrain
