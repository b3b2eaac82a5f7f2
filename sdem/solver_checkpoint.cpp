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

void save_history(Checkpoint& to, const std::string& name, const ContactHistory& history) {
    to.put("sdem." + name + "_spring", history.spring);
    to.put("sdem." + name + "_adhesion", history.adhesion);
    to.put("sdem." + name + "_lens", history.lens);
    to.put("sdem." + name + "_tangential", history.tangential);
}

void load_history(const Checkpoint& from, const std::string& name, std::size_t size,
                  ContactHistory& history) {
    history.resize(size);
    get_sized(from, "sdem." + name + "_spring", size, history.spring);
    get_sized(from, "sdem." + name + "_adhesion", size, history.adhesion);
    get_sized(from, "sdem." + name + "_lens", size, history.lens);
    get_sized(from, "sdem." + name + "_tangential", size, history.tangential);
}

}  // namespace

/// Forces and contacts are not stored: they are found again, bit by bit, from what is. Grains in the order of
/// the packing, all else in the order kept.
void SoftDiscSolver::save(Checkpoint& to) const {
    const std::size_t n = size();
    std::vector<Vec2> position(n), velocity(n);
    std::vector<Mat2> F(n), F_rate(n);
    for (std::size_t g = 0; g < n; ++g) {
        const auto p = static_cast<std::size_t>(grains_.original[g]);
        const Grain& grain = grains_.grain[g];
        position[p] = Vec2{grain.x, grain.y};
        velocity[p] = Vec2{grain.vx, grain.vy};
        F[p] = matrix_of(grain.F);
        F_rate[p] = matrix_of(grain.F_rate);
    }
    to.put("sdem.position", std::span<const Vec2>(position));
    to.put("sdem.velocity", std::span<const Vec2>(velocity));
    to.put("sdem.F", std::span<const Mat2>(F));
    to.put("sdem.F_rate", std::span<const Mat2>(F_rate));
    to.put("sdem.time", time_);
    to.put("sdem.lag", lag_);
    to.put("sdem.time_step", time_step_);
    to.put("sdem.counters", std::vector<std::int64_t>{steps_, flips_});
    to.put("sdem.box", std::span<const double>(motion_.box.position));
    to.put("sdem.tilt", std::vector<double>{motion_.box.tilt, motion_.tilt_rate});
    to.put("sdem.wall_velocity", std::span<const double>(motion_.velocity));
    const NeighborList& list = contacts_.neighbors();
    to.put("sdem.built_at", list.built_at());
    to.put("sdem.built_reach", list.built_reach());
    to.put("sdem.built_box", std::span<const double>(contacts_.built_box().position));
    to.put("sdem.built_tilt", contacts_.built_box().tilt);
    std::vector<float> ends;
    for (const ChordGuess& guess : guess_before_)
        ends.insert(ends.end(), {guess.ax, guess.ay, guess.bx, guess.by});
    to.put("sdem.guess", std::vector<double>(ends.begin(), ends.end()));
    std::vector<double> restraint;
    for (const Restraint& r : restraint_) restraint.insert(restraint.end(), {r.stiffness, r.viscosity});
    to.put("sdem.restraint", restraint);
    to.put("sdem.caps_before", memory_.caps_before);
    to.put("sdem.plastic_xx", memory_.plastic_xx);
    to.put("sdem.plastic_xy", memory_.plastic_xy);
    to.put("sdem.plastic_yy", memory_.plastic_yy);
    if (options_.sliding.needs_history()) {
        save_history(to, "pair", contacts_.pair_history);
        save_history(to, "wall", contacts_.wall_history);
    }
    to.put("sdem.energy", std::vector<double>{ledger_.elastic, ledger_.external_work, ledger_.damping,
                                              ledger_.friction, ledger_.plastic, ledger_.adhesion});
    if (rest_.used()) save_rest(to);
}

void SoftDiscSolver::load(const Checkpoint& from) {
    const std::size_t n = size();
    std::vector<Vec2> position, velocity;
    std::vector<Mat2> F, F_rate;
    get_sized(from, "sdem.position", n, position);
    get_sized(from, "sdem.velocity", n, velocity);
    get_sized(from, "sdem.F", n, F);
    get_sized(from, "sdem.F_rate", n, F_rate);
    for (std::size_t g = 0; g < n; ++g) {
        const auto p = static_cast<std::size_t>(grains_.original[g]);
        Grain& grain = grains_.grain[g];
        grain.x = position[p].x();
        grain.y = position[p].y();
        grain.vx = velocity[p].x();
        grain.vy = velocity[p].y();
        grain.F = tensor_of(F[p]);
        grain.F_rate = tensor_of(F_rate[p]);
        grains_.center[g] = position[p];
        grains_.reach[g] = reach_of(grain);
    }
    time_ = from.number("sdem.time");
    lag_ = from.number("sdem.lag");
    time_step_ = from.number("sdem.time_step");
    std::vector<std::int64_t> counters;
    get_sized(from, "sdem.counters", 2, counters);
    steps_ = counters[0];
    flips_ = static_cast<int>(counters[1]);
    std::vector<double> tilt;
    get_sized(from, "sdem.tilt", 2, tilt);
    motion_.box.position = four(from, "sdem.box");
    motion_.box.tilt = tilt[0];
    motion_.tilt_rate = tilt[1];
    motion_.velocity = four(from, "sdem.wall_velocity");
    if (options_.motion.imposes_area) get_sized(from, "sdem.caps_before", n, memory_.caps_before);
    if (options_.motion.plastic) {
        get_sized(from, "sdem.plastic_xx", n, memory_.plastic_xx);
        get_sized(from, "sdem.plastic_xy", n, memory_.plastic_xy);
        get_sized(from, "sdem.plastic_yy", n, memory_.plastic_yy);
    }
    std::vector<double> restraint;
    get_sized(from, "sdem.restraint", 2 * n, restraint);
    for (std::size_t g = 0; g < n; ++g) restraint_[g] = {restraint[2 * g], restraint[2 * g + 1]};
    std::vector<double> energy;
    get_sized(from, "sdem.energy", 6, energy);
    ledger_ = EnergyLedger{};
    ledger_.elastic = energy[0];
    ledger_.external_work = energy[1];
    ledger_.damping = energy[2];
    ledger_.friction = energy[3];
    ledger_.plastic = energy[4];
    ledger_.adhesion = energy[5];

    std::vector<Vec2> built_at;
    std::vector<double> built_reach, ends;
    get_sized(from, "sdem.built_at", n, built_at);
    get_sized(from, "sdem.built_reach", n, built_reach);
    Box built = motion_.box;
    built.position = four(from, "sdem.built_box");
    built.tilt = from.number("sdem.built_tilt");
    contacts_.build(built_at, built_reach, built, contacts_.neighbors().skin());
    contacts_.find_shares(grains_);
    get_sized(from, "sdem.guess", 4 * contacts_.pairs().size(), ends);
    for (std::size_t k = 0; k < contacts_.guess.size(); ++k)
        contacts_.guess[k] = {static_cast<float>(ends[4 * k]), static_cast<float>(ends[4 * k + 1]),
                              static_cast<float>(ends[4 * k + 2]), static_cast<float>(ends[4 * k + 3])};
    if (options_.sliding.needs_history()) {
        load_history(from, "pair", contacts_.pairs().size(), contacts_.pair_history);
        load_history(from, "wall", contacts_.wall_pairs().size(), contacts_.wall_history);
    }
    lattice_ = cell().box;
    if (rest_.used()) load_rest(from);
    balance_ = Balance{};
    refresh_contacts(0.0);  // no new candidates for a state as it was saved
}

void SoftDiscSolver::check_finite() const {
    for (std::size_t p = 0; p < size(); ++p) {
        const Grain& g = grains_.grain[p];
        const auto check = [&](double value, const char* quantity) {
            if (!std::isfinite(value))
                throw DivergedError(packing_index(p), quantity, time_, "not a finite number");
        };
        check(g.x + g.y, "position");
        check(g.vx + g.vy, "velocity");
        check(g.F.trace() + g.F.squared(), "F");
        check(g.F_rate.trace() + g.F_rate.squared(), "F rate");
        const GrainSums sums = sum_contacts(forces(), p);
        check(sums.fx + sums.fy, "force");
        check(sums.moment.trace() + sums.moment.squared() + sums.pressed, "moment");
    }
}

std::optional<std::string> SoftDiscSolver::outside_validity() const {
    double covered = 0.0;
    for (std::size_t g = 0; g < size(); ++g) {
        const Tensor& F = grains_.grain[g].F;
        const double middle = 0.5 * Polar(F).trace - 1.0, d = half_stretch_difference(F);
        if (std::max(std::abs(middle + d), std::abs(middle - d)) > largest_trusted_strain)
            return fmt::format("grain {} is strained by more than {:.0f} %: the law was checked up to there",
                               packing_index(g), 100.0 * largest_trusted_strain);
        if (options_.motion.imposes_area)
            covered += covered_outline(contacts_, g) / static_cast<double>(size());
    }
    if (covered > 1.0)
        return "contacts cover the whole outline of the mean grain: no pore is left, and Eq. 67 has no "
               "solution";
    return std::nullopt;
}

}  // namespace softgrain::sdem
