#pragma once
// Sizes of the primary discs: a uniform distribution of volumes.
#include <cstdint>
#include <vector>

namespace softgrain::bpm {

/// Random numbers that are the same on every machine.
class Random {
  public:
    /// Independent streams for each pair of seed and stream.
    Random(std::uint64_t seed, std::uint64_t stream);
    /// Uniform in [0, 1).
    double uniform();

  private:
    std::uint64_t state_;
};

/// Radii of `count` discs whose volume (area) is uniform between its least and largest value, diameter_ratio
/// = largest / smallest diameter >= 1. The unit of length is the mean diameter of the distribution.
std::vector<double> uniform_volume_radii(int count, double diameter_ratio, Random& random);

}  // namespace softgrain::bpm
