#include "sdem/contact_list.hpp"

#include <algorithm>
#include <numeric>

namespace softgrain::sdem {
namespace {

/// Values of `old` for the keys of both sorted lists, zero for new keys.
template <class Key, class T>
std::vector<T> carried(std::span<const Key> old_keys, const std::vector<T>& old, std::span<const Key> keys) {
    std::vector<T> now(keys.size(), T{});
    std::size_t o = 0;
    for (std::size_t k = 0; k < keys.size(); ++k) {
        while (o < old_keys.size() && old_keys[o] < keys[k]) ++o;
        if (o < old_keys.size() && old_keys[o] == keys[k]) now[k] = old[o];
    }
    return now;
}

template <class Key>
void carry(ContactHistory& history, std::span<const Key> old_keys, std::span<const Key> keys) {
    for (auto* values : {&history.spring, &history.adhesion, &history.lens})
        *values = carried(old_keys, *values, keys);
    history.tangential.assign(keys.size(), 0.0);
    history.slip_rate.assign(keys.size(), 0.0);
}

/// [n + 1] sums of counts, from counts in [1, n].
void accumulate(std::vector<std::uint32_t>& start) {
    std::partial_sum(start.begin(), start.end(), start.begin());
}

}  // namespace

void ContactHistory::resize(std::size_t size) {
    for (auto* values : {&spring, &adhesion, &lens, &tangential, &slip_rate}) values->assign(size, 0.0);
}

bool ContactList::stale(const Grains& grains, const Box& box) const {
    if (!box.periodic)
        for (std::size_t w = 0; w < 4; ++w)
            if (2.0 * std::abs(box.position[w] - built_box_.position[w]) >= neighbors_.skin()) return true;
    return neighbors_.stale(grains.center, grains.reach, box);
}

void ContactList::build(std::span<const Vec2> center, std::span<const double> reach, const Box& box,
                        double skin) {
    const std::size_t n = center.size();
    const std::vector<Pair> old_pairs(pairs().begin(), pairs().end());
    const std::vector<WallPair> old_walls = std::move(wall_pair_);
    neighbors_.build(center, reach, skin, box);
    built_box_ = box;

    guess = carried<Pair>(old_pairs, guess, pairs());
    if (keeps_history) carry<Pair>(pair_history, old_pairs, pairs());
    pair_contact.assign(pairs().size(), Contact{});
    pair_opening.assign(keeps_openings ? pairs().size() : 0, Opening{});
    first_.assign(n + 1, 0);
    second_start_.assign(n + 1, 0);
    for (const Pair& pair : pairs()) {
        ++first_[static_cast<std::size_t>(pair.i) + 1];
        ++second_start_[static_cast<std::size_t>(pair.j) + 1];
    }
    accumulate(first_);
    accumulate(second_start_);
    second_.resize(pairs().size());
    std::vector<std::uint32_t> fill(second_start_.begin(), second_start_.end() - 1);
    for (std::size_t k = 0; k < pairs().size(); ++k)
        second_[fill[static_cast<std::size_t>(pairs()[k].j)]++] = static_cast<std::uint32_t>(k);

    wall_pair_.clear();
    wall_start_.assign(1, 0);
    for (std::size_t g = 0; g < n; ++g) {
        for (int w = 0; w < 4 && !box.periodic; ++w)
            if (box.distance(w, center[g]) < reach[g] + skin) wall_pair_.push_back({static_cast<int>(g), w});
        wall_start_.push_back(static_cast<std::uint32_t>(wall_pair_.size()));
    }
    if (keeps_history) carry<WallPair>(wall_history, old_walls, wall_pair_);
    wall_contact.assign(wall_pair_.size(), Contact{});
    wall_opening.assign(wall_pair_.size(), Opening{});
}

bool ContactList::reach_below(std::size_t first, std::size_t begin, std::size_t end) const {
    for (std::size_t g = begin; g < end && first > 0; ++g)
        if (!second(g).empty() && static_cast<std::size_t>(pairs()[second(g).front()].i) < first) return true;
    return false;
}

void ContactList::find_shares(const Grains& grains) {
    const auto weight = [&](int g) {
        const auto k = static_cast<std::size_t>(g);
        return grains.grain[k].radius * grains.material_of(k).plane_E;
    };
    share.clear();
    for (const Pair& pair : pairs()) share.push_back(weight(pair.j) / (weight(pair.i) + weight(pair.j)));
}

}  // namespace softgrain::sdem
