#include "common/resting_blocks.hpp"

#include <algorithm>

#include "common/errors.hpp"

namespace softgrain {
namespace {

/// Of the weight: what falls freely is not at rest, however slowly it starts.
constexpr double share_of_weight = 0.1;

}  // namespace

void RestingBlocks::start(std::vector<std::vector<std::uint32_t>> neighbors) {
    neighbors_ = std::move(neighbors);
    seen_.assign(neighbors_.size(), {});
    way_.assign(neighbors_.size(), 0.0);
    slow_for_.assign(neighbors_.size(), 0);
    resting_.assign(neighbors_.size(), 0);
}

void RestingBlocks::moved(std::size_t block, double distance) {
    way_[block] += distance;
    slow_for_[block] = distance * slow_steps <= tolerance_ ? std::min(slow_for_[block] + 1, slow_steps) : 0;
}

double RestingBlocks::largest_acceleration(const Vec2& gravity, double dt) const {
    const double within_slow_steps = 2.0 * tolerance_ / (slow_steps * slow_steps * dt * dt);
    const double weight = gravity.norm();
    return weight > 0.0 ? std::min(within_slow_steps, share_of_weight * weight) : within_slow_steps;
}

void RestingBlocks::put_to_rest(std::size_t block) {
    resting_[block] = 1;
    seen_[block].clear();
    for (const std::uint32_t other : neighbors_[block]) seen_[block].push_back(way_[other]);
}

void RestingBlocks::wake(std::size_t block) {
    resting_[block] = 0;
    slow_for_[block] = 0;
    seen_[block].clear();
}

void RestingBlocks::wake_beside_motion() {
    for (std::size_t b = 0; b < resting_.size(); ++b) {
        if (resting_[b] == 0) continue;
        bool still = true;
        for (std::size_t k = 0; k < neighbors_[b].size(); ++k)
            still = still && way_[neighbors_[b][k]] - seen_[b][k] <= tolerance_;
        if (still)
            ++left_out_;
        else
            wake(b);
    }
}

void RestingBlocks::save(Checkpoint& to) const {
    std::vector<double> ways = way_;
    std::vector<std::int64_t> counts{left_out_};
    for (std::size_t b = 0; b < resting_.size(); ++b) {
        ways.insert(ways.end(), seen_[b].begin(), seen_[b].end());
        counts.insert(counts.end(), {slow_for_[b], resting_[b]});
    }
    to.put("resting_ways", ways);
    to.put("resting_blocks", counts);
}

void RestingBlocks::load(const Checkpoint& from) {
    std::vector<double> ways;
    std::vector<std::int64_t> counts;
    from.get("resting_ways", ways);
    from.get("resting_blocks", counts);
    const std::size_t blocks = resting_.size();
    if (counts.size() != 1 + 2 * blocks) throw InputError("checkpoint array 'resting_blocks' does not fit");
    left_out_ = counts[0];
    std::size_t size = blocks;
    for (std::size_t b = 0; b < blocks; ++b) {
        slow_for_[b] = static_cast<int>(counts[1 + 2 * b]);
        resting_[b] = counts[2 + 2 * b] != 0 ? 1 : 0;
        seen_[b].resize(resting_[b] != 0 ? neighbors_[b].size() : 0);
        size += seen_[b].size();
    }
    if (ways.size() != size) throw InputError("checkpoint array 'resting_ways' does not fit");
    auto next = ways.begin();
    const auto take = [&](std::vector<double>& values) {
        for (double& value : values) value = *next++;
    };
    take(way_);
    for (auto& of_block : seen_) take(of_block);
}

}  // namespace softgrain
