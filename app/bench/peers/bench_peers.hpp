#pragma once
// `softgrain bench peers`: other programs beside ours, as far as they are there.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

struct PeersRequest {
    std::filesystem::path plan;
    std::vector<std::string> peers;  ///< names; empty for all
    int repeats = 3;
    std::filesystem::path folder;
    bool force = false;  ///< replace results that are there
};

/// Writes peers.csv, peers.md and peers.svg into the folder. A peer that is missing or fails is a line with
/// its reason. Returns the exit code: 0, or 130 or 143 if stopped, without results then. Throws InputError
/// and OutputError.
int bench_peers(const PeersRequest& request);

}  // namespace softgrain::bench
