#pragma once
// Plots of the map of stable steps.
#include <optional>
#include <vector>

#include "app/bench/stability/step_map.hpp"
#include "viz/plot_spec.hpp"

namespace softgrain::bench {

/// Of one map: largest stable step / default step against phi, a line for each damping with a band from the
/// least to the largest over the other axes. Nothing if no cell of it was measured.
std::optional<PlotSpec> map_plot(const std::vector<MapRow>& rows, const MapPlan& plan);

}  // namespace softgrain::bench
