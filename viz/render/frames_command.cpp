#include "viz/render/frames_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/render/graphics.hpp"
#include "viz/render/run_list.hpp"
#include "viz/render/run_reader.hpp"

namespace softgrain {
namespace {

constexpr int default_width = 1600;  ///< [pixels]

std::string file_label(const std::string& label) {
    std::string safe = label;
    for (char& c : safe)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_') c = '_';
    return safe;
}

void check(const FramesRequest& request) {
    if (request.runs.empty()) throw InputError("at least one --run LABEL=RUN_DIR is needed");
    if (request.at.empty() == request.at_packing_fraction.empty())
        throw InputError("give either --at or --at-phi");
    for (const double at : request.at)
        if (!(at >= 0.0 && at <= 1.0)) throw InputError(fmt::format("--at {}: must be 0 to 1", at));
    for (const double at : request.at_packing_fraction)
        if (!(at > 0.0 && at < 2.0)) throw InputError(fmt::format("--at-phi {}: must be 0 to 2", at));
    check_style(request.style);
}

std::string stage_label(const FramesRequest& request, std::size_t stage) {
    if (!request.at_packing_fraction.empty())
        return fmt::format("packing fraction {}", request.at_packing_fraction[stage]);
    const double at = request.at[stage];
    return at == 0.0 ? "start" : at == 1.0 ? "end" : fmt::format("{:.3g} % of the loading", 100.0 * at);
}

/// All frames of all runs [runs][stages].
std::vector<std::vector<Frame>> read_frames(const FramesRequest& request,
                                            const std::vector<RunReader>& runs) {
    std::vector<std::vector<Frame>> frames;
    for (const RunReader& run : runs) {
        auto& row = frames.emplace_back();
        for (const double at : request.at)
            row.push_back(run.read(run.frame_at_fraction(at), request.style.parts));
        for (const double at : request.at_packing_fraction)
            row.push_back(run.read(run.frame_at_packing_fraction(at), request.style.parts));
    }
    return frames;
}

}  // namespace

void draw_frames(const FramesRequest& request) {
    check(request);
    std::vector<RunReader> runs;
    std::set<std::string> labels;
    for (const std::string& text : request.runs) {
        const NamedRun run = labelled_run(text, "--run");
        if (!labels.insert(file_label(run.label)).second)
            throw InputError(fmt::format("--run: the label '{}' is given twice", run.label));
        runs.emplace_back(run.label, run.folder);
    }
    const auto frames = read_frames(request, runs);
    ScaleGatherer gatherer(request.style);
    for (std::size_t r = 0; r < runs.size(); ++r)
        for (const Frame& frame : frames[r]) gatherer.add(frame, runs[r].label());
    const SheetScale scale = gatherer.scale();
    const int width = request.style.width == 0 ? default_width : request.style.width;
    make_directories(request.out);
    const auto graphics = open_graphics();
    Sheet all;
    for (std::size_t s = 0; s < frames[0].size(); ++s) all.column_labels.push_back(stage_label(request, s));
    for (std::size_t r = 0; r < runs.size(); ++r) {
        all.row_labels.push_back(runs[r].label());
        auto& row = all.cells.emplace_back();
        for (std::size_t s = 0; s < frames[r].size(); ++s) {
            row.push_back({&frames[r][s], "", ""});
            Sheet one;
            one.heading = runs[r].label();  // the caption has the stage, as it was reached
            one.cells = {{row.back()}};
            const auto image = lay_out_sheet(one, scale, width).draw(*graphics);
            write_png(request.out / fmt::format("{}_{}.png", file_label(runs[r].label()), s + 1), *image);
        }
    }
    if (runs.size() == 1 && frames[0].size() == 1) {
        all.heading = runs[0].label();
        all.row_labels.clear();
        all.column_labels.clear();
    }
    write_png(request.out / "sheet.png", *lay_out_sheet(all, scale, width).draw(*graphics));
}

}  // namespace softgrain
