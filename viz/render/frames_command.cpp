#include "viz/render/frames_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/render/graphics.hpp"
#include "viz/render/run_reader.hpp"
#include "viz/render/sheet.hpp"

namespace softgrain {
namespace {

constexpr double rounding = 1e-9;  ///< of a mean stress, times the largest one
constexpr double strong_grain_force = 0.98, strong_part_force = 0.995;  ///< percentile of the widest line
constexpr double widest_grain_line = 0.12, widest_part_line = 0.45;     ///< times the mean diameter

RunReader open_run(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
        throw InputError(fmt::format("--run '{}': must be LABEL=RUN_DIR", text));
    return RunReader(text.substr(0, equals), text.substr(equals + 1));
}

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
    if (!request.range.empty() && !(request.range[0] < request.range[1]))
        throw InputError("--range: min must be less than max");
    if (!request.window.empty()) {
        const auto& w = request.window;
        if (!(w[0] >= 0.0 && w[0] < w[1] && w[1] <= 1.0 && w[2] >= 0.0 && w[2] < w[3] && w[3] <= 1.0))
            throw InputError("--window: must be left < right and bottom < top, each 0 to 1");
    }
    if (request.width < 400 || request.width > 8000) throw InputError("--width: must be 400 to 8000 pixels");
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
        for (const double at : request.at) row.push_back(run.read(run.frame_at_fraction(at), request.parts));
        for (const double at : request.at_packing_fraction)
            row.push_back(run.read(run.frame_at_packing_fraction(at), request.parts));
    }
    return frames;
}

/// Forces of grains, or of parts, in all frames that draw them.
ForceScale force_scale(const std::vector<std::vector<Frame>>& frames, bool of_parts) {
    std::vector<double> forces;
    double diameter = 0.0, count = 0.0;
    for (const auto& row : frames)
        for (const Frame& frame : row) {
            if ((frame.parts != nullptr) != of_parts || drawn_contacts(frame) == nullptr) continue;
            const auto of_frame = cell_scalars(*drawn_contacts(frame), "normal_force");
            forces.insert(forces.end(), of_frame.begin(), of_frame.end());
            diameter += of_parts ? mean_part_diameter(frame) : mean_diameter(frame);
            count += 1.0;
        }
    if (count == 0.0) return {};
    return {percentile(forces, of_parts ? strong_part_force : strong_grain_force),
            (of_parts ? widest_part_line : widest_grain_line) * diameter / count};
}

SheetScale common_scale(const FramesRequest& request, const std::vector<std::vector<Frame>>& frames) {
    std::vector<double> values;
    SheetScale scale;
    scale.field = request.field;
    scale.unit = field_unit(frames[0][0], request.field);
    scale.grain_forces = force_scale(frames, false);
    scale.part_forces = force_scale(frames, true);
    if (!request.window.empty())
        scale.window = {{request.window[0], request.window[2]}, {request.window[1], request.window[3]}};
    for (const auto& row : frames)
        for (const Frame& frame : row) {
            const auto of_field = field_values(frame, request.field);
            values.insert(values.end(), of_field.begin(), of_field.end());
            scale.extent = scale.extent.cwiseMax(shown_extent(frame, scale.window).size());
            if (std::isfinite(frame.mean_stress))
                scale.no_stress = std::max(scale.no_stress, rounding * std::abs(frame.mean_stress));
        }
    scale.colours = request.range.empty() ? robust_range(values)
                                          : given_range(values, request.range[0], request.range[1]);
    if (!(scale.extent.minCoeff() > 0.0)) throw InputError("the frames have no grains");
    return scale;
}

}  // namespace

void draw_frames(const FramesRequest& request) {
    check(request);
    std::vector<RunReader> runs;
    std::set<std::string> labels;
    for (const std::string& text : request.runs) {
        runs.push_back(open_run(text));
        if (!labels.insert(file_label(runs.back().label())).second)
            throw InputError(fmt::format("--run: the label '{}' is given twice", runs.back().label()));
    }
    const auto frames = read_frames(request, runs);
    const SheetScale scale = common_scale(request, frames);
    make_directories(request.out);
    const auto graphics = open_graphics();
    Sheet all;
    for (std::size_t s = 0; s < frames[0].size(); ++s) all.column_labels.push_back(stage_label(request, s));
    for (std::size_t r = 0; r < runs.size(); ++r) {
        all.row_labels.push_back(runs[r].label());
        auto& row = all.frames.emplace_back();
        for (std::size_t s = 0; s < frames[r].size(); ++s) {
            row.push_back(&frames[r][s]);
            const Sheet one{{runs[r].label()}, {all.column_labels[s]}, {{&frames[r][s]}}};
            const auto image = lay_out_sheet(one, scale, request.width).draw(*graphics);
            write_png(request.out / fmt::format("{}_{}.png", file_label(runs[r].label()), s + 1), *image);
        }
    }
    write_png(request.out / "sheet.png", *lay_out_sheet(all, scale, request.width).draw(*graphics));
}

}  // namespace softgrain
