// Time and memory of a whole step of SDEM: laws, ways to find chords, threads, sizes. All ratios are of one
// run. Usage: sdem_step_speed [packing fraction, default 0.9]
#include <fmt/format.h>
#include <omp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "common/packing/make_packing.hpp"
#include "common/solver.hpp"
#include "sdem/method.hpp"

namespace softgrain::sdem {
namespace {

constexpr double slow = 1e-3, fast = 0.04;  // strain rates while measuring, and on the way there [1/s]

double seconds() {
    using namespace std::chrono;
    return duration<double>(steady_clock::now().time_since_epoch()).count();
}

/// Resident memory of this process [bytes].
double resident() {
    std::ifstream file("/proc/self/statm");
    double total = 0.0, pages = 0.0;
    file >> total >> pages;
    return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

struct Case {
    std::string law = "lens_potential", geometry = "batch";
    int grains = 1000, threads = 1;
    double damping = 1.0;
};

/// Sample A of Mollon 2022 (its size law), in larger numbers too.
Scenario scenario_of(const Case& c) {
    Scenario s;
    s.packing.count = c.grains;
    s.packing.radius_mean = 0.012;
    s.packing.radius_deviation = 0.0024;
    s.packing.radius_min = 0.008;
    s.packing.radius_max = 0.016;
    Settings settings(method().keys());
    settings.set("law", c.law);
    settings.set("geometry", c.geometry);
    settings.set("contact_damping", c.damping);
    settings.set("shape_damping", 0.5 * c.damping);
    s.method_settings.emplace("sdem", settings);
    return s;
}

class Run {
  public:
    Run(const Case& c, const Packing& packing) : box_(packing.box) {
        const double before = resident();
        solver_ = method().make(scenario_of(c), packing);
        advance(1, slow);
        memory_ = (resident() - before) / static_cast<double>(packing.size());
        for (double R : packing.radius) area_ += std::numbers::pi * R * R;
    }
    void advance(int steps, double strain_rate) {
        for (int k = 0; k < steps; ++k) {
            const double v = 0.5 * strain_rate * box_.width(), w = 0.5 * strain_rate * box_.height();
            const WallMotion motion{box_, {v, -v, w, -w}};
            const double dt = solver_->stable_time_step();
            solver_->advance(motion, dt);
            box_ = motion.after(dt);
        }
    }
    void compress_to(double packing_fraction) {
        while (area_ / box_.area() < packing_fraction) advance(1, fast);
    }
    double memory() const { return memory_; }
    double contacts() {
        double count = 0.0;
        for (const GrainContact& c : solver_->view(Need::contacts).contacts)
            count += c.with_wall() ? 0.0 : 1.0;
        return count;
    }

  private:
    std::unique_ptr<Solver> solver_;
    Box box_;
    double area_ = 0.0, memory_ = 0.0;
};

/// Copies side by side, `side` in each direction.
Packing tiled(const Packing& one, int side) {
    Packing many;
    many.box = one.box;
    many.box.position[1] = one.box.position[0] + side * one.box.width();
    many.box.position[3] = one.box.position[2] + side * one.box.height();
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (std::size_t g = 0; g < one.size(); ++g) {
                many.center.push_back(one.center[g] + Vec2{x * one.box.width(), y * one.box.height()});
                many.radius.push_back(one.radius[g]);
            }
    return many;
}

struct Result {
    double per_grain_step = 0.0;  ///< [ns], median
    double contacts = 0.0;        ///< per grain
    double memory = 0.0;          ///< bytes per grain, with one step made
};

Result measure(const Case& c, const Packing& packing, double packing_fraction, int steps, int repeats) {
    omp_set_num_threads(c.threads);
    Run run(c, packing);
    run.compress_to(packing_fraction);
    run.advance(steps / 4 + 1, slow);
    std::vector<double> times;
    for (int r = 0; r < repeats; ++r) {
        const double start = seconds();
        run.advance(steps, slow);
        times.push_back(seconds() - start);
    }
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    const auto n = static_cast<double>(packing.size());
    return {1e9 * times[static_cast<std::size_t>(repeats / 2)] / (steps * n), run.contacts() / n,
            run.memory()};
}

void print(const Case& c, const Result& r) {
    fmt::print("| {} | {} | {} | {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.0f} |\n", c.law, c.geometry,
               c.damping > 0.0 ? "yes" : "no", c.grains, c.threads, r.per_grain_step, 1e3 / r.per_grain_step,
               r.contacts, r.memory);
    std::fflush(stdout);
}

}  // namespace
}  // namespace softgrain::sdem

int main(int argc, char** argv) {
    using namespace softgrain;
    using namespace softgrain::sdem;
    const double packing_fraction = argc > 1 ? std::atof(argv[1]) : 0.9;
    fmt::print(
        "| law | chords | damping | grains | threads | ns per grain-step | M grain-steps/s | contacts per "
        "grain | "
        "bytes per grain |\n|---|---|---|--:|--:|--:|--:|--:|--:|\n");
    Case c;
    const Packing small = make_packing(scenario_of(c));
    for (const char* law : {"mollon2022", "lens_potential"}) {
        c = Case{};
        c.law = law;
        for (const char* geometry : {"batch", "scalar", "polygon"}) {
            c.geometry = geometry;
            const int steps = c.geometry == "polygon" ? 50 : 1000;
            print(c, measure(c, small, packing_fraction, steps, 9));
        }
        c.geometry = "batch";
        c.threads = 2;
        print(c, measure(c, small, packing_fraction, 1000, 9));
    }
    c = Case{};
    c.damping = 0.0;
    print(c, measure(c, small, packing_fraction, 1000, 9));
    c = Case{};
    c.grains = 100000;
    const Packing large = tiled(small, 10);
    for (const int threads : {1, 2}) {
        c.threads = threads;
        print(c, measure(c, large, packing_fraction, 20, 5));
    }
    return 0;
}
