#pragma once
// Sizes of the primary discs of a grain.
#include <cstdint>
#include <span>
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

/// What is uniform between the least and the largest disc: the volume (area), or the diameter; or all discs
/// are alike.
enum class DiscSizeLaw { uniform_volume, uniform, single };

/// The unit of length is the mean diameter of the distribution.
struct DiscSizes {
    DiscSizeLaw law = DiscSizeLaw::uniform_volume;
    double ratio = 1.625;  ///< largest / smallest diameter, 1 to 20; of no effect on `single`

    double smallest_diameter() const;
    double mean_square_diameter() const;
};

/// Mass that the time step follows: the mean, but at most twice the least, as light discs move fast.
double governing_mass(std::span<const double> mass);

std::vector<double> draw_disc_radii(const DiscSizes& sizes, int count, Random& random);

}  // namespace softgrain::bpm
