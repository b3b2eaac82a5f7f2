#include "viz/render/shared_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/errors.hpp"

namespace softgrain {
namespace {

constexpr double rounding = 1e-9;  ///< of a mean stress, times the largest one
constexpr double strong_grain_force = 0.98, strong_part_force = 0.995;  ///< percentile of the widest line
constexpr double widest_grain_line = 0.12, widest_part_line = 0.45;     ///< times the mean diameter

}  // namespace

void check_style(const DrawingStyle& style) {
    if (!style.range.empty() && !(style.range[0] < style.range[1]))
        throw InputError("--range: min must be less than max");
    if (!style.window.empty()) {
        const auto& w = style.window;
        if (!(w[0] >= 0.0 && w[0] < w[1] && w[1] <= 1.0 && w[2] >= 0.0 && w[2] < w[3] && w[3] <= 1.0))
            throw InputError("--window: must be left < right and bottom < top, each 0 to 1");
    }
    if (style.width != 0 && (style.width < 400 || style.width > 8000))
        throw InputError("--width: must be 400 to 8000 pixels");
}

ScaleGatherer::ScaleGatherer(const DrawingStyle& style) : style_(style) {
    scale_.field = style.field;
    if (!style.window.empty())
        scale_.window = {{style.window[0], style.window[2]}, {style.window[1], style.window[3]}};
}

void ScaleGatherer::add(const Frame& frame, const std::string& run) {
    try {
        const auto values = field_values(frame, style_.field);
        values_.insert(values_.end(), values.begin(), values.end());
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", run, error.what()));
    }
    if (scale_.unit.empty()) scale_.unit = field_unit(frame, style_.field);
    scale_.extent = scale_.extent.cwiseMax(shown_extent(frame, scale_.window).size());
    if (std::isfinite(frame.mean_stress))
        scale_.no_stress = std::max(scale_.no_stress, rounding * std::abs(frame.mean_stress));
    if (drawn_contacts(frame) == nullptr) return;
    Forces& forces = frame.parts ? of_parts_ : of_grains_;
    const auto normal_forces = cell_scalars(*drawn_contacts(frame), "normal_force");
    forces.values.insert(forces.values.end(), normal_forces.begin(), normal_forces.end());
    forces.diameter += frame.parts ? mean_part_diameter(frame) : mean_diameter(frame);
    forces.frames += 1.0;
}

ForceScale ScaleGatherer::of_forces(Forces forces, double strong, double widest) {
    if (forces.frames == 0.0) return {};
    return {percentile(forces.values, strong), widest * forces.diameter / forces.frames};
}

SheetScale ScaleGatherer::scale() const {
    if (!(scale_.extent.minCoeff() > 0.0)) throw InputError("the frames have no grains");
    SheetScale scale = scale_;
    scale.colours =
        style_.range.empty() ? robust_range(values_) : given_range(values_, style_.range[0], style_.range[1]);
    scale.grain_forces = of_forces(of_grains_, strong_grain_force, widest_grain_line);
    scale.part_forces = of_forces(of_parts_, strong_part_force, widest_part_line);
    return scale;
}

}  // namespace softgrain
