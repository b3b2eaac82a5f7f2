#pragma once
// Where the work went.
#include <optional>

#include "common/io/history_csv.hpp"

namespace softgrain::report {

inline constexpr double most_residual = 0.02;  ///< of the work, above which it is flagged

/// At the end of a run, as shares of the external work; all but plastic add up to 1. Changes since the start.
struct EnergyShares {
    double work;  ///< [J]
    double elastic, kinetic;
    double dissipated;  ///< by damping, friction, impact, plastic flow and adhesion
    double plastic;     ///< of that by plastic flow
    double residual;

    bool is_flagged() const;
};
/// None without work.
std::optional<EnergyShares> energy_shares(const History& history);

}  // namespace softgrain::report
