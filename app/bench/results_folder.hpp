#pragma once
// The folder that a bench writes into.
#include <filesystem>
#include <string>

#include "viz/plot_spec.hpp"

namespace softgrain::bench {

/// Throws InputError if the file is there and `force` is not given.
void refuse_to_replace(const std::filesystem::path& file, bool force);

/// As folder/NAME.svg. Throws OutputError.
void draw(const PlotSpec& plot, const std::filesystem::path& folder, const std::string& name);

}  // namespace softgrain::bench
