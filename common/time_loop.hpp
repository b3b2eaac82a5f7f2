#pragma once
// The one time loop: moves the walls or the cell, asks the solver to advance, samples at equal strain.
#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "common/loading.hpp"
#include "common/observer.hpp"
#include "common/scenario.hpp"
#include "common/solver.hpp"

namespace softgrain {

/// Everything of the loop that a restart needs. Complete with the solver's own state.
struct RunState {
    long long step = 0;
    double time = 0.0;  ///< [s]
    Box box, initial_box;
    double initial_energy = 0.0;  ///< [J]
    int stage = 0;
    Box stage_box;            ///< at the start of the stage
    double stage_time = 0.0;  ///< since the start of the stage [s]
    double stage_packing_fraction = 0.0;
    long long checks = 0;           ///< done in this stage
    double packing_fraction = 0.0;  ///< at the last check
    std::array<Vec2, 4> impulse{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(),
                                Vec2::Zero()};  ///< since the mean began [N s]
    Mat2 stress_impulse = Mat2::Zero();         ///< of a periodic cell, since the mean began [N s / m]
    double impulse_time = 0.0;                  ///< [s]
    std::array<Vec2, 4> mean_force{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(),
                                   Vec2::Zero()};  ///< up to the last check [N]
    Mat2 mean_cell_stress = Mat2::Zero();          ///< the same, of a periodic cell [N/m]
    double rate = 0.0;                             ///< d(progress)/dt of the last step [1/s]
    std::vector<std::vector<double>> history;      ///< a row per sample, columns as the table of observables
    std::vector<double> frame_times;               ///< [s]
    std::string ended;                             ///< why the run is over; empty while it is not

    void save(Checkpoint& to) const;
    void load(const Checkpoint& from);
};

class TimeLoop {
  public:
    /// `scenario`, `solver` and the observers must outlive the run.
    TimeLoop(const Scenario& scenario, const Packing& packing, Solver& solver,
             std::vector<Observer*> observers);

    /// Continue from a saved state instead of the start; the solver must have loaded its own part.
    void resume(const RunState& state);

    /// Runs until the loading is done, the method leaves its validity (see state().ended), or `stop` becomes
    /// non-zero. `after_step` is called after every step. Throws DivergedError, OutputError, and
    /// InputError if a stage turns out to begin beyond its end.
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
    double mean_stress() const;

    const Scenario& scenario_;
    Solver& solver_;
    std::vector<Observer*> observers_;
    double undeformed_area_ = 0.0;
    double mean_diameter_ = 0.0;
    double density_ = 0.0;
    int checks_before_window_ = 0;  ///< of a sample interval; the mean of the stresses is over the rest
    RunState state_;
    std::vector<StageDriver> driver_;  ///< the present stage's, one or none
};

}  // namespace softgrain
