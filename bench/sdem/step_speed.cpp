// Time and memory of a whole step of SDEM: laws, ways to find chords, threads, sizes. All ratios are of one
// run. Usage: sdem_step_speed [packing fraction, default 0.9]
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "bench/sdem/sample.hpp"

namespace softgrain::sdem {
namespace {

double seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Median time per grain and step [ns] of `repeats` times `steps`.
double measure(Run& run, int steps, int repeats) {
    run.advance(steps / 4 + 1, Run::slow);
    std::vector<double> times;
    for (int r = 0; r < repeats; ++r) {
        const double start = seconds();
        run.advance(steps, Run::slow);
        times.push_back(seconds() - start);
    }
    const auto middle = times.begin() + repeats / 2;
    std::nth_element(times.begin(), middle, times.end());
    return 1e9 * *middle / (steps * static_cast<double>(run.size()));
}

void print_head() {
    fmt::print(
        "| law | chords | damping | box | grains | threads | ns per grain-step | M grain-steps/s | contacts "
        "per grain | bytes per grain |\n|---|---|---|---|--:|--:|--:|--:|--:|--:|\n");
}
void print_row(const Case& c, Run& run, double per_grain_step) {
    fmt::print("| {} | {} | {} | {} | {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.0f} |\n", c.law, c.geometry,
               c.damping > 0.0 ? "yes" : "no", c.periodic ? "cell" : "walls", run.size(), c.threads,
               per_grain_step, 1e3 / per_grain_step, run.contacts_per_grain(), run.memory());
    std::fflush(stdout);
}

/// Between walls, just compressed.
void time_compressed(const Case& c, const Packing& packing, double packing_fraction, int steps) {
    omp_set_num_threads(c.threads);
    Run run(c, packing);
    run.compress_to(packing_fraction);
    print_row(c, run, measure(run, steps, 9));
}

/// A periodic cell that was at rest, and a hundred copies of it, over the same steps: alike but for their
/// size.
void time_sizes(double packing_fraction) {
    Case c;
    c.periodic = true;
    const Packing packing = make_packing(scenario_of(c));
    Run cell(c, packing);
    cell.compress_to(packing_fraction);
    cell.come_to_rest();
    for (const int side : {1, 10}) {
        const Tiles tiles(cell, packing, side);
        for (const int threads : {1, 2}) {
            c.threads = threads;
            omp_set_num_threads(threads);
            Run run(c, tiles.packing());
            tiles.put_into(run);
            print_row(c, run, measure(run, 96, 9));
        }
    }
}

}  // namespace
}  // namespace softgrain::sdem

int main(int argc, char** argv) {
    using namespace softgrain;
    using namespace softgrain::sdem;
    const double packing_fraction = argc > 1 ? std::atof(argv[1]) : 0.9;
    print_head();
    const Packing packing = make_packing(scenario_of(Case{}));
    for (const char* law : {"mollon2022", "lens_potential"}) {
        Case c;
        c.law = law;
        for (const char* geometry : {"batch", "scalar", "polygon"}) {
            c.geometry = geometry;
            time_compressed(c, packing, packing_fraction, c.geometry == "polygon" ? 50 : 1000);
        }
        c.geometry = "batch";
        c.threads = 2;
        time_compressed(c, packing, packing_fraction, 1000);
    }
    Case hot;
    hot.damping = 0.0;
    time_compressed(hot, packing, packing_fraction, 1000);
    time_sizes(packing_fraction);
    return 0;
}
