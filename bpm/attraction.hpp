#pragma once
// Long-range attraction between the discs of one grain: the attractive part of a Lennard-Jones law, gamma
// = 7.
#include <span>
#include <string>
#include <vector>

#include "common/checkpoint.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

/// Attraction of two discs with a0 = r_i + r_j at centre distance r: F = F0 (a0/r)^7, so that
/// F_i = (F0/a0) q^4 (x_j - x_i), q = min(1, a0^2/r^2), and nothing beyond r = 2 a0
/// (Nezamabadi et al. 2017, Eq. 1 with delta = r - a0).
struct AttractionLaw {
    double maximum_force = 1.0;  ///< F0 [N]

    /// Potential [J per unit thickness], zero beyond the cut-off, -F0 a0 (63/384) at touch.
    double potential(double distance, double a0) const;
};

/// Attraction inside each of several grains, with a neighbour list for each grain.
class Attraction {
  public:
    /// Grain g holds the discs grain_start[g] to grain_start[g + 1]. radius [n] [m]; skin > 0 [m].
    Attraction(AttractionLaw law, std::vector<int> grain_start, std::span<const double> radius, double skin);

    /// Force on every disc [N]. Refreshes the lists of grains that have changed too much. Throws
    /// DivergedError naming the grain if a disc is out of reach of every other disc of its grain.
    void forces(std::span<const Vec2> x, double time, std::span<Vec2> force);

    /// Sum of the pair potentials [J per unit thickness].
    double energy(std::span<const Vec2> x) const;

    void save(Checkpoint& to, const std::string& prefix) const;
    void load(const Checkpoint& from, const std::string& prefix);

  private:
    /// Full list of one grain: the neighbours of its k-th disc are [start[k], start[k + 1]), padded with a
    /// disc that is far from all others to whole vectors.
    struct GrainList {
        std::vector<int> start, neighbor;
    };

    bool stale(std::size_t grain, std::span<const Vec2> x) const;
    void rebuild(std::size_t grain);
    void force_in_grain(std::size_t grain, std::span<Vec2> force) const;
    bool has_lost_disc(std::size_t grain) const;

    AttractionLaw law_;
    std::vector<int> grain_start_;
    double skin_;
    // One far disc is appended to each of these; the lists are padded with it.
    std::vector<double> radius_, x_, y_;
    std::vector<Vec2> built_at_;  ///< empty before the first call
    std::vector<GrainList> lists_;
};

}  // namespace softgrain::bpm
