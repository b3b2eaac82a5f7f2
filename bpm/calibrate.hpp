#pragma once
// The attraction, or the bonds, that give grains of a scenario a wanted strength: found by compressing single
// grains.
#include <cstdint>
#include <string_view>
#include <vector>

#include "bpm/grain_compression.hpp"

namespace softgrain::bpm {

enum class GrainProperty { plateau, modulus };

/// Of independent values.
struct Sample {
    int count = 0;
    double mean = 0.0, deviation = 0.0;

    double standard_error() const;
};
Sample sample_of(const std::vector<double>& values);

struct Calibration {
    double asked = 0.0;    ///< [N/m]
    std::string_view key;  ///< attraction_stress (`F0/<a0>`), or bond_stiffness of elastic grains
    double value = 0.0;    ///< of the key, found [N/m]
    Sample measured;       ///< property / value, seeds 1 to n
    Sample reached;        ///< property with the value found [N/m], seeds n + 1 to 2n
    std::vector<std::uint64_t> check_seeds;
    std::vector<CompressionCurve> check_curves;  ///< one for each of them
    int discs = 0;                               ///< of a grain
};

/// All forces scale with the key, so one measurement with any value gives the one wanted; it is then checked
/// with other grains. Brittle grains, and a plateau of elastic ones, are refused. radius [m]; asked [N/m] >
/// 0; seeds >= 2. Throws InputError, DivergedError.
Calibration calibrate(const Scenario& scenario, double radius, GrainProperty property, double asked,
                      int seeds);

}  // namespace softgrain::bpm
