#include "app/bench/peers/peer_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "app/bench/plan_reader.hpp"
#include "app/bench/rows.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "viz/run_program.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

fs::path own_program() {
    return fs::read_symlink("/proc/self/exe");
}

/// Beside softgrain, or on $PATH; empty if neither.
fs::path find_program(const std::string& name) {
    const fs::path beside = own_program().parent_path() / name;
    return fs::exists(beside) ? beside : find_on_path(name);
}

std::vector<std::string> command_of(const Peer& peer, const fs::path& folder) {
    const fs::path script = folder / peer.program;
    std::vector<std::string> command{fs::exists(script) ? fs::absolute(script).string()
                                                        : find_program(peer.program).string()};
    for (const std::string& word : peer.arguments)
        command.push_back(word == "SOFTGRAIN" ? own_program().string()
                          : word == "BUILD"   ? own_program().parent_path().parent_path().string()
                                              : word);
    return command;
}

std::string version_of(const Peer& peer) {
    const fs::path query = find_on_path("dpkg-query");
    if (peer.package.empty() || query.empty()) return "";
    const ChildEnd end =
        run_child({query.string(), "-W", "-f", "${Version}", peer.package}, ChildOutput::read);
    return end.exit_code == 0 ? end.messages : "";
}

std::vector<std::string> cells_of(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream words(line);
    for (std::string cell; std::getline(words, cell, ',');) cells.push_back(trimmed(cell));
    return cells;
}

std::size_t column(const std::vector<std::string>& header, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(header, name) - header.begin());
}

bool has_columns(const std::vector<std::string>& header, const Peer& peer) {
    std::vector<std::string> all = peer.case_columns;
    all.insert(all.end(), {peer.ours, peer.theirs});
    return std::ranges::all_of(all,
                               [&](const std::string& name) { return column(header, name) < header.size(); });
}

double seconds_in(const Peer& peer, const std::string& cell) {
    double value = 0.0;
    const auto [stop, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || stop != cell.data() + cell.size() || !(value > 0.0))
        throw InputError(fmt::format("{}: \"{}\" is no time > 0", peer.name, cell));
    return value;
}

PeerRow& row_of(PeerResults& results, const Peer& peer, const std::string& title) {
    const auto at = std::ranges::find_if(
        results.rows, [&](const PeerRow& row) { return row.of == &peer && row.title == title; });
    if (at != results.rows.end()) return *at;
    return results.rows.emplace_back(PeerRow{&peer, title, version_of(peer), {}, {}});
}

std::vector<double> ratios_of(const PeerRow& row) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < row.ours.size(); ++k) ratios.push_back(row.theirs[k] / row.ours[k]);
    return ratios;
}

}  // namespace

double PeerRow::our_time() const {
    return median(ours);
}
double PeerRow::their_time() const {
    return median(theirs);
}
double PeerRow::ratio() const {
    return median(ratios_of(*this));
}
double PeerRow::least_ratio() const {
    return std::ranges::min(ratios_of(*this));
}
double PeerRow::largest_ratio() const {
    return std::ranges::max(ratios_of(*this));
}

std::vector<PeerTime> read_peer_times(const Peer& peer, const std::string& printed) {
    std::vector<PeerTime> times;
    std::vector<std::string> header;
    std::istringstream lines(printed);
    for (std::string line; std::getline(lines, line);) {
        const std::vector<std::string> cells = cells_of(line);
        if (has_columns(cells, peer)) {
            header = cells;
            times.clear();
        } else if (!header.empty() && cells.size() == header.size()) {
            std::string title;
            for (const std::string& name : peer.case_columns)
                title += fmt::format("{}{} {}", title.empty() ? "" : ", ", name, cells[column(header, name)]);
            times.push_back({title, seconds_in(peer, cells[column(header, peer.ours)]),
                             seconds_in(peer, cells[column(header, peer.theirs)])});
        }
    }
    if (times.empty())
        throw InputError(fmt::format("{}: its program printed no rows with the columns {}, {}, {}", peer.name,
                                     fmt::join(peer.case_columns, ", "), peer.ours, peer.theirs));
    return times;
}

std::optional<std::string> missing(const Peer& peer) {
    for (const Needed& one : peer.needs)
        if (find_program(one.program).empty()) return fmt::format("{} is missing: {}", one.program, one.cure);
    return std::nullopt;
}

PeerResults run_peers(const PeerPlan& plan, int repeats) {
    PeerResults results;
    std::map<const Peer*, std::string> out;
    const auto leave_out = [&](const Peer& peer, const std::string& reason) {
        out.emplace(&peer, reason);
        results.left_out.push_back(fmt::format("{}: left out, {}", peer.name, reason));
        fmt::print("{}\n", results.left_out.back());
        std::fflush(stdout);
    };
    for (const Peer& peer : plan.peers)
        if (const auto reason = missing(peer)) leave_out(peer, *reason);
    for (int repeat = 1; repeat <= repeats; ++repeat)
        for (const Peer& peer : plan.peers) {
            if (stop_signal() != 0) return results;
            if (out.contains(&peer)) continue;
            const double begin = wall_clock();
            try {
                const auto command = command_of(peer, plan.source.parent_path());
                const ChildEnd end = run_child(command, ChildOutput::read);
                if (const auto failure = failure_of(end, command[0]))
                    throw InputError(failure->substr(failure->rfind('\n') + 1));
                for (const PeerTime& one : read_peer_times(peer, end.messages)) {
                    PeerRow& row = row_of(results, peer, one.title);
                    row.ours.push_back(one.ours);
                    row.theirs.push_back(one.theirs);
                }
            } catch (const InputError& error) {
                leave_out(peer, error.what());
                continue;
            }
            fmt::print("{}/{} {}: {:.1f} s\n", repeat, repeats, peer.name, wall_clock() - begin);
            std::fflush(stdout);
        }
    return results;
}

}  // namespace softgrain::bench
