#pragma once
// Limits that a sound run keeps, looked at at every sample: energy, momentum, penetration, convergence,
// contacts.
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "common/checkpoint.hpp"
#include "common/grain_view.hpp"
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// Keys of [watch], in the order of WatchState's arrays.
inline constexpr std::array<std::string_view, 5> watch_limits{"energy_residual", "momentum", "penetration",
                                                              "unconverged", "lost_contacts"};

/// What the watch remembers between samples.
struct WatchState {
    Vec2 momentum = Vec2::Zero();                      ///< of the free grains at the last sample [kg m/s]
    Vec2 impulse = Vec2::Zero();                       ///< of the walls since then [N s]
    double impulse_sum = 0.0;                          ///< of their magnitudes, wall by wall [N s]
    double most_work = 0.0;                            ///< largest |external work| at a sample [J]
    double unconverged = 0.0;                          ///< steps, at the last sample
    double step = 0.0;                                 ///< of the last sample
    double time = 0.0;                                 ///< of the last sample [s]
    std::array<double, watch_limits.size()> broken{};  ///< samples at which each limit was broken
    std::array<double, watch_limits.size()> first{};   ///< time at which it was broken first [s]
    std::array<double, watch_limits.size()> worst{};   ///< largest value seen beyond it

    double all_broken() const;
    void save(Checkpoint& to) const;
    void load(const Checkpoint& from);
};

/// A limit that was broken at a sample.
struct BrokenLimit {
    std::size_t limit;  ///< in watch_limits
    std::string why;    ///< value and limit
};

class Watchdog {
  public:
    Watchdog(const Watch& watch, const Packing& packing, double mean_diameter);

    /// After a step of dt; forces of grains on walls before and after it [N].
    void add_step(WatchState& state, const std::array<Vec2, 4>& before, const std::array<Vec2, 4>& after,
                  double dt) const;
    /// At a sample; `view` has Need::contacts. Returns what is broken, and remembers it.
    std::vector<BrokenLimit> check(WatchState& state, const GrainView& view, double initial_energy,
                                   double step) const;

  private:
    double energy_error(WatchState& state, const GrainView& view, double initial_energy) const;
    double momentum_error(WatchState& state, const GrainView& view) const;
    double lost_contacts(const GrainView& view) const;

    Watch watch_;
    double mean_diameter_;
    std::vector<double> inner_radius_;  ///< [n] of the disc within each undeformed grain, 0 of a clump [m]
};

/// One line for each limit that was ever broken.
std::vector<std::string> warnings_of(const WatchState& state, const Watch& watch);

}  // namespace softgrain
