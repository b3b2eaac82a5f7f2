// CPU time of an iteration of Newton's method against the number of grains, in isotropic compaction with one
// thread. Usage: mpm_iteration_cost [points across a radius, default 8] [grains...]
#include <fmt/format.h>
#include <omp.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "common/packing/make_packing.hpp"
#include "mpm/method.hpp"
#include "mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

constexpr double strain_rate = 2e-4;             // [sqrt(E/rho) / mean radius]
constexpr double begin = 0.04, measured = 0.04;  // strains from jamming

Scenario scenario_of(int grains, int points) {
    Scenario s;
    s.packing.count = grains;
    s.packing.radius_mean = 1.0;
    s.packing.radius_deviation = 0.2;
    s.packing.radius_min = 0.667;
    s.packing.radius_max = 1.333;
    Settings settings(method().keys());
    settings.set("points_across_radius", static_cast<std::int64_t>(points));
    s.method_settings.emplace("mpm", settings);
    return s;
}

Box compress(MpmSolver& solver, Box box, double strain) {
    const double width = box.width() * std::exp(-strain);
    while (box.width() > width) {
        const double v = 0.5 * strain_rate * box.width(), w = 0.5 * strain_rate * box.height();
        const WallMotion motion{box, {v, -v, w, -w}};
        const double dt = 0.002 / strain_rate;
        solver.advance(motion, dt);
        box = motion.after(dt);
    }
    return box;
}

void measure(int grains, int points) {
    const Scenario scenario = scenario_of(grains, points);
    const Packing packing = make_packing(scenario);
    MpmSolver solver(scenario, packing);
    const Box begun = compress(solver, packing.box, begin);
    const long long before = solver.iterations();
    const std::clock_t start = std::clock();
    compress(solver, begun, measured);
    const double milliseconds = 1e3 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const auto iterations = static_cast<double>(solver.iterations() - before);
    fmt::print("| {} | {} | {:.0f} | {:.1f} | {:.0f} |\n", grains, 2 * solver.nodes().size(), iterations,
               milliseconds / iterations, 1e3 * milliseconds / iterations / grains);
    std::fflush(stdout);
}

}  // namespace
}  // namespace softgrain::mpm

int main(int argc, char** argv) {
    omp_set_num_threads(1);
    const int points = argc > 1 ? std::atoi(argv[1]) : 8;
    std::vector<int> grains{25, 50, 100, 200, 300};
    if (argc > 2) grains.clear();
    for (int k = 2; k < argc; ++k) grains.push_back(std::atoi(argv[k]));
    fmt::print(
        "| grains | unknowns | iterations | ms per iteration | us per iteration and grain "
        "|\n|--:|--:|--:|--:|--:|\n");
    for (const int count : grains) softgrain::mpm::measure(count, points);
    return 0;
}
