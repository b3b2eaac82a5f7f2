#pragma once
// Blocks of grains that a step leaves out while they and what they touch stay where they are. What they
// exert is kept as it was; it is out of date by what their neighbours have moved since, at most the
// tolerance.
#include <cstdint>
#include <vector>

#include "common/checkpoint.hpp"
#include "common/vec.hpp"

namespace softgrain {

class RestingBlocks {
  public:
    /// Steps for which a block has to be slow before it may rest: many periods of a grain between its
    /// neighbours.
    static constexpr int slow_steps = 64;

    /// `tolerance` [m]; with 0 no block ever rests.
    explicit RestingBlocks(double tolerance = 0.0) : tolerance_(tolerance) {}

    bool used() const { return tolerance_ > 0.0; }

    /// New blocks, all awake. neighbors[b]: the blocks that b shares contacts with.
    void start(std::vector<std::vector<std::uint32_t>> neighbors);

    bool resting(std::size_t block) const { return used() && resting_[block] != 0; }

    /// How far a block's grains have gone in this step at most, turning and change of shape included [m]. For
    /// blocks that are awake; each from any thread.
    void moved(std::size_t block, double distance);

    /// True if a block that is awake has been slow for long enough. It may rest if no grain of it is
    /// accelerated by more than largest_acceleration().
    bool slow(std::size_t block) const {
        return used() && resting_[block] == 0 && slow_for_[block] >= slow_steps;
    }
    /// That which takes a grain no farther than the tolerance in as many steps as a block has to be slow, and
    /// a small part of gravity [m/s^2].
    double largest_acceleration(const Vec2& gravity, double dt) const;
    void put_to_rest(std::size_t block);

    void wake(std::size_t block);
    /// Wakes blocks whose neighbours have moved by more than the tolerance since they came to rest.
    void wake_beside_motion();

    /// Steps times blocks left out so far.
    long long left_out() const { return left_out_; }

    void save(Checkpoint& to) const;
    /// Throws InputError if it is not of as many blocks and neighbours.
    void load(const Checkpoint& from);

  private:
    double tolerance_;
    long long left_out_ = 0;
    std::vector<std::vector<std::uint32_t>> neighbors_;
    std::vector<std::vector<double>> seen_;  ///< way of each neighbour when the block came to rest [m]
    std::vector<double> way_;                ///< bound on the motion since start() [m]
    std::vector<int> slow_for_;              ///< steps
    std::vector<std::uint8_t> resting_;
};

}  // namespace softgrain
