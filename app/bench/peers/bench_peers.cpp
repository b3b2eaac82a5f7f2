#include "app/bench/peers/bench_peers.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/peers/peer_tables.hpp"
#include "app/bench/results_folder.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain::bench {

int bench_peers(const PeersRequest& request) {
    PeerPlan plan = read_peer_plan(request.plan);
    std::vector<std::string> names;
    for (const Peer& one : plan.peers) names.push_back(one.name);
    for (const std::string& name : request.peers)
        if (std::ranges::find(names, name) == names.end())
            throw InputError(fmt::format("--peer {}: {} has no such peer, it has {}", name,
                                         plan.source.string(), fmt::join(names, ", ")));
    std::erase_if(plan.peers, [&](const Peer& one) {
        return !request.peers.empty() && std::ranges::find(request.peers, one.name) == request.peers.end();
    });
    refuse_to_replace(request.folder / "peers.csv", request.force);
    make_directories(request.folder);
    const PeerResults results = run_peers(plan, request.repeats);
    if (stop_signal() != 0) {
        fmt::print(stderr, "stopped by a signal, without results\n");
        return 128 + stop_signal();
    }
    const std::string tables = peers_markdown(results);
    write_file_atomically(request.folder / "peers.csv", peers_csv(results));
    write_file_atomically(request.folder / "peers.md", tables);
    if (const auto plot = peers_plot(results)) draw(*plot, request.folder, "peers");
    fmt::print("\n{}\nResults in {}\n", tables, request.folder.string());
    return 0;
}

}  // namespace softgrain::bench
