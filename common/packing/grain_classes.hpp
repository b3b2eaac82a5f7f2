#pragma once
// Which grain is of which class, and the discs around elongated ones. Drawn from streams of their own, so
// that sizes and positions of a scenario stay as they are without classes.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/scenario.hpp"

namespace softgrain {

/// [grains] Numbers by share, rounded so that they add up, in random order; empty for one class.
std::vector<std::uint8_t> draw_classes(const Scenario& scenario, std::size_t grains);

/// [grains] Of the classes; empty if all grains are discs.
std::vector<double> aspect_ratios(const Scenario& scenario, const std::vector<std::uint8_t>& classes,
                                  std::size_t grains);

/// [grains] Uniform in [0, pi) [rad].
std::vector<double> draw_angles(const Scenario& scenario, std::size_t grains);

/// Radii of the discs around ellipses of these equal-area radii; `elongation` as aspect_ratios [m].
std::vector<double> radii_of_discs_around(const std::vector<double>& radii,
                                          const std::vector<double>& elongation);
/// Area of the grains / area of the discs around them.
double share_of_discs_around(const std::vector<double>& radii, const std::vector<double>& elongation);

}  // namespace softgrain
