#pragma once
// Runs the peers of a plan in turns: all of them once, then all again.
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/peers/peer_plan.hpp"

namespace softgrain::bench {

/// One row that a peer's program printed.
struct PeerTime {
    std::string title;    ///< "friction 0.5, shear 1, threads 2"
    double ours, theirs;  ///< [s]
};

/// A peer in one case, over all repeats.
struct PeerRow {
    const Peer* of;
    std::string title;
    std::string version;  ///< of the peer's package; empty if unknown
    std::vector<double> ours, theirs;

    double our_time() const;    ///< median [s]
    double their_time() const;  ///< median [s]
    /// Theirs / ours: median of the repeats, least and largest.
    double ratio() const;
    double least_ratio() const;
    double largest_ratio() const;
};

struct PeerResults {
    std::vector<PeerRow> rows;          ///< in the order of the plan
    std::vector<std::string> left_out;  ///< a line for each peer that is missing or failed
};

/// The rows below the last header line that has all columns of the peer. Throws InputError if there are none
/// or a time is no number > 0.
std::vector<PeerTime> read_peer_times(const Peer& peer, const std::string& printed);

/// What a peer lacks: "lmp is missing: apt install lammps".
std::optional<std::string> missing(const Peer& peer);

/// Prints a line for each run and for each peer that is left out. Ends early once stop_signal() is set.
PeerResults run_peers(const PeerPlan& plan, int repeats);

}  // namespace softgrain::bench
