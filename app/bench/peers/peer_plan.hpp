#pragma once
// What `softgrain bench peers` runs (bench/peers/README.md).
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

/// A program that must be there, and how it gets there.
struct Needed {
    std::string program, cure;
};

/// A measurement of another program beside ours.
struct Peer {
    std::string name, method, what;      ///< `what` is measured: "CPU time of the loop"
    std::string program;                 ///< beside the plan, or beside softgrain
    std::vector<std::string> arguments;  ///< SOFTGRAIN and BUILD stand for this program and its build folder
    std::vector<Needed> needs;
    std::string package;                    ///< Debian's, whose version is told
    std::vector<std::string> case_columns;  ///< of the CSV that it prints: what tells its rows apart
    std::string ours, theirs;               ///< columns of seconds
};

struct PeerPlan {
    std::filesystem::path source;
    std::vector<Peer> peers;
};

/// Throws InputError: a line for each error, with place.
PeerPlan read_peer_plan(const std::filesystem::path& path);

}  // namespace softgrain::bench
