#include "app/bench/scaling/steps.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <atomic>
#include <nlohmann/json.hpp>

#include "app/methods.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "common/observables/coordination.hpp"
#include "common/packing/make_packing.hpp"
#include "common/time_loop.hpp"
#include "version.hpp"

namespace softgrain::bench {

StepsReport measure_steps(const StepsRequest& request) {
    const double start = wall_clock();
    const Method& method = find_method(request.method);
    const Scenario scenario =
        scenario_for(read_scenario(request.scenario, request.set, method_keys()), method);
    const Packing packing = make_packing(scenario);
    omp_set_num_threads(request.threads);
    reset_peak_memory();
    const auto before = static_cast<double>(peak_memory());
    const std::unique_ptr<Solver> solver = method.make(scenario, packing);
    TimeLoop loop(scenario, packing, *solver, {});

    const long long first = request.warm_up, last = first + request.steps;
    StepsReport report;
    bool measuring = false;
    double cpu = 0.0;
    std::atomic<int> stop = 0;
    loop.go(stop, [&] {
        const long long done = loop.state().step;
        if (done == first && !measuring) {
            measuring = true;
            cpu = cpu_clock();
            report.began = wall_clock();
        } else if (done == last) {
            report.ended = wall_clock();
            report.cpu = cpu_clock() - cpu;
            stop = 1;
        }
        if (stop_signal() != 0) stop = stop_signal().load();
    });
    report.steps = loop.state().step - first;
    if (stop_signal() != 0) throw InputError("stopped by a signal");
    if (report.steps != request.steps)
        throw InputError(fmt::format(
            "{}: {} after {} steps, {} are asked for: load it further or slower, or ask for fewer",
            request.scenario.string(), loop.state().ended, loop.state().step, last));
    report.method = method.name;
    report.grains = packing.free_size();
    report.threads = request.threads;
    report.wall = report.ended - report.began;
    report.whole_wall = report.ended - start;
    report.memory = static_cast<double>(peak_memory()) - before;
    report.coordination_number = coordination(solver->view(Need::contacts)).all;
    report.processor = processor_name();
    report.finished = date_and_time();
    report.version = version;
    report.commit = commit;
    return report;
}

std::string to_json(const StepsReport& r) {
    return nlohmann::json{{"method", r.method},
                          {"grains", r.grains},
                          {"threads", r.threads},
                          {"steps", r.steps},
                          {"wall", r.wall},
                          {"cpu", r.cpu},
                          {"began", r.began},
                          {"ended", r.ended},
                          {"whole_wall", r.whole_wall},
                          {"memory", r.memory},
                          {"coordination_number", r.coordination_number},
                          {"processor", r.processor},
                          {"finished", r.finished},
                          {"version", r.version},
                          {"commit", r.commit}}
        .dump();
}

StepsReport steps_report(const std::string& json) {
    try {
        const auto text = nlohmann::json::parse(json);
        StepsReport r;
        r.method = text.at("method");
        r.grains = text.at("grains");
        r.threads = text.at("threads");
        r.steps = text.at("steps");
        r.wall = text.at("wall");
        r.cpu = text.at("cpu");
        r.began = text.at("began");
        r.ended = text.at("ended");
        r.whole_wall = text.at("whole_wall");
        r.memory = text.at("memory");
        r.coordination_number = text.at("coordination_number");
        r.processor = text.at("processor");
        r.finished = text.at("finished");
        r.version = text.at("version");
        r.commit = text.at("commit");
        return r;
    } catch (const nlohmann::json::exception& error) {
        throw InputError(fmt::format("no report of steps: {}", error.what()));
    }
}

}  // namespace softgrain::bench
