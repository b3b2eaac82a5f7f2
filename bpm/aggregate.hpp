#pragma once
// Preparation of one grain: discs thrown at random, drawn together, then relaxed under their own attraction.
#include <cstdint>
#include <vector>

#include "bpm/disc_sizes.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

/// All that a grain of radius 1 follows from.
struct AggregateSpec {
    int discs = 100;
    DiscSizes sizes = {};
    double attraction_exponent = 7.0;  ///< gamma
    double attraction_range = 1.0;     ///< largest gap [a0]
    double outline_rho = 0.3;          ///< closing radius of the outline, in mean disc diameters
    std::uint64_t seed = 1;
    int grain = 0;  ///< index: its own stream of random numbers
};

/// A relaxed grain about its centre of mass.
struct Aggregate {
    std::vector<Vec2> x;
    std::vector<double> radius;
    double speed = 0.0;                      ///< root mean square speed left, in sqrt(F0 d / m)
    double overlap = 0.0;                    ///< largest overlap left, in mean disc diameters
    double internal_packing_fraction = 0.0;  ///< area of the discs / area inside the outline
    int steps = 0;
};

/// Bounds that a prepared grain meets; root mean square speed in sqrt(F0 d/m), overlap in mean disc
/// diameters.
inline constexpr double aggregate_speed_bound = 1e-3;
inline constexpr double aggregate_overlap_bound = 1e-4;

/// A grain of radius 1: its outline encloses pi. Throws DivergedError if the bounds are not met, and
/// StopAsked.
Aggregate prepare_aggregate(const AggregateSpec& spec);

/// The same grain, so much larger.
void scale(Aggregate& grain, double factor);

}  // namespace softgrain::bpm
