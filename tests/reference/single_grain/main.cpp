// Curves of one soft disc between rigid walls, wall force against wall displacement, as CSV files.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "quarter_grain.hpp"

namespace {

using namespace softgrain::reference;

constexpr double radius = 0.5, young = 1.0;

/// How far and how finely each set of walls is pressed.
struct Closing {
    std::string_view name;
    Walls walls;
    std::string_view text;
    double spacing;
    int count;
};
constexpr std::array closings = {
    Closing{"four", Walls::four, "four rigid walls closing isotropically", 0.01, 25},
    Closing{"two", Walls::two, "two rigid walls (diametral compression)", 0.01, 30},
    Closing{"six", Walls::six, "six rigid walls closing as a regular hexagon", 0.01, 16},
    Closing{"eight", Walls::eight, "eight rigid walls closing as a regular octagon", 0.005, 16},
};

struct Options {
    std::string folder;
    int elements = 32, volume_points = 2;
    std::vector<double> poisson = {0.0, 0.2, 0.3, 0.4, 0.45, 0.49};
    std::vector<std::string> walls = {"four", "two", "six", "eight"};
};

/// Walks from `from` to `to`, in halves as often as needed; std::nullopt if that fails too.
std::optional<GrainState> press_to(QuarterGrain& grain, double from, double to, int depth = 0) {
    if (const auto state = grain.press(to)) return state;
    constexpr int deepest = 8;
    if (depth == deepest) return std::nullopt;
    const double middle = 0.5 * (from + to);
    if (!press_to(grain, from, middle, depth + 1)) return std::nullopt;
    return press_to(grain, middle, to, depth + 1);
}

/// Ends early where there is no equilibrium: a corner that fills up turns elements inside out.
std::vector<GrainState> curve(const Options& options, double poisson, const Closing& closing, int elements) {
    QuarterGrain grain(radius, elements, Material(young, poisson), closing.walls, options.volume_points);
    std::vector<GrainState> states;
    for (int k = 1; k <= closing.count; ++k) {
        const auto state = press_to(grain, closing.spacing * (k - 1), closing.spacing * k);
        if (!state) break;
        states.push_back(*state);
    }
    return states;
}

/// Largest |coarse/fine - 1| of the force over states [first, end).
double difference(const std::vector<GrainState>& coarse, const std::vector<GrainState>& fine,
                  std::size_t first, std::size_t end) {
    double largest = 0.0;
    for (std::size_t k = first; k < end; ++k)
        largest = std::max(largest, std::abs(coarse[k].force / fine[k].force - 1.0));
    return largest;
}

void write(const std::filesystem::path& path, const Options& options, double poisson,
           const Closing& closing) {
    const int fine_n = options.elements, coarse_n = fine_n / 2;
    auto coarse = curve(options, poisson, closing, coarse_n), fine = curve(options, poisson, closing, fine_n);
    const std::size_t common = std::min(coarse.size(), fine.size());
    if (common < 3) throw std::runtime_error(fmt::format("fewer than three equilibria at nu = {}", poisson));
    coarse.resize(common), fine.resize(common);
    std::ofstream out(path);
    out << fmt::format(
        "# One soft disc, diameter 1, E = 1, nu = {}, plane strain, frictionless, {}; resolved reference "
        "solution.\n"
        "# Grain law: W = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J-1)^2, I1 = tr(F^T F) + 1, mu = E/(2(1+nu)), "
        "kappa = "
        "E/(3(1-2nu)).\n"
        "# Method: quasi-static total-Lagrangian finite elements (Q2, {} elements on a quarter disc, "
        "volumetric energy at "
        "{} Gauss points), exact unilateral nodal contact. Made by tests/reference/single_grain.\n"
        "# Mesh error: |F({})/F({}) - 1| <= {:.1e} for e >= {:.2g} ({:.1e} at e = {}).\n"
        "# e wall displacement / radius; F wall force per unit thickness; Lc contact length, bracketed by "
        "Lc_lo and "
        "Lc_hi; area_ratio deformed / initial area;\n"
        "#   p_centre, p_max contact pressure; halfwidth_x largest |x|; W strain energy of the whole disc; "
        "minJ "
        "smallest det F; newton_its iterations.\n"
        "e,F,Lc,Lc_lo,Lc_hi,area_ratio,p_centre,p_max,halfwidth_x,W,minJ,newton_its\n",
        poisson, closing.text, 3 * fine_n * fine_n, options.volume_points * options.volume_points, coarse_n,
        fine_n, difference(coarse, fine, 2, common), fine[2].wall_displacement,
        difference(coarse, fine, 0, 1), fine[0].wall_displacement);
    for (const GrainState& s : fine)
        out << fmt::format(
            "{:.6g},{:.10g},{:.8g},{:.8g},{:.8g},{:.10g},{:.8g},{:.8g},{:.8g},{:.10g},{:.4f},{}\n",
            s.wall_displacement, s.force, s.contact_length, s.contact_length_low, s.contact_length_high,
            s.area_ratio, s.pressure_centre, s.pressure_max, s.half_width, s.energy, s.smallest_J,
            s.iterations);
    if (!out) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app("Resolved curves of one soft disc between rigid walls");
    app.add_option("folder", options.folder, "where the curves go; files that exist are kept")
        ->required()
        ->check(CLI::ExistingDirectory);
    app.add_option("--elements", options.elements,
                   "elements along 45 degrees of the outline; checked against half as many")
        ->check(CLI::Range(4, 128));
    app.add_option("--volume-points", options.volume_points, "Gauss points a side for the volumetric energy")
        ->check(CLI::IsMember({2, 3}));
    app.add_option("--poisson", options.poisson, "Poisson's ratios")->check(CLI::Range(0.0, 0.4999));
    app.add_option("--walls", options.walls, "two, four, six, eight")
        ->check(CLI::IsMember({"two", "four", "six", "eight"}));
    CLI11_PARSE(app, argc, argv);
    try {
        for (const std::string& walls : options.walls) {
            const auto closing = std::ranges::find(closings, walls, &Closing::name);
            for (const double poisson : options.poisson) {
                const auto path = std::filesystem::path(options.folder) /
                                  fmt::format("grain_{}wall_nu{:.6g}.csv", walls, poisson);
                if (std::filesystem::exists(path)) {
                    fmt::print("{} kept\n", path.string());
                    continue;
                }
                write(path, options, poisson, *closing);
                fmt::print("{} written\n", path.string());
                std::fflush(stdout);
            }
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "single_grain_reference: {}\n", error.what());
        return 1;
    }
    return 0;
}
