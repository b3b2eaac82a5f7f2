#include "viz/render/loading_path.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

constexpr double tremble = 0.02;  ///< the way back that is no unloading, as a share of the way forth
constexpr double least_growth = 1e-9;
constexpr double least_spacing = 1e-3;  ///< of frames, as a share of the loading

bool grows(const std::vector<double>& values) {
    double forth = 0.0, back = 0.0;
    for (std::size_t k = 0; k < values.size(); ++k) {
        if (!std::isfinite(values[k])) return false;
        if (k > 0) (values[k] > values[k - 1] ? forth : back) += std::abs(values[k] - values[k - 1]);
    }
    return values.size() < 2 || (forth > least_growth && back <= tremble * forth);
}

/// Largest of the finite values.
double farthest(const std::vector<double>& values) {
    double largest = -INFINITY;
    for (const double v : values)
        if (std::isfinite(v)) largest = std::max(largest, v);
    return largest;
}

double nearest_to_start(const std::vector<double>& values) {
    double smallest = INFINITY;
    for (const double v : values)
        if (std::isfinite(v)) smallest = std::min(smallest, v);
    return smallest;
}

}  // namespace

LoadingPath::LoadingPath(const std::vector<RunReader>& runs, bool by_packing_fraction) {
    struct Candidate {
        const char* name;
        const std::vector<double>& (RunReader::*of)() const;
    };
    constexpr Candidate candidates[] = {{"packing fraction", &RunReader::packing_fractions},
                                        {"path of strain", &RunReader::strain_paths},
                                        {"time", &RunReader::times}};
    for (const Candidate& candidate : candidates) {
        quantity_ = candidate.name;
        at_frames_.clear();
        for (const RunReader& run : runs) at_frames_.push_back((run.*candidate.of)());
        if (by_packing_fraction || std::ranges::all_of(at_frames_, grows)) break;
    }
    if (by_packing_fraction)
        for (const RunReader& run : runs) run.require_packing_fraction();
    start_ = INFINITY;
    end_ = -INFINITY;
    for (const auto& values : at_frames_) {
        start_ = std::min(start_, nearest_to_start(values));
        end_ = std::max(end_, farthest(values));
    }
}

double LoadingPath::last_common() const {
    double last = end_;
    for (const auto& values : at_frames_) last = std::min(last, farthest(values));
    return last;
}

/// Mean distance of a run's frames.
double LoadingPath::spacing(std::size_t run) const {
    const auto& values = at_frames_[run];
    const double mean = values.size() < 2 ? 0.0
                                          : (farthest(values) - nearest_to_start(values)) /
                                                static_cast<double>(values.size() - 1);
    return std::max(mean, least_spacing * (end_ - start_));
}

std::vector<double> LoadingPath::all_stages() const {
    const auto by_count = [](const auto& a, const auto& b) { return a.size() < b.size(); };
    const auto by_reach = [](const auto& a, const auto& b) { return farthest(a) < farthest(b); };
    const auto most = std::ranges::max_element(at_frames_, by_count);
    const auto longest = std::ranges::max_element(at_frames_, by_reach);
    std::vector<double> stages = *most;
    std::ranges::sort(stages);
    const double reached = stages.back() + 0.5 * spacing(static_cast<std::size_t>(most - at_frames_.begin()));
    for (const double value : *longest)
        if (value > reached) stages.push_back(value);
    return stages;
}

LoadingPath::Match LoadingPath::match(std::size_t run, double stage) const {
    const auto& values = at_frames_[run];
    std::size_t best = 0;
    const auto distance = [&](std::size_t f) {
        return std::isfinite(values[f]) ? std::abs(values[f] - stage) : INFINITY;
    };
    for (std::size_t f = 1; f < values.size(); ++f)
        if (distance(f) < distance(best)) best = f;
    return {best, stage > farthest(values) + 0.5 * spacing(run)};
}

}  // namespace softgrain
