#include "bpm/disc_sizes.hpp"

#include <cmath>

namespace softgrain::bpm {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): one step of the state and the mixed output.
std::uint64_t next(std::uint64_t& state) {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
}

}  // namespace

Random::Random(std::uint64_t seed, std::uint64_t stream) : state_(seed) {
    const std::uint64_t mixed = next(state_);
    state_ = mixed ^ (stream * 0xD1342543DE82EF95U + 1U);
    next(state_);
}

double Random::uniform() {
    return static_cast<double>(next(state_) >> 11U) * 0x1.0p-53;
}

std::vector<double> uniform_volume_radii(int count, double diameter_ratio, Random& random) {
    // With diameters 1 to k and d^2 uniform, the mean diameter is (2/3)(k^3 - 1)/(k^2 - 1).
    const double k = diameter_ratio;
    const double mean = 2.0 / 3.0 * (k * k + k + 1.0) / (k + 1.0);
    std::vector<double> radii(static_cast<std::size_t>(count));
    for (double& r : radii) r = 0.5 * std::sqrt(1.0 + (k * k - 1.0) * random.uniform()) / mean;
    return radii;
}

}  // namespace softgrain::bpm
