#include "bpm/disc_sizes.hpp"

#include <algorithm>
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

double DiscSizes::smallest_diameter() const {
    const double k = ratio;
    switch (law) {
        case DiscSizeLaw::uniform_volume:
            // With diameters 1 to k and d^2 uniform, the mean diameter is (2/3)(k^3 - 1)/(k^2 - 1).
            return 1.5 * (k + 1.0) / (k * k + k + 1.0);
        case DiscSizeLaw::uniform:
            return 2.0 / (1.0 + k);
        case DiscSizeLaw::single:
            break;
    }
    return 1.0;
}

double DiscSizes::mean_square_diameter() const {
    const double k = ratio, least = smallest_diameter();
    switch (law) {
        case DiscSizeLaw::uniform_volume:
            return 0.5 * (1.0 + k * k) * least * least;
        case DiscSizeLaw::uniform:
            return (1.0 + k + k * k) / 3.0 * least * least;
        case DiscSizeLaw::single:
            break;
    }
    return 1.0;
}

double governing_mass(std::span<const double> mass) {
    double sum = 0.0;
    for (double m : mass) sum += m;
    return std::min(sum / static_cast<double>(mass.size()),
                    2.0 * *std::min_element(mass.begin(), mass.end()));
}

std::vector<double> draw_disc_radii(const DiscSizes& sizes, int count, Random& random) {
    const double k = sizes.ratio, smallest = 0.5 * sizes.smallest_diameter();
    std::vector<double> radii(static_cast<std::size_t>(count), smallest);
    for (double& r : radii) {
        if (sizes.law == DiscSizeLaw::uniform_volume) r *= std::sqrt(1.0 + (k * k - 1.0) * random.uniform());
        if (sizes.law == DiscSizeLaw::uniform) r *= 1.0 + (k - 1.0) * random.uniform();
    }
    return radii;
}

}  // namespace softgrain::bpm
