#pragma once
// softgrain-render plot: a line plot from a JSON spec.
#include <filesystem>

namespace softgrain {

/// Writes `out`, PNG or SVG by its ending. Throws InputError, OutputError.
void draw_plot(const std::filesystem::path& spec_file, const std::filesystem::path& out);

}  // namespace softgrain
