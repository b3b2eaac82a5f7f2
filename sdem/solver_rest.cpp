// Parts whose grains are at rest are neither moved nor asked for contacts; what they exert, on each other and
// on the rest, stays as it was.
#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "sdem/solver.hpp"

namespace softgrain::sdem {
namespace {

/// Between two looks at whether the forces on slow parts balance, which costs as much as a kick.
constexpr int steps_between_looks = 16;

std::uint32_t part_of(int grain) {
    return static_cast<std::uint32_t>(grain) / static_cast<std::uint32_t>(grains_per_part);
}

}  // namespace

void SoftDiscSolver::start_rest() {
    if (!rest_.used()) return;
    std::vector<std::vector<std::uint32_t>> neighbors(parts().count());
    const auto add = [&](std::uint32_t part, std::uint32_t other) {
        auto& known = neighbors[part];
        if (std::find(known.begin(), known.end(), other) == known.end()) known.push_back(other);
    };
    for (const Pair& pair : contacts_.pairs()) {
        const std::uint32_t i = part_of(pair.i), j = part_of(pair.j);
        if (i == j) continue;
        add(i, j);
        add(j, i);
    }
    rest_.start(std::move(neighbors));
}

/// True if the cell, or a wall that a grain of the part touches or may soon touch, moves.
bool SoftDiscSolver::is_pushed(std::size_t part, const WallMotion& walls) const {
    const auto moves = [](double velocity) { return velocity != 0.0; };
    if (walls.box.periodic)
        return moves(walls.tilt_rate) || std::any_of(walls.velocity.begin(), walls.velocity.end(), moves);
    const auto near = contacts_.wall_pairs();
    return std::any_of(near.begin() + contacts_.wall_first(parts().begin(part)),
                       near.begin() + contacts_.wall_first(parts().end(part)), [&](const WallPair& pair) {
                           return moves(walls.velocity[static_cast<std::size_t>(pair.wall)]);
                       });
}

void SoftDiscSolver::wake_pushed(const WallMotion& walls) {
    for (std::size_t p = 0; rest_.used() && p < parts().count(); ++p)
        if (rest_.resting(p) && is_pushed(p, walls)) rest_.wake(p);
}

/// Tells what has moved, and wakes what is beside it.
void SoftDiscSolver::wake_touched(double dt) {
    if (!rest_.used()) return;
    const Chunks part = parts();
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t p = 0; p < part.count(); ++p) {
        if (rest_.resting(p)) continue;
        double speed2 = 0.0, rim2 = 0.0;
        for (std::size_t g = part.begin(p); g < part.end(p); ++g) {
            const Grain& grain = grains_.grain[g];
            const double longest = std::max(grain.a, grain.b);
            speed2 = std::max(speed2, grain.vx * grain.vx + grain.vy * grain.vy);
            rim2 = std::max(rim2, grain.F_rate.squared() * longest * longest);
        }
        rest_.moved(p, (std::sqrt(speed2) + std::sqrt(rim2)) * dt);
    }
    rest_.wake_beside_motion();
}

/// True if no grain of the part would be accelerated from rest by more, its outline included.
bool SoftDiscSolver::is_balanced(std::size_t part, double largest_acceleration) const {
    const MotionInput input = motion_input();
    MotionBlock block;
    const std::size_t end = parts().end(part);
    for (std::size_t begin = parts().begin(part); begin < end; begin += grains_per_block) {
        kick_from_rest(block, input, grains_, memory_, begin, std::min(end, begin + grains_per_block));
        for (int l = 0; l < block.count; ++l) {
            const double rim = std::sqrt(block.new_rate[l].squared()) * std::max(block.a[l], block.b[l]);
            if (!(std::hypot(block.new_vx[l], block.new_vy[l]) + rim <= largest_acceleration)) return false;
        }
    }
    return true;
}

/// Parts that have been slow and are balanced lose what motion they have. Before a step and not after one: a
/// restart finds contacts by the velocities that are saved.
void SoftDiscSolver::put_to_rest(const WallMotion& walls, double dt) {
    if (!rest_.used() || steps_ % steps_between_looks != 0) return;
    const double largest_acceleration = rest_.largest_acceleration(options_.motion.gravity, dt);
    std::vector<StepWork> lost(parts().count());
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t p = 0; p < lost.size(); ++p)
        if (rest_.slow(p) && !is_pushed(p, walls) && is_balanced(p, largest_acceleration))
            lost[p] = come_to_rest(p);
    for (const StepWork& work : lost) {
        ledger_.damping += work.damped + work.kinetic;
        if (!has_potential()) ledger_.elastic += work.stored;
    }
}

/// The work of the half step by which velocities are behind, and the kinetic energy then.
StepWork SoftDiscSolver::come_to_rest(std::size_t part) {
    rest_.put_to_rest(part);
    const MotionInput input = motion_input();
    const std::size_t first = parts().begin(part), last = parts().end(part);
    StepWork lost;
    for (std::size_t begin = first; begin < last; begin += grains_per_block) {
        const StepWork work = kick_work(input, grains_, memory_, {2.0 * lag_, lag_, 0.0}, begin,
                                        std::min(last, begin + grains_per_block));
        lost.stored += work.stored;
        lost.damped += work.damped;
        lost.kinetic += work.kinetic;
    }
    for (std::size_t g = first; g < last; ++g) {
        Grain& grain = grains_.grain[g];
        grain.vx = grain.vy = 0.0;
        grain.F_rate = Tensor{0.0, 0.0, 0.0, 0.0};
        grains_.next_center[g] = grains_.center[g];
    }
    std::copy(contacts_.guess.begin() + contacts_.first(first),
              contacts_.guess.begin() + contacts_.first(last),
              guess_before_.begin() + contacts_.first(first));
    // A contact that closes now is pushed from the other side only.
    if (has_potential())
        each_push(*this, part, [](double& push, const Contact& contact) {
            if (!contact.touching()) push = 0.0;
        });
    return lost;
}

template <class Self, class Visit>
void SoftDiscSolver::each_push(Self& solver, std::size_t part, const Visit& visit) {
    auto& contacts = solver.contacts_;
    auto& side = solver.pressures_.side;
    for (std::size_t g = solver.parts().begin(part); g < solver.parts().end(part); ++g) {
        for (std::size_t w = contacts.wall_first(g); w < contacts.wall_first(g + 1); ++w)
            visit(side.wall[w], contacts.wall_contact[w]);
        for (std::size_t k = contacts.first(g); k < contacts.first(g + 1); ++k)
            visit(side.pair[k].i, contacts.pair_contact[k]);
        for (const std::uint32_t k : contacts.second(g)) visit(side.pair[k].j, contacts.pair_contact[k]);
    }
}

template <class Self, class Visit>
void SoftDiscSolver::each_kept_value(Self& solver, const Visit& visit) {
    auto& contacts = solver.contacts_;
    auto& pressures = solver.pressures_;
    const auto visit_contact = [&](auto& c) {
        for (auto* value :
             {&c.chord_x, &c.chord_y, &c.arm_x, &c.arm_y, &c.cap_i, &c.cap_j, &c.q, &c.q_damping})
            visit(*value);
    };
    const Chunks parts = solver.parts();
    for (std::size_t p = 0; p < parts.count(); ++p) {
        if (!solver.rest_.resting(p)) continue;
        const std::size_t begin = parts.begin(p), end = parts.end(p);
        for (std::size_t k = contacts.first(begin); k < contacts.first(end); ++k) {
            visit_contact(contacts.pair_contact[k]);
            if (!contacts.keeps_openings) continue;
            visit(contacts.pair_opening[k].psi_i);
            visit(contacts.pair_opening[k].psi_j);
        }
        for (std::size_t w = contacts.wall_first(begin); w < contacts.wall_first(end); ++w) {
            visit_contact(contacts.wall_contact[w]);
            visit(contacts.wall_opening[w].psi_i);
        }
        if (!solver.has_potential()) continue;
        for (std::size_t g = begin; g < end; ++g) {
            auto& in = pressures.inflated[g];
            visit(pressures.stress[g]);
            for (auto* value : {&in.pressure, &in.per_area, &in.at_q0, &in.at_q1, &in.at_q1_squared})
                visit(*value);
        }
        each_push(solver, p, [&](auto& push, const Contact&) { visit(push); });
    }
}

void SoftDiscSolver::save_rest(Checkpoint& to) const {
    rest_.save(to);
    std::vector<double> kept;
    each_kept_value(*this, [&](double value) { kept.push_back(value); });
    to.put("sdem.kept_at_rest", kept);
}

/// After the list of contacts, before they are found.
void SoftDiscSolver::load_rest(const Checkpoint& from) {
    start_rest();
    rest_.load(from);
    grains_.next_center = grains_.center;
    guess_before_ = contacts_.guess;
    if (has_potential()) pressures_.side.resize(contacts_);
    std::vector<double> kept;
    from.get("sdem.kept_at_rest", kept);
    std::size_t size = 0;
    each_kept_value(*this, [&](double) { ++size; });
    if (kept.size() != size)
        throw InputError("checkpoint array 'sdem.kept_at_rest' does not fit this packing");
    auto next = kept.begin();
    each_kept_value(*this, [&](auto& value) { value = static_cast<std::decay_t<decltype(value)>>(*next++); });
}

}  // namespace softgrain::sdem
