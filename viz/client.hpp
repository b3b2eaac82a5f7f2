#pragma once
// Asks softgrain-render for pictures, so that the solver's executable never loads VTK's rendering libraries.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viz/plot_spec.hpp"

namespace softgrain {

/// Pictures of several runs at the same loading stages, on one scale.
struct FramesSpec {
    struct Run {
        std::string label;
        std::filesystem::path directory;
    };
    std::vector<Run> runs;
    std::vector<double> at{0.0, 0.5, 1.0};           ///< fractions of the list of frames
    std::vector<double> at_packing_fraction;         ///< used instead of `at` if not empty
    std::string field = "mean_stress";               ///< cell data of grains.pvd
    std::optional<std::pair<double, double>> range;  ///< of the colours; without it, from the data
    bool parts = false;                              ///< draw the parts of grains, where a run wrote them
    std::optional<std::array<double, 4>> window;     ///< left, right, bottom, top as shares of the extent
    std::filesystem::path out;                       ///< folder: LABEL_1.png ... and sheet.png
    int width = 1600;                                ///< [pixels]
};

/// Path of softgrain-render: $SOFTGRAIN_RENDER_EXE, beside the running executable, or in libexec near it.
/// Empty if there is none.
std::filesystem::path find_renderer();

/// Draws the frames. Returns why it failed, if it did.
std::optional<std::string> render_frames(const FramesSpec& spec);

/// Draws the plot as `out` (.png, or .svg, which needs no renderer), with its spec beside it as .json.
/// Returns why it failed, if it did.
std::optional<std::string> render_plot(const PlotSpec& spec, const std::filesystem::path& out);

}  // namespace softgrain
