#pragma once
// The discs of one grain sorted into horizontal stripes, so that neighbours lie side by side in memory.
#include <span>
#include <vector>

#include "bpm/attraction_kernel.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

/// Each stripe is sorted by x and followed by empty slots. A disc's neighbours in one stripe are then runs of
/// slots; runs also hold discs beyond its reach, for the kernel to pass over.
class DiscStripes {
  public:
    /// x, radius [n] [m]. Runs hold all pairs nearer than cut_off (r_i + r_j) + skin, skin [m]; they stay
    /// complete until two discs have together moved by the skin.
    void build(std::span<const Vec2> x, std::span<const double> radius, double cut_off, double skin);
    /// New positions, same order.
    void move_to(std::span<const Vec2> x);

    StripedDiscs discs() const;
    /// Square of the largest motion since the build, apart from that of the grain as a whole [m^2].
    double largest_square_move() const;
    /// Discs farther than cut_off (r_i + r_j) + skin from all others; a lone disc is not lost.
    int lost_discs() const;
    std::size_t run_count() const { return run_.size(); }

  private:
    struct Stripe {
        int begin, end;  ///< slots with a disc
        double low, high, largest_radius;
    };
    void place(std::span<const Vec2> x, std::span<const double> radius);
    void find_runs();

    double cut_off_ = 0.0, skin_ = 0.0;
    std::vector<Stripe> stripes_;
    std::vector<double> x_, y_, radius_, x_built_, y_built_;  ///< [slots]
    std::vector<int> disc_, slot_, start_, run_;
};

}  // namespace softgrain::bpm
