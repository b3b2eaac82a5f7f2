#pragma once
// Columns of the history: one number per sample, the same definition for every method.
#include <span>
#include <string_view>

#include "common/grain_view.hpp"

namespace softgrain {

/// All that an observable may look at in one sample.
struct Frame {
    const GrainView& view;
    Box initial_box;
    double axial_strain;             ///< 1 - L/L0 along the loading axis
    double strain_rate;              ///< [1/s]
    double density;                  ///< mean of the grain materials [kg/m^2]
    double initial_energy;           ///< kinetic + elastic at the start [J]
    std::array<Vec2, 4> wall_force;  ///< mean since the last check of the loop [N]
    Mat2 cell_stress;                ///< the same, of a periodic cell; zero with walls [N/m]
    long long step;
    int stage = 0;          ///< of the loading, in the order of the run
    double warnings = 0.0;  ///< limits of [watch] broken at this and all earlier samples
};

struct Observable {
    std::string_view name;
    std::string_view unit;
    Need need;
    double (*measure)(const Frame&);
};

/// Every column of `history.csv`, in its order.
std::span<const Observable> observables();

/// Index of a column; throws std::out_of_range.
std::size_t observable_index(std::string_view name);

}  // namespace softgrain
