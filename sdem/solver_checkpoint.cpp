// Saving, restoring and judging the state.
#include <fmt/format.h>

#include <cmath>

#include "common/errors.hpp"
#include "sdem/solver.hpp"

namespace softgrain::sdem {
namespace {

constexpr double largest_trusted_strain = 0.6;

std::array<double, 4> four(const Checkpoint& from, std::string_view name) {
    std::vector<double> values;
    from.get(name, values);
    if (values.size() != 4) throw InputError(fmt::format("checkpoint array '{}' must have 4 values", name));
    return {values[0], values[1], values[2], values[3]};
}

template <class T>
void get_sized(const Checkpoint& from, std::string_view name, std::size_t size, std::vector<T>& values) {
    from.get(name, values);
    if (values.size() != size)
        throw InputError(
            fmt::format("checkpoint array '{}' has {} entries for {} grains: it belongs to another "
                        "packing; start the run afresh",
                        name, values.size(), size));
}

}  // namespace

/// Forces and contacts are not stored: they are found again, bit by bit, from what is.
void SoftDiscSolver::save(Checkpoint& to) const {
    to.put("sdem.time", time_);
    to.put("sdem.last_step", last_step_);
    to.put("sdem.box", std::span<const double>(box_.position));
    to.put("sdem.wall_velocity", std::span<const double>(wall_velocity_));
    to.put("sdem.position", std::span<const Vec2>(grains_.position));
    to.put("sdem.velocity", std::span<const Vec2>(grains_.velocity));
    to.put("sdem.F", std::span<const Mat2>(grains_.F));
    to.put("sdem.F_rate", std::span<const Mat2>(grains_.F_rate));
    to.put("sdem.built_at", neighbors_.built_at());
    to.put("sdem.built_reach", neighbors_.built_reach());
    std::vector<Vec2> ends;
    for (const WarmStart& warm : warm_before_) ends.insert(ends.end(), {warm.a, warm.b});
    to.put("sdem.warm_start", std::span<const Vec2>(ends));
    to.put("sdem.caps_before", std::span<const double>(caps_before_));
    to.put("sdem.energy", std::array<double, 3>{ledger_.elastic, ledger_.external_work, ledger_.damping});
}

void SoftDiscSolver::load(const Checkpoint& from) {
    const std::size_t n = size();
    time_ = from.number("sdem.time");
    last_step_ = from.number("sdem.last_step");
    box_.position = four(from, "sdem.box");
    wall_velocity_ = four(from, "sdem.wall_velocity");
    get_sized(from, "sdem.position", n, grains_.position);
    get_sized(from, "sdem.velocity", n, grains_.velocity);
    get_sized(from, "sdem.F", n, grains_.F);
    get_sized(from, "sdem.F_rate", n, grains_.F_rate);
    get_sized(from, "sdem.caps_before", n, caps_before_);
    std::vector<Vec2> built_at;
    std::vector<double> built_reach, energy;
    get_sized(from, "sdem.built_at", n, built_at);
    get_sized(from, "sdem.built_reach", n, built_reach);
    get_sized(from, "sdem.energy", 3, energy);
    ledger_ = EnergyLedger{};
    ledger_.elastic = energy[0];
    ledger_.external_work = energy[1];
    ledger_.damping = energy[2];

    neighbors_.build(built_at, built_reach, neighbors_.skin());
    pairs_of_.build(neighbors_.pairs(), n);
    pair_contact_.resize(neighbors_.pairs().size());
    std::vector<Vec2> ends;
    get_sized(from, "sdem.warm_start", 2 * neighbors_.pairs().size(), ends);
    warm_.resize(neighbors_.pairs().size());
    for (std::size_t k = 0; k < warm_.size(); ++k) warm_[k] = {ends[2 * k], ends[2 * k + 1]};
    before_ = grains_.position;
    update_shapes(before_);
    update_neighbors();  // nothing to do for a state as it was saved
    evaluate_forces();
}

void SoftDiscSolver::check_finite() const {
    const auto check = [&](std::size_t g, bool finite, const char* quantity) {
        if (!finite) throw DivergedError(static_cast<int>(g), quantity, time_, "not a finite number");
    };
    for (std::size_t g = 0; g < size(); ++g) {
        check(g, grains_.position[g].allFinite(), "position");
        check(g, grains_.velocity[g].allFinite(), "velocity");
        check(g, grains_.F[g].allFinite(), "F");
        check(g, grains_.F_rate[g].allFinite(), "F rate");
        check(g, forces_[g].force.allFinite(), "force");
        check(g, forces_[g].moment.allFinite(), "moment");
    }
}

std::optional<std::string> SoftDiscSolver::outside_validity() const {
    for (std::size_t g = 0; g < size(); ++g) {
        const Mat2& F = grains_.F[g];
        const double middle = 0.5 * Polar(F).trace - 1.0, d = half_stretch_difference(F);
        if (std::max(std::abs(middle + d), std::abs(middle - d)) > largest_trusted_strain)
            return fmt::format("grain {} is strained by more than {:.0f} %: Eq. 41-46 are linear elasticity",
                               g, 100.0 * largest_trusted_strain);
    }
    double covered = 0.0;
    for (const GrainForces& sum : forces_) covered += sum.covered / static_cast<double>(size());
    if (options_.incompressible && covered > 1.0)
        return "contacts cover the whole outline of the mean grain: no pore is left, and Eq. 67 has no "
               "solution";
    for (std::size_t k = 0; k < pair_contact_.size(); ++k)
        if (pair_contact_[k].overlap == Overlap::four_points)
            return fmt::format("grains {} and {} cross in four points", neighbors_.pairs()[k].i,
                               neighbors_.pairs()[k].j);
    return std::nullopt;
}

}  // namespace softgrain::sdem
