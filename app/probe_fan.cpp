#include "app/probe_fan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/methods.hpp"
#include "app/run_folder.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/folder_lock.hpp"
#include "common/io/history_csv.hpp"
#include "common/packing/make_packing.hpp"
#include "common/run_state.hpp"
#include "viz/client.hpp"

namespace softgrain {
namespace {

/// What one probe changed; compression positive.
struct Response {
    double direction;             ///< [degrees]
    double strain_xx, strain_yy;  ///< since the saved state
    double stress_xx, stress_yy;  ///< [N/m]
};

struct Fan {
    std::string method;
    std::vector<Response> responses;  ///< by direction
};

double change(const History& history, std::string_view column) {
    const std::vector<double>& values = history.column(column);
    return values.back() - values.front();
}

Response read_response(const std::filesystem::path& folder, double direction) {
    const History history = read_history(folder / "history.csv");
    return {direction, change(history, "strain_xx"), change(history, "strain_yy"),
            change(history, "stress_xx"), change(history, "stress_yy")};
}

std::string table_of(const std::vector<Fan>& fans) {
    std::string text = "method,direction,strain_xx,strain_yy,stress_xx,stress_yy\n";
    for (const Fan& fan : fans)
        for (const Response& r : fan.responses)
            text += fmt::format("{},{:g},{:.8g},{:.8g},{:.8g},{:.8g}\n", fan.method, r.direction, r.strain_xx,
                                r.strain_yy, r.stress_xx, r.stress_yy);
    return text;
}

/// A closed curve for each method, in a square picture with equal axes.
PlotSpec envelope_plot(const std::string& title, const std::vector<Fan>& fans, bool by_stress) {
    PlotSpec plot;
    plot.title = title;
    plot.x.label = by_stress ? "strain_xx since the state" : "stress_xx since the state [N/m]";
    plot.y.label = by_stress ? "strain_yy since the state" : "stress_yy since the state [N/m]";
    plot.width = plot.height = 1200;
    double farthest = 0.0;
    for (const Fan& fan : fans) {
        PlotSeries series;
        series.label = fan.method;
        series.marker = MarkerStyle::circle;
        const std::size_t n = fan.responses.size();
        for (std::size_t k = 0; n > 0 && k <= n; ++k) {  // back to the first
            const Response& r = fan.responses[k % n];
            const double x = by_stress ? r.strain_xx : r.stress_xx, y = by_stress ? r.strain_yy : r.stress_yy;
            series.x.push_back(x);
            series.y.push_back(y);
            farthest = std::max({farthest, std::abs(x), std::abs(y)});
        }
        if (n > 0) plot.series.push_back(std::move(series));
    }
    plot.x.min = plot.y.min = -1.1 * farthest;
    plot.x.max = plot.y.max = 1.1 * farthest;
    return plot;
}

}  // namespace

int probe_fan(const ProbeFanRequest& request) {
    const Scenario& scenario = request.scenario;
    if (scenario.loading.size() < 2 || scenario.loading.back().kind != LoadingKind::probe)
        throw InputError(
            fmt::format("{}: a fan needs stages that lead to a state, and then, as the last [[loading]], "
                        "one with kind = \"probe\"",
                        scenario.source.string()));
    std::vector<const Method*> chosen;
    for (const std::string& name : request.methods) chosen.push_back(&find_method(name));
    const bool by_stress = scenario.loading.back().seeks_stress();
    Scenario before = scenario;
    before.loading.pop_back();

    make_directories(request.folder);
    const FolderLock lock(request.folder);
    const Packing packing = make_packing(scenario);
    std::vector<Fan> fans;
    int worst = 0;
    for (const Method* method : chosen) {
        const std::string name(method->name);
        const auto folder = request.folder / name;
        const auto run = [&](const Scenario& own, const std::string& part,
                             const std::filesystem::path& from) {
            const RunReport report = run_into_folder({.scenario = own,
                                                      .packing = packing,
                                                      .method = *method,
                                                      .folder = folder / part,
                                                      .from = from,
                                                      .threads = request.threads,
                                                      .resume = request.resume,
                                                      .force = request.force,
                                                      .quiet = request.quiet});
            fmt::print("{} {}: {}, {:.1f} s\n", name, part, report.ended, report.wall_time);
            worst = std::max(worst, report.exit_code);
            return report;
        };
        fans.push_back({name, {}});
        const RunReport state = run(before, "state", {});
        if (state.exit_code >= 128) return state.exit_code;
        if (state.ended != ended_in_order) continue;
        for (int k = 0; k < request.directions; ++k) {
            Scenario own = scenario;
            const double direction = 360.0 * k / request.directions;
            own.loading.back().direction = direction;
            const std::string part = fmt::format("probe_{:05.1f}", direction);
            const RunReport probe = run(own, part, folder / "state");
            if (probe.exit_code >= 128) return probe.exit_code;
            if (probe.ended == ended_in_order)
                fans.back().responses.push_back(read_response(folder / part, direction));
        }
    }
    write_file_atomically(request.folder / "response.csv", table_of(fans));
    if (request.pictures)
        if (const auto failed =
                render_plot(envelope_plot(scenario.title, fans, by_stress), request.folder / "response.png"))
            fmt::print(stderr, "no picture: {}\n", *failed);
    return worst;
}

}  // namespace softgrain
