#include "common/observables/coordination.hpp"

#include <algorithm>
#include <vector>

#include "common/gather.hpp"

namespace softgrain {
namespace {

/// Grains with fewer than 2 contacts, removed one after the other; `touching` counts walls too.
std::vector<bool> find_rattlers(const PairsOfGrain& pairs_of, const std::vector<Pair>& pairs,
                                std::vector<int> touching) {
    std::vector<bool> rattler(touching.size(), false);
    std::vector<std::size_t> loose;
    for (std::size_t g = 0; g < touching.size(); ++g)
        if (touching[g] < 2) loose.push_back(g);
    while (!loose.empty()) {
        const std::size_t g = loose.back();
        loose.pop_back();
        rattler[g] = true;
        for (const PairsOfGrain::Entry entry : pairs_of.of(g)) {
            const Pair& pair = pairs[static_cast<std::size_t>(entry.pair)];
            const auto other = static_cast<std::size_t>(entry.second ? pair.i : pair.j);
            if (--touching[other] == 1) loose.push_back(other);
        }
    }
    return rattler;
}

}  // namespace

Coordination coordination(const GrainView& view) {
    const auto n = view.free_size();
    std::vector<int> touching(n, 0);
    std::vector<Pair> pairs;
    int wall_contacts = 0;
    const GrainContact* before = nullptr;
    for (const GrainContact& c : view.contacts) {
        // Clumps may touch in several places, which then stand one after the other.
        const bool again = before != nullptr && before->i == c.i && before->j == c.j;
        before = &c;
        if (again) continue;
        ++touching[static_cast<std::size_t>(c.i)];
        if (view.at_boundary(c)) {
            ++wall_contacts;
        } else {
            ++touching[static_cast<std::size_t>(c.j)];
            pairs.push_back({c.i, c.j});
        }
    }
    const auto grain_contacts = static_cast<double>(pairs.size());
    PairsOfGrain pairs_of;
    pairs_of.build(pairs, n);
    const std::vector<bool> rattler = find_rattlers(pairs_of, pairs, touching);
    const auto rattlers = static_cast<int>(std::count(rattler.begin(), rattler.end(), true));
    int carrying = 0;
    for (const Pair& pair : pairs)
        if (!rattler[static_cast<std::size_t>(pair.i)] && !rattler[static_cast<std::size_t>(pair.j)])
            ++carrying;
    const auto count = static_cast<double>(n);
    const double left = count - rattlers;
    return {2.0 * grain_contacts / count, left > 0.0 ? 2.0 * carrying / left : 0.0,
            (2.0 * grain_contacts + wall_contacts) / count, rattlers};
}

}  // namespace softgrain
