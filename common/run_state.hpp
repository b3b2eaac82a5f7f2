#pragma once
// All that the time loop remembers.
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/box.hpp"
#include "common/checkpoint.hpp"
#include "common/servo.hpp"
#include "common/watch.hpp"

namespace softgrain {

/// RunState::ended of a run that came to the end of its last stage.
inline constexpr const char* ended_in_order = "loading done";

/// Everything of the loop that a restart needs. Complete with the solver's own state.
struct RunState {
    long long step = 0;
    double time = 0.0;  ///< [s]
    Box box, initial_box;
    double initial_energy = 0.0;  ///< [J]
    int stage = 0;
    Box stage_box;                         ///< at the start of the stage
    std::array<double, 2> stage_stress{};  ///< of each axis, at the start of the stage [N/m]
    double stage_time = 0.0;               ///< since the start of the stage [s]
    double most_strain = 0.0;              ///< the rate's integral since then
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
    double rate = 0.0;                             ///< StageDriver::rate of the last step [1/s]
    ServoState servo;
    WatchState watch;
    std::vector<std::vector<double>> history;  ///< a row per sample, columns as the table of observables
    std::vector<std::int64_t> state_hashes;    ///< state_hash() of each sample, its bits
    std::vector<double> frame_times;           ///< [s]
    std::string ended;                         ///< why the run is over; empty while it is not

    void save(Checkpoint& to) const;
    void load(const Checkpoint& from);
};

}  // namespace softgrain
