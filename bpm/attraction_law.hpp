#pragma once
// Attraction of two discs: the attractive part of a generalised Lennard-Jones law.

namespace softgrain::bpm {

/// Attraction of two discs with a0 = r_i + r_j at centre distance r >= a0: F = F0 (a0/r)^gamma, and nothing
/// beyond r = a0 (1 + range) (Nezamabadi et al. 2017, Eq. 1 with delta = r - a0). Overlapping discs: F0 r/a0.
struct AttractionLaw {
    double maximum_force = 1.0;  ///< F0 [N]
    double exponent = 7.0;       ///< gamma, 1 to 30
    double range = 1.0;          ///< largest gap / a0, > 0

    /// Largest distance / a0.
    double cut_off() const { return 1.0 + range; }
    /// As printed, the clear form that the vectorised one is tested against [N].
    double force(double distance, double a0) const;
    /// Its integral [J per unit thickness], zero at the cut-off and beyond.
    double potential(double distance, double a0) const;
};

/// Bounds of what the law is used for; checked by Attraction.
inline constexpr double least_exponent = 1.0, largest_exponent = 30.0;
inline constexpr double least_range = 0.05, largest_range = 10.0;

}  // namespace softgrain::bpm
