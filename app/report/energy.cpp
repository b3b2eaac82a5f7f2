#include "app/report/energy.hpp"

#include <cmath>

namespace softgrain::report {

bool EnergyShares::is_flagged() const {
    return std::abs(residual) > most_residual;
}

std::optional<EnergyShares> energy_shares(const History& history) {
    if (history.rows() == 0) return std::nullopt;
    const auto change = [&](std::string_view column) {
        const auto& values = history.column(column);
        return values.back() - values.front();
    };
    const double work = change("external_work");
    if (!std::isfinite(work) || work == 0.0) return std::nullopt;
    return EnergyShares{work,
                        change("elastic_energy") / work,
                        change("kinetic_energy") / work,
                        change("dissipated_energy") / work,
                        change("plastic_energy") / work,
                        change("energy_residual") / work};
}

}  // namespace softgrain::report
