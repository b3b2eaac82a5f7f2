#pragma once
// The one time loop: moves the walls or the cell, asks the solver to advance, samples at equal strain.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "common/loading.hpp"
#include "common/observer.hpp"
#include "common/run_state.hpp"
#include "common/scenario.hpp"
#include "common/solver.hpp"

namespace softgrain {

class TimeLoop {
  public:
    /// `scenario`, `solver` and the observers must outlive the run.
    TimeLoop(const Scenario& scenario, const Packing& packing, Solver& solver,
             std::vector<Observer*> observers);

    /// Continue from a saved state instead of the start; the solver must have loaded its own part. Returns
    /// what the observers say of lost files; throws as they do.
    std::vector<std::string> resume(const RunState& state);

    /// Begin with the stage that follows those of a run that ended in order, with a history of its own; the
    /// solver must have loaded its part.
    void branch(const RunState& state);

    /// Runs until the loading is done, the method leaves its validity (see state().ended), `stop` becomes
    /// non-zero, or the solver heeds stop_request() within a step, which is then not made. `after_step` is
    /// called after every step. Throws DivergedError, also of a limit of [watch] that is to stop the run,
    /// OutputError, and InputError if a stage turns out to begin beyond its end.
    void go(
        const std::atomic<int>& stop, const std::function<void()>& after_step = [] {});

    const RunState& state() const { return state_; }
    bool finished() const { return !state_.ended.empty(); }
    /// Fraction of the whole loading done (an estimate where the grains decide the end), 0 to 1.
    double loading_done() const;

  private:
    void start();
    void begin_stage(int stage);
    void make_driver();
    void step(const StageDriver& driver);
    void check(const StageDriver& driver, bool at_end);
    void sample(const StageDriver& driver, bool last);
    const LoadingStage& stage() const;
    Mat2 mean_boundary_stress() const;
    double mean_stress() const { return 0.5 * mean_boundary_stress().trace(); }
    /// Of the last step, by axis.
    std::array<double, 2> present_stress() const;

    const Scenario& scenario_;
    Solver& solver_;
    std::vector<Observer*> observers_;
    std::vector<std::size_t> order_;  ///< of the stages, repeats written out
    Grains grains_;
    Watchdog watchdog_;
    int checks_before_window_ = 0;  ///< of a sample interval; the mean of the stresses is over the rest
    RunState state_;
    std::vector<StageDriver> driver_;  ///< the present stage's, one or none
};

}  // namespace softgrain
