#pragma once
// The main job: one packing, several methods, curves and pictures side by side.
#include <filesystem>
#include <string>
#include <vector>

#include "common/scenario.hpp"

namespace softgrain {

struct CompareRequest {
    const Scenario& scenario;
    std::vector<std::string> methods;
    std::filesystem::path folder;
    std::filesystem::path
        reference;           ///< CSV with packing_fraction, mean_stress, coordination_number; empty for none
    std::vector<double> at;  ///< packing fractions of the table; empty lets the program choose
    int threads = 1;
    bool calibrate = false;  ///< give the aggregates of bpm the yield stress of the material
    bool resume = false;
    bool force = false;
    bool pictures = true;  ///< PNG files, and pictures in the report
    bool quiet = false;
};

/// Runs every method into `folder/<method>/` and writes initial_packing.csv, comparison.md, comparison.csv,
/// plots, pictures and report.html. Returns the exit code: 0, 3 if a method diverged, 130 or 143 if stopped.
int compare(const CompareRequest& request);

}  // namespace softgrain
