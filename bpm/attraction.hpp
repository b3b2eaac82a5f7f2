#pragma once
// Long-range attraction between the discs of one grain.
#include <span>
#include <string>
#include <vector>

#include "bpm/attraction_law.hpp"
#include "bpm/disc_stripes.hpp"
#include "common/checkpoint.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

/// Attraction inside each of several grains, with neighbours of its own for each grain. The same bits for any
/// number of threads and every instruction set.
class Attraction {
  public:
    /// Grain g holds the discs grain_start[g] to grain_start[g + 1]. radius [n] [m]; skin > 0 [m]. Throws
    /// InputError if the law is beyond its bounds.
    Attraction(const AttractionLaw& law, std::vector<int> grain_start, std::span<const double> radius,
               double skin);

    /// Force on every disc [N]. Refreshes the neighbours of grains that have changed too much. Throws
    /// DivergedError naming the grain if more than most_lost of its discs are lost, unless they are still to
    /// be gathered.
    void forces(std::span<const Vec2> x, double time, std::span<Vec2> force, bool gathered = true,
                bool threads = true);

    /// Sum of the pair potentials [J per unit thickness]; 0 before the first call of forces().
    double energy(std::span<const Vec2> x);

    /// Share of a grain's discs.
    static constexpr double most_lost = 0.02;
    /// Discs that are out of reach of every other disc of their grain, at its last look for neighbours.
    int lost_discs(std::size_t grain) const { return lost_[grain]; }

    /// How often a grain's neighbours were looked for, all grains together.
    long long rebuilds() const { return rebuilds_; }
    const DiscStripes& of_grain(std::size_t grain) const { return grains_[grain]; }

    void save(Checkpoint& to, const std::string& prefix) const;
    void load(const Checkpoint& from, const std::string& prefix);

  private:
    template <class T>
    std::span<T> own(std::span<T> of_all, std::size_t grain) const {
        const auto first = static_cast<std::size_t>(grain_start_[grain]);
        return of_all.subspan(first, static_cast<std::size_t>(grain_start_[grain + 1]) - first);
    }
    void rebuild(std::size_t grain);

    AttractionLaw law_;
    std::vector<int> grain_start_;
    double skin_;
    std::vector<double> radius_;
    std::vector<Vec2> built_at_;  ///< empty before the first call
    std::vector<DiscStripes> grains_;
    std::vector<int> lost_;       ///< [grains]
    std::vector<double> energy_;  ///< [n]
    long long rebuilds_ = 0;
};

}  // namespace softgrain::bpm
