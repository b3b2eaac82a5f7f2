// One step of SDEM. Equation numbers: Mollon 2022 (see README.md for where they are corrected).
#include "sdem/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/errors.hpp"
#include "sdem/space_order.hpp"
#include "sdem/wall_contacts.hpp"

namespace softgrain::sdem {
namespace {

constexpr std::size_t pairs_per_chunk = 128;
constexpr int steps_per_time_step_check = 16;
constexpr double worth_a_change = 1.25;

}  // namespace

SoftDiscSolver::SoftDiscSolver(std::vector<GrainMaterial> material, const Packing& packing,
                               const Options& options)
    : options_(options) {
    motion_.box = lattice_ = packing.box;
    skin_ = options.skin * packing.mean_radius();
    grains_.material = std::move(material);
    place(packing);
    const std::size_t n = size();
    if (has_potential()) {
        pressures_.stress.assign(n, 0.0);
        pressures_.inflated.assign(n, Inflated{});
    }
    if (options_.motion.plastic) {
        memory_.plastic_xx.assign(n, 1.0);
        memory_.plastic_xy.assign(n, 0.0);
        memory_.plastic_yy.assign(n, 1.0);
    }
    contacts_.keeps_openings = !has_potential();
    rebuild_contacts();
    if (options_.sliding.needs_history()) {
        contacts_.pair_history.resize(contacts_.pairs().size());
        contacts_.wall_history.resize(contacts_.wall_pairs().size());
    }
    update_contacts(0.0);
    if (options_.motion.imposes_area)
        for (std::size_t g = 0; g < n; ++g) {
            const GrainSums sums = sum_contacts(forces(), g);
            memory_.caps_before.push_back(Mollon2022::cap_fraction(sums.caps, covered_outline(contacts_, g),
                                                                   grains_.grain[g].reference_area()));
        }
}

/// Grains in the order of space.
void SoftDiscSolver::place(const Packing& packing) {
    grains_.original = space_order(packing.center, 2.0 * packing.mean_radius());
    for (const int original : grains_.original) {
        const auto p = static_cast<std::size_t>(original);
        const std::size_t grain_class = packing.class_of(p);
        const Vec2 half_axes = packing.half_axes(p);
        Grain g{};
        g.x = packing.center[p].x();
        g.y = packing.center[p].y();
        g.F = {1.0, 0.0, 0.0, 1.0};
        if (!packing.angle.empty()) {
            const double c = std::cos(packing.angle[p]), s = std::sin(packing.angle[p]);
            g.F = {c, -s, s, c};
        }
        g.a = half_axes.x();
        g.b = half_axes.y();
        g.radius = packing.radius[p];
        g.mass = grains_.material[grain_class].density * g.reference_area();
        grains_.grain.push_back(g);
        grains_.center.push_back(packing.center[p]);
        grains_.next_center.push_back(packing.center[p]);
        grains_.reach.push_back(reach_of(g));
        if (grains_.material.size() > 1)
            grains_.grain_class.push_back(static_cast<std::uint8_t>(grain_class));
    }
}

ForceSource SoftDiscSolver::forces() const {
    return {contact_view(), options_.sliding.slides()};
}

MotionInput SoftDiscSolver::motion_input() const {
    return {forces(), pressures_.stress, options_.motion, motion_};
}

/// E, its mean over the grains' areas.
double SoftDiscSolver::stress_scale() const {
    double sum = 0.0, area = 0.0;
    for (std::size_t g = 0; g < size(); ++g) {
        sum += grains_.grain[g].reference_area() * grains_.material_of(g).E;
        area += grains_.grain[g].reference_area();
    }
    return sum / area;
}

void SoftDiscSolver::advance(const WallMotion& walls, double dt) {
    const StepTimes times{2.0 * lag_, lag_ + 0.5 * dt, dt};
    add_boundary_work(ledger_, motion_, lag_);
    add_boundary_work(ledger_, walls, 0.5 * dt);
    if (walls.box.periodic) follow_flow(walls);
    motion_ = walls;

    std::vector<StepWork> work(blocks());
    std::size_t bad = size();
    const MotionInput input = motion_input();
#pragma omp parallel for schedule(static) reduction(min : bad) if (threads_pay_off())
    for (std::size_t block = 0; block < blocks(); ++block) {
        const std::size_t begin = block * grains_per_block, end = std::min(size(), begin + grains_per_block);
        work[block] = move_grains(input, grains_, memory_, times, begin, end, bad);
    }
    for (const StepWork& w : work) {
        if (!has_potential()) ledger_.elastic += w.stored;
        ledger_.damping += w.damped;
        ledger_.plastic += w.plastic;
    }
    time_ += dt;
    lag_ = 0.5 * dt;
    ++steps_;
    motion_.box = walls.after(dt);
    lattice_ = cell().box;
    grains_.center.swap(grains_.next_center);  // next_center now holds the last one
    if (bad < size()) throw_bad_grain(bad);
    refresh_contacts(dt);
    watch_energy();
}

void SoftDiscSolver::refresh_contacts(double dt) {
    if (contacts_.stale(grains_, lattice_)) rebuild_contacts();
    update_contacts(dt);
}

/// A periodic cell that changes its velocity takes the grains along: velocities are kept against its flow.
void SoftDiscSolver::follow_flow(const WallMotion& walls) {
    if (walls.velocity == motion_.velocity && walls.tilt_rate == motion_.tilt_rate) return;
    WallMotion old = motion_;
    old.box = walls.box;
    for (Grain& g : grains_.grain) {
        const Vec2 change = walls.affine_velocity(Vec2{g.x, g.y}) - old.affine_velocity(Vec2{g.x, g.y});
        g.vx += change.x();
        g.vy += change.y();
    }
}

/// Candidates afresh. In a periodic cell grains are put back into it, on the least tilted lattice.
void SoftDiscSolver::rebuild_contacts() {
    if (motion_.box.periodic) {
        flips_ = motion_.box.flips();
        const WallMotion lattice = cell();
        for (std::size_t g = 0; g < size(); ++g) {
            const Image image = lattice.box.image_of(grains_.center[g]);
            if (image == Image{}) continue;
            const Vec2 offset = lattice.box.image(image), velocity = lattice.image_velocity(image);
            Grain& grain = grains_.grain[g];
            grain.x -= offset.x();
            grain.y -= offset.y();
            grain.vx -= velocity.x();
            grain.vy -= velocity.y();
            grains_.center[g] = Vec2{grain.x, grain.y};
        }
    }
    lattice_ = cell().box;
    try {
        contacts_.build(grains_.center, grains_.reach, lattice_, skin_);
    } catch (const InputError& error) {
        if (steps_ == 0) throw;
        const auto largest = std::max_element(grains_.reach.begin(), grains_.reach.end());
        throw DivergedError(packing_index(static_cast<std::size_t>(largest - grains_.reach.begin())), "F",
                            time_, error.what());
    }
    contacts_.find_shares(grains_);
}

void SoftDiscSolver::update_contacts(double dt) {
    guess_before_ = contacts_.guess;
    closed_pairs_.clear();
    evaluate_all_pairs();
    evaluate_all_walls();
    if (has_potential()) find_all_pressures();
    if (options_.sliding.acts()) slide(dt);
    sum_wall_forces();
    if (motion_.box.periodic) sum_cell_stress();
    limit_time_step(dt);
}

/// Stiffness grows slowly, and all at once where a contact closes. A step that follows every change of the
/// limit would feed energy in: it is kept until it is too long, or a good deal too short.
void SoftDiscSolver::limit_time_step(double dt) {
    if (time_step_ == 0.0) {
        time_step_ = time_step_limit();
    } else if (dt > 0.0 && steps_ % steps_per_time_step_check == 0) {
        const double limit = time_step_limit();
        if (limit < time_step_ || limit > worth_a_change * time_step_) time_step_ = limit;
    } else if (dt > 0.0) {
        heed_closed_contacts();
    }
}

void SoftDiscSolver::evaluate_all_pairs() {
    const WallMotion lattice = cell();
    const bool with_rates = options_.contact_damping > 0.0 || options_.sliding.slides();
    const PairInput in{
        grains_,           contacts_.pairs(),        contacts_.images(), lattice, options_.motion.contact_law,
        options_.geometry, options_.contact_damping, with_rates};
    const PairOutput out{contacts_.pair_contact, contacts_.guess, contacts_.pair_opening,
                         contacts_.pair_history.slip_rate};
    const std::size_t pairs = contacts_.pairs().size();
    const std::size_t chunks = (pairs + pairs_per_chunk - 1) / pairs_per_chunk;
    std::vector<PairNews> news(chunks);
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t begin = chunk * pairs_per_chunk;
        news[chunk] = evaluate_pairs(in, out, begin, std::min(pairs, begin + pairs_per_chunk));
    }
    for (const PairNews& n : news) {
        if (n.bad.pair < pairs) throw_bad_pair(n.bad);
        closed_pairs_.insert(closed_pairs_.end(), n.closed.begin(), n.closed.end());
    }
}

void SoftDiscSolver::evaluate_all_walls() {
    const WallNews news =
        evaluate_walls({grains_, cell(), options_.motion.contact_law, options_.contact_damping}, contacts_);
    closed_walls_ = news.closed;
    if (news.bad < contacts_.wall_pairs().size())
        throw DivergedError(packing_index(static_cast<std::size_t>(contacts_.wall_pairs()[news.bad].grain)),
                            "wall contact", time_,
                            "the grain went through a wall, or its cap is too deep for Eq. 57");
}

void SoftDiscSolver::find_all_pressures() {
    const std::size_t pairs = contacts_.pairs().size();
    pressures_.side.resize(contacts_);
    std::size_t bad = size();
#pragma omp parallel for schedule(static) reduction(min : bad) if (threads_pay_off())
    for (std::size_t block = 0; block < blocks(); ++block) {
        const std::size_t begin = block * grains_per_block, end = std::min(size(), begin + grains_per_block);
        bad = std::min(bad, find_pressures(grains_, options_.motion.grain_law, smallest_area_ratio, contacts_,
                                           pressures_, begin, end));
    }
    if (bad < size())
        throw DivergedError(packing_index(bad), "area", time_,
                            "its contacts have squeezed the grain to nothing");
    const std::size_t chunks = (pairs + pairs_per_chunk - 1) / pairs_per_chunk;
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t first = chunk * pairs_per_chunk;
        find_pair_forces(pressures_.side, contacts_, first, std::min(pairs, first + pairs_per_chunk));
    }
    find_wall_forces(pressures_.side, contacts_);
}

void SoftDiscSolver::slide(double dt) {
    const std::size_t pairs = contacts_.pairs().size();
    const std::size_t chunks = (pairs + pairs_per_chunk - 1) / pairs_per_chunk;
    std::vector<SlidingWork> work(chunks);
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
        const std::size_t begin = chunk * pairs_per_chunk;
        work[chunk] = slide_pairs(options_.sliding, grains_, contacts_, dt, begin,
                                  std::min(pairs, begin + pairs_per_chunk));
    }
    SlidingWork sum;
    for (const SlidingWork& w : work) sum.add(w);
    sum.add(slide_walls(options_.sliding, grains_, contacts_, dt));
    ledger_.friction += sum.friction;
    ledger_.adhesion += sum.adhesion;
    if (!has_potential()) ledger_.elastic -= sum.friction + sum.adhesion;
}

void SoftDiscSolver::sum_wall_forces() {
    wall_force_.fill(Vec2::Zero());
    wall_damping_force_.fill(Vec2::Zero());
    for (std::size_t k = 0; k < contacts_.wall_pairs().size(); ++k) {
        const Contact& c = contacts_.wall_contact[k];
        if (!c.touching()) continue;
        const auto w = static_cast<std::size_t>(contacts_.wall_pairs()[k].wall);
        const double q = c.q, dashpot = damping_without_pull(q, c.q_damping);
        const Vec2 chord{c.chord_x, c.chord_y};
        wall_force_[w] += (q + dashpot) * chord;
        wall_damping_force_[w] += dashpot * chord;
        if (options_.sliding.slides())
            wall_force_[w] += contacts_.wall_history.tangential[k] * perpendicular(chord);
    }
}

/// Love-Weber stress of the cell, compression positive: (1/A) sum f on j (x) branch from i to j.
void SoftDiscSolver::sum_cell_stress() {
    cell_stress_ = CellStress{};
    for (std::size_t k = 0; k < contacts_.pairs().size(); ++k) {
        const Contact& c = contacts_.pair_contact[k];
        if (!c.touching()) continue;
        const Pair& pair = contacts_.pairs()[k];
        const double q = c.q, dashpot = damping_without_pull(q, c.q_damping);
        const Vec2 chord{c.chord_x, c.chord_y};
        const Vec2 branch = grains_.center[static_cast<std::size_t>(pair.j)] -
                            grains_.center[static_cast<std::size_t>(pair.i)] +
                            lattice_.image(contacts_.images()[k]);
        Vec2 force = (q + dashpot) * chord;
        if (options_.sliding.slides()) force += contacts_.pair_history.tangential[k] * perpendicular(chord);
        cell_stress_.total += force * branch.transpose();
        cell_stress_.damping += dashpot * chord * branch.transpose();
    }
    cell_stress_.total /= motion_.box.area();
    cell_stress_.damping /= motion_.box.area();
}

void SoftDiscSolver::throw_bad_grain(std::size_t g) const {
    const Grain& grain = grains_.grain[g];
    const double step = (grains_.center[g] - grains_.next_center[g]).norm();
    if (!(step <= 0.5 * grain.radius))
        throw DivergedError(
            packing_index(g), "position", time_,
            fmt::format("moved {:.3g} radii in one step; use a smaller sdem.safety", step / grain.radius));
    if (grain.F.det() > smallest_area_ratio)
        throw DivergedError(packing_index(g), "F", time_,
                            fmt::format("the grain is stretched to {:.3g} of its undeformed size",
                                        grains_.reach[g] / std::max(grain.a, grain.b)));
    throw DivergedError(packing_index(g), "det F", time_,
                        fmt::format("{:.3g}: the grain is crushed or inside out", grain.F.det()));
}

void SoftDiscSolver::throw_bad_pair(const BadPair& bad) const {
    const Pair& pair = contacts_.pairs()[bad.pair];
    const auto why = [&]() -> const char* {
        switch (bad.overlap) {
            case Overlap::contained:
                return "one grain lies inside the other";
            case Overlap::coincident:
                return "the two centres coincide";
            default:
                return "the caps are too deep for Eq. 57";
        }
    };
    int i = packing_index(static_cast<std::size_t>(pair.i)),
        j = packing_index(static_cast<std::size_t>(pair.j));
    if (i > j) std::swap(i, j);
    throw DivergedError(i, "contact", time_, fmt::format("with grain {}: {}", j, why()));
}

}  // namespace softgrain::sdem
