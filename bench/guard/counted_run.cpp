// counted_run SCENARIO METHOD [KEY=VALUE...]: the time loop alone, on one thread and without files, for
// counting its instructions. Prints steps, grains, and mean stress at the end [N/m].
#include <fmt/format.h>
#include <omp.h>

#include <atomic>

#include "app/methods.hpp"
#include "common/errors.hpp"
#include "common/observables/observable.hpp"
#include "common/packing/make_packing.hpp"
#include "common/time_loop.hpp"

namespace softgrain {
namespace {

double last_value(const RunState& state, std::string_view column) {
    for (std::size_t k = 0; k < observables().size(); ++k)
        if (observables()[k].name == column) return state.history.back()[k];
    throw std::logic_error("no such column");
}

void run(const char* scenario_file, const char* method_name, std::span<const std::string> overrides) {
    omp_set_num_threads(1);
    const Method& method = find_method(method_name);
    const Scenario scenario = scenario_for(read_scenario(scenario_file, overrides, method_keys()), method);
    const Packing packing = make_packing(scenario);
    const std::unique_ptr<Solver> solver = method.make(scenario, packing);
    TimeLoop loop(scenario, packing, *solver, {});
    const std::atomic<int> stop = 0;
    loop.go(stop, [] {});
    fmt::print("{},{},{}\n", loop.state().step, packing.size(), last_value(loop.state(), "mean_stress"));
}

}  // namespace
}  // namespace softgrain

int main(int argc, char** argv) {
    if (argc < 3) {
        fmt::print(stderr, "usage: {} SCENARIO METHOD [KEY=VALUE...]\n", argv[0]);
        return 2;
    }
    try {
        softgrain::run(argv[1], argv[2], std::vector<std::string>(argv + 3, argv + argc));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    }
}
