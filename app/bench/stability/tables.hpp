#pragma once
// CSV files and stability.md.
#include <string>
#include <vector>

#include "app/bench/stability/extremes.hpp"
#include "app/bench/stability/long_runs.hpp"
#include "app/bench/stability/random_runs.hpp"
#include "app/bench/stability/step_map.hpp"

namespace softgrain::bench {

/// All that was run; parts that were not are empty.
struct StabilityResults {
    std::vector<MapRow> map;
    std::vector<LongRow> long_runs;
    std::vector<ExtremeRow> extremes;
    std::vector<RandomRow> random;
};

/// Runs that failed in a way that none may.
std::size_t failures_of(const StabilityResults& results);

/// Each begins with a comment line: program, commit, compiler, machine, date.
std::string map_csv(const std::vector<MapRow>& rows);
std::string long_csv(const std::vector<LongRow>& rows);
std::string extremes_csv(const std::vector<ExtremeRow>& rows);
std::string random_csv(const std::vector<RandomRow>& rows);

/// Ratios first, then a table for each part.
std::string stability_markdown(const StabilityResults& results);

}  // namespace softgrain::bench
