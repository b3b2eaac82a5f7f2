#pragma once
// Which grain is of which class, and the discs around elongated ones. Drawn from streams of their own, so
// that sizes and positions of a scenario stay as they are without classes.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// [grains] Numbers by share, rounded so that they add up, in random order; empty for one class.
std::vector<std::uint8_t> draw_classes(const Scenario& scenario, std::size_t grains);

/// [grains] Of the classes; empty if all grains are discs.
std::vector<double> aspect_ratios(const Scenario& scenario, const std::vector<std::uint8_t>& classes,
                                  std::size_t grains);

/// [classes] Empty if no class is one of clumps.
std::vector<ClumpShape> clump_shapes(const Scenario& scenario);

/// [grains] Uniform in [0, pi), or in [0, 2 pi) if there are clumps [rad].
std::vector<double> draw_angles(const Scenario& scenario, std::size_t grains);

/// [grains] Area of the disc around a grain / area of the grain; empty if all grains are discs.
std::vector<double> elongations(const Packing& packing);
/// Radii of the discs around grains of these equal-area radii [m].
std::vector<double> radii_of_discs_around(const std::vector<double>& radii,
                                          const std::vector<double>& elongation);
/// Area of the grains / area of the discs around them.
double share_of_discs_around(const std::vector<double>& radii, const std::vector<double>& elongation);

}  // namespace softgrain
