#include "common/io/measure_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/history_csv.hpp"
#include "common/io/lost_files.hpp"
#include "common/observables/forces.hpp"
#include "common/observables/pair_correlation.hpp"
#include "common/observables/tessellation.hpp"

namespace softgrain {
namespace {

constexpr double force_bin = 0.1;                      // of the mean normal force
constexpr double chain_turn = std::numbers::pi / 4.0;  // of Peters et al. 2005
// In mean diameters.
constexpr double distance_bin = 0.05;
constexpr double reach = 6.0;

/// With which the files of a measure begin.
constexpr std::array<std::pair<std::string_view, std::string_view>, measure_names.size()> begins{
    {{"forces", "# time "},
     {"chains", "grain,"},
     {"grains", "# time "},
     {"pair_correlation", "distance,"},
     {"tessellation", "x0,"}}};
constexpr std::string_view begin_of_centres = "# the box's origin";

/// Of the disc of its undeformed area [m].
double radius_of(const GrainView& view, std::size_t grain) {
    return std::sqrt(view.reference_area[grain] / std::numbers::pi);
}

std::span<const Vec2> free_centres(const GrainView& view) {
    return view.centroid.first(view.free_size());
}

std::string time_line(const GrainView& view) {
    return fmt::format("# time {} s\n", view.time);
}

std::string forces(const GrainView& view) {
    std::string text = time_line(view) + "force_over_mean,probability_density\n";
    const Histogram histogram = force_distribution(view, force_bin);
    for (std::size_t k = 0; k < histogram.value.size(); ++k)
        text += fmt::format("{:.6g},{}\n", histogram.middle(k), histogram.value[k]);
    return text;
}

std::string chains(const GrainView& view) {
    std::string text = "grain,chain,stress_xx,stress_yy,stress_xy\n";
    const ForceChains found = force_chains(view, chain_turn);
    for (std::size_t g = 0; g < view.free_size(); ++g) {
        const Mat2& s = found.stress[g];
        text += fmt::format("{},{},{},{},{}\n", g, found.chain[g], s(0, 0), s(1, 1), s(0, 1));
    }
    return text;
}

std::string grains(const GrainView& view) {
    std::string text = time_line(view) + "grain,x,y,vx,vy,radius,driven\n";
    for (std::size_t g = 0; g < view.size(); ++g)
        text += fmt::format("{},{},{},{},{},{},{}\n", g, view.centroid[g].x(), view.centroid[g].y(),
                            view.velocity[g].x(), view.velocity[g].y(), radius_of(view, g),
                            g < view.free_size() ? 0 : 1);
    return text;
}

std::string correlation(const GrainView& view) {
    double radii = 0.0;
    for (std::size_t g = 0; g < view.free_size(); ++g) radii += radius_of(view, g);
    const double diameter = 2.0 * radii / static_cast<double>(view.free_size());
    std::string text = "distance,pair_correlation\n";
    const Histogram g =
        pair_correlation(free_centres(view), view.box, distance_bin * diameter, reach * diameter);
    for (std::size_t k = 0; k < g.value.size(); ++k) text += fmt::format("{},{}\n", g.middle(k), g.value[k]);
    return text;
}

/// Grain centres and the box that they were in: its origin and its two sides come first.
struct Centres {
    std::vector<Vec2> position;
    Box box;
};

std::string centres_text(const GrainView& view) {
    const Box& b = view.box;
    std::string text =
        fmt::format("# the box's origin and its two sides, then the grains\nx,y\n{},{}\n{},0\n{},{}\n",
                    b.position[0], b.position[2], b.width(), b.tilt, b.height());
    for (const Vec2& x : free_centres(view)) text += fmt::format("{},{}\n", x.x(), x.y());
    return text;
}

Centres read_centres(const std::filesystem::path& path, bool periodic) {
    const History file = read_history(path);
    const std::vector<double>&x = file.column("x"), &y = file.column("y");
    Centres centres;
    if (x.size() < 3) throw InputError(fmt::format("{}: cut off", path.string()));
    centres.box = Box{{x.at(0), x.at(0) + x.at(1), y.at(0), y.at(0) + y.at(2)}, periodic, x.at(2)};
    for (std::size_t k = 3; k < x.size(); ++k) centres.position.emplace_back(x[k], y[k]);
    return centres;
}

}  // namespace

std::vector<std::string> measures_in(std::string_view list) {
    std::vector<std::string> names;
    for (std::size_t start = 0; start < list.size();) {
        const std::size_t end = std::min(list.find(',', start), list.size());
        const std::string_view field = list.substr(start, end - start);
        const auto first = field.find_first_not_of(' ');
        names.emplace_back(first == field.npos
                               ? std::string_view()
                               : field.substr(first, field.find_last_not_of(' ') - first + 1));
        start = end + 1;
    }
    return names;
}

MeasureWriter::MeasureWriter(std::filesystem::path run_dir, std::vector<std::string> measures)
    : folder_(run_dir / "measures"), measures_(std::move(measures)) {
    make_directories(folder_);
}

bool MeasureWriter::wanted(std::string_view measure) const {
    return std::find(measures_.begin(), measures_.end(), measure) != measures_.end();
}

std::filesystem::path MeasureWriter::path(std::string_view name, int frame) const {
    return folder_ / fmt::format("{}_{:06}.csv", name, frame);
}

Need MeasureWriter::need(const Sample& sample) const {
    return sample.is_frame && (wanted("forces") || wanted("chains")) ? Need::contacts : Need::base;
}

void MeasureWriter::observe(const GrainView& view, const Sample& sample) {
    if (!sample.is_frame) return;
    const auto write = [&](std::string_view name, std::string (*text)(const GrainView&)) {
        if (wanted(name)) write_file_atomically(path(name, sample.frame), text(view));
    };
    write("forces", forces);
    write("chains", chains);
    write("grains", grains);
    write("pair_correlation", correlation);
    if (wanted("tessellation")) write_tessellation(view, sample.frame);
}

std::vector<std::string> MeasureWriter::resume(std::span<const double> frame_times) {
    std::vector<std::string> lines;
    const auto frames = static_cast<int>(frame_times.size());
    const auto look_at = [&](std::string_view name, std::string_view begin) {
        LostFiles lost;
        for (int frame = 0; frame < frames; ++frame)
            lost.add(path(name, frame), damage_at_ends(path(name, frame), begin, "\n"));
        lost.say(lines);
    };
    for (const auto& [name, begin] : begins)
        if (wanted(name)) look_at(name, begin);
    if (!wanted("tessellation") || frames == 0) return lines;
    const std::filesystem::path last = path("centres", frames - 1);
    if (const auto damage = damage_at_ends(last, begin_of_centres, "\n"); !damage.empty())
        throw InputError(
            fmt::format("{}: {}; the next strains refer to it, so put it back or start anew with --force",
                        last.string(), damage));
    look_at("centres", begin_of_centres);
    return lines;
}

void MeasureWriter::write_tessellation(const GrainView& view, int frame) const {
    write_file_atomically(path("centres", frame), centres_text(view));
    const Centres before = read_centres(path("centres", std::max(0, frame - 1)), view.box.periodic);
    if (before.position.size() != view.free_size())
        throw InputError(fmt::format("{}: has {} grains instead of {}; start anew with --force",
                                     path("centres", std::max(0, frame - 1)).string(), before.position.size(),
                                     view.free_size()));
    const Tessellation tessellation = tessellate(free_centres(view), view.box);
    const auto gradient =
        local_gradients(tessellation, before.position, before.box, free_centres(view), view.box);
    const auto voids =
        void_ratios(tessellation, free_centres(view), view.box, view.reference_area.first(view.free_size()));
    std::string text = "x0,y0,x1,y1,x2,y2,void_ratio,strain_xx,strain_yy,strain_xy\n";
    for (std::size_t t = 0; t < voids.size(); ++t) {
        for (const Vec2& corner : tessellation.corners(t, free_centres(view), view.box))
            text += fmt::format("{},{},", corner.x(), corner.y());
        const Mat2 strain = Mat2::Identity() - 0.5 * (gradient[t] + gradient[t].transpose());
        text += fmt::format("{},{},{},{}\n", voids[t], strain(0, 0), strain(1, 1), strain(0, 1));
    }
    write_file_atomically(path("tessellation", frame), text);
}

}  // namespace softgrain
