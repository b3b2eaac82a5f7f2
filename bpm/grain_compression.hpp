#pragma once
// One grain between two walls: what an aggregate is as a material (Nezamabadi et al. 2017, figures 5 to 7).
#include <cstdint>
#include <vector>

#include "bpm/solver.hpp"
#include "common/scenario.hpp"

namespace softgrain::bpm {

/// Strain is the wall displacement / height of the uncompressed grain, stress the mean force of both walls /
/// largest section of the grain at that time [N/m].
struct CompressionCurve {
    std::vector<double> strain, stress;  ///< means over intervals of 0.005
    double plateau = 0.0;                ///< mean stress between strains of 0.05 and 0.3 [N/m]
    /// Young's modulus of an elastic disc with the same secant of force over strain, sum(F e) / sum(e^2) up
    /// to a strain of 0.05, by Johnson's line contact [N/m].
    double modulus = 0.0;
};

/// Lowest and highest coordinate of the discs along an axis [m].
struct Extent {
    double low, high;
    double length() const { return high - low; }
};
Extent extent_of_discs(const BpmSolver& solver, int axis);

inline constexpr double plateau_begins = 0.05, plateau_ends = 0.30, elastic_up_to = 0.05;
/// Wall speed / sqrt(F0 d / m): slow enough to change the plateau by less than its scatter.
inline constexpr double compression_speed = 0.01;

/// A grain of this radius [m] with the settings and the material of the scenario, prepared from `seed`.
/// Throws InputError for grains of fewer than ten discs, DivergedError, StopAsked.
CompressionCurve compress_grain(const Scenario& scenario, double radius, std::uint64_t seed);

/// Plane-strain modulus E/(1 - nu^2) of a disc whose centre approaches each of two walls by strain x radius
/// under this force per unit thickness (Johnson 1985, Eq. 5.56 and 5.57; strain below 0.3) [N/m].
double johnson_modulus(double force, double strain, double radius);

}  // namespace softgrain::bpm
