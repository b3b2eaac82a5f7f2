#pragma once
// peers.csv, peers.md and the plot of peers.
#include <optional>
#include <string>

#include "app/bench/peers/peer_run.hpp"
#include "viz/plot_spec.hpp"

namespace softgrain::bench {

/// One row for each peer and case.
std::string peers_csv(const PeerResults& results);

/// Ratios first: a table of the peers, how many times as long as ours each takes at least and at most over
/// its cases; then all cases; then who is not there.
std::string peers_markdown(const PeerResults& results);

/// A bar for each case, from 1 (ours) to how many times as long the peer takes, logarithmic. None without
/// rows.
std::optional<PlotSpec> peers_plot(const PeerResults& results);

}  // namespace softgrain::bench
