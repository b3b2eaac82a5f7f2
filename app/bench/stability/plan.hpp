#pragma once
// What `softgrain bench stability` runs, from a TOML file (bench/stability/README.md).
#include <filesystem>
#include <vector>

#include "app/bench/stability/extremes.hpp"
#include "app/bench/stability/long_runs.hpp"
#include "app/bench/stability/random_runs.hpp"
#include "app/bench/stability/step_map.hpp"

namespace softgrain::bench {

struct StabilityPlan {
    RandomPlan random;
    ExtremesPlan extremes;
    std::vector<MapPlan> maps;
    std::vector<LongPlan> long_runs;
};

/// Paths in it are looked up from its folder. Throws InputError: a line for each error, with place.
StabilityPlan read_stability_plan(const std::filesystem::path& path);

}  // namespace softgrain::bench
