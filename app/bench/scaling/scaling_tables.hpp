#pragma once
// What a scaling run says: CSV, Markdown and plots.
#include <string>
#include <vector>

#include "app/bench/scaling/machine_limits.hpp"
#include "app/bench/scaling/scaling_run.hpp"
#include "viz/plot_spec.hpp"

namespace softgrain::bench {

/// A part of a step and its share of the time.
struct Part {
    std::string title;
    double share;
};

/// A function with a smaller share that belongs to no kernel is shown with the others.
inline constexpr double least_share = 0.02;

/// The kernels of a method in their order, then the functions that belong to none, then what is left.
std::vector<Part> parts_of(const std::string& method, const Profile& profile,
                           const std::vector<Kernel>& kernels);

/// A kernel beside what the machine could do.
struct RooflinePoint {
    const Subject* of;
    const KernelCount* count;
    double share;                                          ///< of the subject's time
    double time;                                           ///< of a grain-step [s]
    double rate;                                           ///< [flops/s]
    double limit;                                          ///< the least of the three below [flops/s]
    enum class Bound { arithmetic, cache, memory } bound;  ///< which of them

    double near_intensity() const { return count->flops / count->bytes; }     ///< [flops/byte]
    double far_intensity() const { return count->flops / count->far_bytes; }  ///< [flops/byte]
};

/// The row of KernelCount that stands for all of a step.
inline constexpr const char* whole_step = "whole step";

/// Of all kernels that are counted and have a share; "whole step" has all of it.
std::vector<RooflinePoint> roofline(const ScalingPlan& plan, const ScalingResults& results,
                                    const MachineLimits& limits);

/// One row for each subject, number of grains and threads.
std::string scaling_csv(const ScalingResults& results);
/// One row for each kernel, the machine's limits in comments.
std::string roofline_csv(const std::vector<RooflinePoint>& points, const MachineLimits& limits);
/// Ratios first: cost and memory beside those of the cheapest, then how both grow, where the time goes, how
/// far that is from the limits.
std::string scaling_markdown(const ScalingPlan& plan, const ScalingResults& results,
                             const MachineLimits& limits);

struct NamedPlot {
    std::string name;  ///< of its file, without .svg
    PlotSpec plot;
};
/// cost, threads, memory, roofline; those that have something to show.
std::vector<NamedPlot> scaling_plots(const ScalingPlan& plan, const ScalingResults& results,
                                     const MachineLimits& limits);

}  // namespace softgrain::bench
