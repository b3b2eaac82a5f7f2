#include "app/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/calibrate.hpp"
#include "app/comparison_table.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "app/report/curves.hpp"
#include "app/report/page.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/folder_lock.hpp"
#include "common/io/scenario_file.hpp"
#include "common/packing/make_packing.hpp"
#include "common/packing/packing_csv.hpp"
#include "viz/client.hpp"
#include "viz/paraview/view_script.hpp"

namespace softgrain {
namespace {

constexpr int table_columns = 7;
constexpr const char* page_name = "report.html";
constexpr std::size_t most_picture_bytes = 4'200'000;  ///< in the page, where they take a third more

/// A method whose run is over already is not run again by --resume.
std::optional<RunReport> finished_run(const std::filesystem::path& folder) {
    if (!std::filesystem::exists(folder / "run.json")) return std::nullopt;
    const RunReport report = read_report(folder);
    return report.exit_code == 0 ? std::optional(report) : std::nullopt;
}

MethodResult run_one(const CompareRequest& request, const Scenario& scenario, const Packing& packing,
                     const Method& method) {
    const auto folder = request.folder / method.name;
    MethodResult result;
    if (const auto done = request.resume ? finished_run(folder) : std::nullopt) {
        result.report = *done;
    } else {
        result.report = run_into_folder({.scenario = scenario,
                                         .packing = packing,
                                         .method = method,
                                         .folder = folder,
                                         .threads = request.threads,
                                         .resume = request.resume,
                                         .force = request.force,
                                         .quiet = request.quiet,
                                         .measures = {"forces"}});
    }
    if (result.report.steps > 0) result.history = read_history(folder / "history.csv");
    return result;
}

/// Plots and pictures; a comparison without them is still one, so a failure is said and not thrown.
void draw(const CompareRequest& request, const std::vector<MethodResult>& results,
          const std::optional<Reference>& reference) {
    const auto complain = [](const std::optional<std::string>& error) {
        if (error) fmt::print(stderr, "no picture: {}\n", *error);
    };
    const auto plot = [&](std::string_view column, const std::string& label, bool logarithmic,
                          const std::string& name) {
        const PlotSpec spec =
            report::curve_plot(request.scenario.title, results, reference, column, label, logarithmic);
        if (spec.series.empty()) return;
        complain(render_plot(spec, request.folder / (name + ".svg")));
        if (request.pictures) complain(render_plot(spec, request.folder / (name + ".png")));
    };
    plot("mean_stress", "mean stress [N/m]", true, "stress");
    plot("coordination_number", "coordination number Z", false, "coordination");
    if (!request.pictures) return;
    FramesSpec frames;
    for (const MethodResult& result : results)
        if (result.history)
            frames.runs.push_back({result.report.method, request.folder / result.report.method});
    if (frames.runs.empty()) return;
    const auto [low, high] = packing_fraction_range(results);
    for (const double phi : {low, 0.5 * (low + high), high})
        frames.at_packing_fraction.push_back(std::round(100.0 * phi) / 100.0);
    frames.parts = request.scenario.sampling.parts;
    frames.out = request.folder / "pictures";
    complain(render_frames(frames));
}

void write_page(const CompareRequest& request, const Packing& packing,
                const std::vector<MethodResult>& results, const std::optional<Reference>& reference,
                const std::optional<CalibratedScenario>& calibrated) {
    report::PageContent content{request.scenario, packing, request.folder, results, reference, {}, {}};
    if (calibrated) content.notes.push_back(calibrated->said);
    if (request.pictures)
        content.pictures = report::draw_pictures(results, request.folder, request.scenario.sampling.parts,
                                                 most_picture_bytes);
    write_file_atomically(request.folder / page_name, report::page(content));
}

}  // namespace

int compare(const CompareRequest& request) {
    std::vector<const Method*> chosen;
    for (const std::string& name : request.methods) chosen.push_back(&find_method(name));
    if (request.calibrate && std::ranges::find(request.methods, "bpm") == request.methods.end())
        throw InputError("--calibrate is about bpm, which is not among the methods");
    std::optional<Reference> reference;
    if (!request.reference.empty())
        reference = {request.reference.stem().string(), read_history(request.reference)};

    make_directories(request.folder);
    const FolderLock lock(request.folder);
    if (!request.resume && !request.force)
        for (const std::string& name : request.methods) refuse_to_overwrite(request.folder / name);
    write_view_script(request.folder, request.methods);
    const Packing packing = make_packing(request.scenario);
    write_packing_csv(request.folder / "initial_packing.csv", packing);
    fmt::print("{} grains, undeformed packing fraction {:.4f}, box {:.4g} x {:.4g}\n", packing.size(),
               packing.packing_fraction_undeformed(), packing.box.width(), packing.box.height());

    std::optional<CalibratedScenario> calibrated;
    if (request.calibrate) {
        calibrated = with_calibrated_aggregates(request.scenario, packing.mean_radius(), request.threads);
        fmt::print("{}\n", calibrated->said);
    }

    std::vector<MethodResult> results;
    int exit_code = 0;
    for (const Method* method : chosen) {
        const bool use_calibrated = calibrated && method->name == "bpm";
        results.push_back(
            run_one(request, use_calibrated ? calibrated->scenario : request.scenario, packing, *method));
        const RunReport& report = results.back().report;
        if (report.exit_code == 0) continue;
        fmt::print(stderr, "{}: {}\n", report.method, report.ended);
        exit_code = report.exit_code;
        if (exit_code > 128) return exit_code;
    }

    const auto phi = request.at.empty() ? packing_fractions_to_compare(results, table_columns) : request.at;
    std::string table = comparison_table(results, reference, phi);
    if (calibrated) table += fmt::format("- {}\n", calibrated->said);
    fmt::print("\n{}\n", table);
    write_file_atomically(request.folder / "comparison.md",
                          fmt::format("# {}\n\n{}", request.scenario.title, table));
    write_file_atomically(request.folder / "comparison.csv", comparison_csv(results, phi));
    draw(request, results, reference);
    write_page(request, packing, results, reference, calibrated);
    fmt::print("Results in {}, all of them in {}\n", request.folder.string(), page_name);
    return exit_code;
}

}  // namespace softgrain
