#include "common/packing/size_laws.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

/// Rejection from a uniform proposal: the distribution of redrawing a normal until it lies between the
/// cut-offs, at any width of the cut.
double gaussian(const PackingSpec& s, Random& random) {
    if (s.radius_deviation == 0.0) return s.radius_mean;
    const double reach = 8.0 * s.radius_deviation;  // beyond it the density is below the 53 bits of a draw
    const double low = std::max(s.radius_min, s.radius_mean - reach);
    const double high = std::min(s.radius_max, s.radius_mean + reach);
    for (;;) {
        const double radius = random.between(low, high);
        const double z = (radius - s.radius_mean) / s.radius_deviation;
        if (random.unit() < std::exp(-0.5 * z * z)) return radius;
    }
}

double fractal(const PackingSpec& s, Random& random) {
    // Inverse of N(>r) ~ r^-D, with lengths in units of radius_min.
    const double ratio = s.radius_max / s.radius_min;
    const double end = std::pow(ratio, -s.fractal_dimension);
    const double radius =
        s.radius_min * std::pow(1.0 - random.unit() * (1.0 - end), -1.0 / s.fractal_dimension);
    return std::min(radius, s.radius_max);
}

double uniform_volume(const PackingSpec& s, Random& random) {
    return std::sqrt(random.between(s.radius_min * s.radius_min, s.radius_max * s.radius_max));
}

double draw(const PackingSpec& spec, Random& random) {
    switch (spec.size_law) {
        case SizeLaw::gaussian:
            return gaussian(spec, random);
        case SizeLaw::fractal:
            return fractal(spec, random);
        case SizeLaw::uniform_volume:
            return uniform_volume(spec, random);
        case SizeLaw::uniform:
            return random.between(spec.radius_min, spec.radius_max);
        case SizeLaw::two_sizes:  // not one by one
        case SizeLaw::single:
            break;
    }
    return spec.radius_mean;
}

std::vector<double> two_sizes(const PackingSpec& s, Random& random) {
    std::vector<double> radii(static_cast<std::size_t>(s.count), s.radius_max);
    const auto small = static_cast<std::size_t>(std::lround(s.small_share * s.count));
    std::fill_n(radii.begin(), small, s.radius_min);
    random.shuffle(radii);
    return radii;
}

}  // namespace

std::vector<double> draw_radii(const PackingSpec& spec, Random& random) {
    if (spec.size_law == SizeLaw::two_sizes) return two_sizes(spec, random);
    std::vector<double> radii(static_cast<std::size_t>(spec.count));
    std::generate(radii.begin(), radii.end(), [&] { return draw(spec, random); });
    return radii;
}

}  // namespace softgrain
