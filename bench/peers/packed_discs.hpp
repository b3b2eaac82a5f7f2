#pragma once
// The sample that rigid DEM and its peers are given: a periodic square of discs, slightly compressed.
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "common/packing/overlap_energy.hpp"
#include "common/packing/packing.hpp"
#include "common/packing/random.hpp"
#include "common/packing/tiled.hpp"

namespace softgrain::peers {

inline constexpr double packing_fraction = 0.85;
inline constexpr double smallest_diameter = 0.8, largest_diameter = 1.2;  ///< uniform by number [m]

/// n discs at random places, pushed apart until their forces balance.
inline Packing packed_cell(int n, std::uint64_t seed) {
    Random random(seed);
    Packing cell;
    double area = 0.0;
    for (int i = 0; i < n; ++i) {
        cell.radius.push_back(0.5 * random.between(smallest_diameter, largest_diameter));
        area += std::numbers::pi * cell.radius.back() * cell.radius.back();
    }
    const double side = std::sqrt(area / packing_fraction);
    cell.box = Box{{0.0, side, 0.0, side}, true};
    for (int i = 0; i < n; ++i) cell.center.push_back({random.between(0.0, side), random.between(0.0, side)});
    constexpr double balance = 1e-6, clear = 1e-9;
    constexpr int most_steps = 20000;
    OverlapEnergy relaxed(cell.radius, cell.center, cell.box);
    relaxed.relax(balance, clear, most_steps);
    for (std::size_t i = 0; i < cell.size(); ++i) cell.center[i] = cell.box.wrapped(relaxed.center()[i]);
    return cell;
}

/// Velocities uniform in a square, their mean zero, with this root mean square [m/s].
inline std::vector<Vec2> agitation(std::size_t n, double rms, std::uint64_t seed) {
    Random random(seed);
    const double most = rms * std::sqrt(1.5);
    std::vector<Vec2> v;
    Vec2 mean = Vec2::Zero();
    for (std::size_t i = 0; i < n; ++i) {
        v.push_back({random.between(-most, most), random.between(-most, most)});
        mean += v.back() / static_cast<double>(n);
    }
    for (Vec2& one : v) one -= mean;
    return v;
}

}  // namespace softgrain::peers
