#pragma once
// Stress probing: one probe in each of several directions, all from one saved state.
#include <filesystem>
#include <string>
#include <vector>

#include "common/scenario.hpp"

namespace softgrain {

struct ProbeFanRequest {
    const Scenario& scenario;  ///< its last stage is the probe; its direction is replaced
    std::vector<std::string> methods;
    std::filesystem::path folder;
    int directions = 12;
    int threads = 1;
    bool resume = false;
    bool force = false;
    bool pictures = true;
    bool quiet = false;
};

/// Runs the stages before the probe into `folder/<method>/state/`, then every probe from its end into
/// `folder/<method>/probe_<degrees>/`. Writes response.csv and the response envelopes, response.png. Returns
/// the exit code as compare() does. Throws InputError if the last stage is no probe.
int probe_fan(const ProbeFanRequest& request);

}  // namespace softgrain
