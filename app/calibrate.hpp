#pragma once
// Command `calibrate`: the attraction that gives the aggregates of a scenario a wanted strength.
#include <filesystem>
#include <optional>
#include <string>

#include "bpm/calibrate.hpp"
#include "common/scenario.hpp"

namespace softgrain {

struct CalibrateRequest {
    const Scenario& scenario;
    bpm::GrainProperty property = bpm::GrainProperty::plateau;
    double asked = 0.0;  ///< [N/m]
    int seeds = 5;
    int threads = 1;
    std::filesystem::path curve;  ///< CSV of the curves that the check gave; empty for none
};

/// Prints what was found and how well it does. Returns the exit code.
int calibrate(const CalibrateRequest& request);

/// "asked 0.05 N/m, reached 0.0497 +- 0.0012 N/m (5 grains)".
std::string reached_text(const bpm::Calibration& calibration);

/// The yield stress that `compare --calibrate` gives to aggregates: material.yield_stress, or 0.05 E.
double comparable_yield_stress(const Material& material);

/// The scenario with bpm.attraction_stress so that its aggregates yield at comparable_yield_stress(), and
/// what says so. Throws InputError if the scenario gives bpm.attraction_stress already.
struct CalibratedScenario {
    Scenario scenario;
    std::string said;
};
CalibratedScenario with_calibrated_aggregates(const Scenario& scenario, double mean_radius, int threads);

}  // namespace softgrain
