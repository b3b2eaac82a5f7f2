#include "app/bench/peers/peer_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/plots.hpp"
#include "app/bench/words.hpp"
#include "app/markdown_table.hpp"
#include "app/process.hpp"
#include "app/report/words.hpp"
#include "version.hpp"

namespace softgrain::bench {
namespace {

/// The rows of each peer, in their order.
std::vector<std::vector<const PeerRow*>> by_peer(const PeerResults& results) {
    std::vector<std::vector<const PeerRow*>> all;
    for (const PeerRow& row : results.rows) {
        const auto at =
            std::ranges::find_if(all, [&](const auto& rows) { return rows.front()->of == row.of; });
        if (at == all.end())
            all.push_back({&row});
        else
            at->push_back(&row);
    }
    return all;
}

std::string summary(const PeerResults& results) {
    std::vector<std::vector<std::string>> table{
        {"peer", "takes times ours, least", "most", "ours", "measured", "version"}};
    for (const auto& rows : by_peer(results)) {
        const auto [least, most] =
            std::ranges::minmax(rows, {}, [](const PeerRow* row) { return row->ratio(); });
        const Peer& peer = *rows.front()->of;
        table.push_back({peer.name, two_digits(least->ratio()), two_digits(most->ratio()), peer.method,
                         peer.what, rows.front()->version.empty() ? "-" : rows.front()->version});
    }
    return markdown_table(table);
}

std::string all_cases(const PeerResults& results) {
    std::vector<std::vector<std::string>> table{
        {"peer", "number", "case", "takes times ours", "of the repeats", "ours [s]", "peer [s]"}};
    for (const auto& rows : by_peer(results))
        for (const PeerRow* row : rows)
            table.push_back(
                {row->of->name, std::to_string(table.size()), row->title, two_digits(row->ratio()),
                 fmt::format("{} to {}", two_digits(row->least_ratio()), two_digits(row->largest_ratio())),
                 fmt::format("{:.3g}", row->our_time()), fmt::format("{:.3g}", row->their_time())});
    return markdown_table(table);
}

std::size_t repeats_of(const PeerResults& results) {
    std::size_t repeats = 0;
    for (const PeerRow& row : results.rows) repeats = std::max(repeats, row.ours.size());
    return repeats;
}

}  // namespace

std::string peers_csv(const PeerResults& results) {
    std::string text =
        "peer,peer_version,method,case,measured,ours_seconds,peer_seconds,ratio,least_ratio,largest_ratio,"
        "repeats,"
        "machine,compiler,version,commit,date\n";
    for (const PeerRow& row : results.rows)
        text += fmt::format("{},{},{},{},{},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{},{},{},{},{},{}\n",
                            quoted(row.of->name), quoted(row.version), row.of->method, quoted(row.title),
                            quoted(row.of->what), row.our_time(), row.their_time(), row.ratio(),
                            row.least_ratio(), row.largest_ratio(), row.ours.size(), quoted(processor_name()),
                            quoted(compiler), version, commit, date_and_time());
    return text;
}

std::string peers_markdown(const PeerResults& results) {
    std::string text = fmt::format(
        "# Peers\n\n{}, {}; softgrain {} ({}), {}. Times are medians of {}, in turns; a ratio is the median "
        "of the "
        "turns' ratios, each of one run after the other.\n\n",
        processor_name(), date_and_time(), version, commit, compiler, repeats_of(results));
    if (!results.rows.empty())
        text += fmt::format("{}\n## All cases\n\n{}\n", summary(results), all_cases(results));
    for (const std::string& line : results.left_out) text += fmt::format("- {}\n", line);
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

std::optional<PlotSpec> peers_plot(const PeerResults& results) {
    if (results.rows.empty()) return std::nullopt;
    PlotSpec plot;
    plot.title = "Peers beside softgrain";
    plot.x = {"number of the case", false, 0.0, static_cast<double>(results.rows.size()) + 1.0};
    plot.y = {"CPU time / that of softgrain", true, {}, {}};
    plot.legend = "right";
    plot.width = 2200;
    double number = 0.0, least = 1.0, most = 1.0;
    int colour = 0;
    for (const auto& rows : by_peer(results)) {
        for (const PeerRow* row : rows) {
            number += 1.0;
            PlotSeries bar;
            bar.label = row == rows.front() ? row->of->name : "";
            bar.x = {number, number};
            bar.y = {1.0, row->ratio()};
            bar.width = 6.0;
            bar.colour = colour;
            plot.series.push_back(std::move(bar));
            least = std::min(least, row->ratio());
            most = std::max(most, row->ratio());
        }
        colour += colour + 1 == black ? 2 : 1;
    }
    PlotSeries ours;
    ours.label = "softgrain";
    ours.x = {0.0, number + 1.0};
    ours.y = {1.0, 1.0};
    ours.colour = black;
    plot.series.push_back(std::move(ours));
    plot.y.min = least / 1.5, plot.y.max = most * 1.5;
    return plot;
}

}  // namespace softgrain::bench
