#pragma once
// How normal forces are distributed, read from measures/forces_*.csv of each run.
#include <filesystem>
#include <string>
#include <vector>

#include "app/comparison_table.hpp"

namespace softgrain::report {

/// Probability density of a run's frame.
struct ForceFrame {
    double packing_fraction;
    std::vector<double> force;    ///< / mean, middle of each bin
    std::vector<double> density;  ///< nan where no force lies
};

/// The frame of a run whose packing fraction is nearest, of those with forces; none without any. Bins are
/// made as wide as the number of contacts asks for.
std::optional<ForceFrame> force_frame(const MethodResult& result, const std::filesystem::path& folder,
                                      double packing_fraction);

/// Plots at the last packing fraction that all runs reach, and at the end of each run if some end earlier; as
/// HTML. `folder` is that of the comparison.
std::string force_section(const std::vector<MethodResult>& results, const std::filesystem::path& folder);

}  // namespace softgrain::report
