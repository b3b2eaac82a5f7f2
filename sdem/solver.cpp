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
    const WallMotion before = motion_;
    const bool periodic = walls.box.periodic;
    const bool flow_changes =
        periodic && (walls.velocity != before.velocity || walls.tilt_rate != before.tilt_rate);
    motion_ = walls;
    const MotionInput input = motion_input();

    struct OfBlock {
        StepWork work;
        Mat2 flux = Mat2::Zero();
    };
    const Chunks grains = blocks();
    std::vector<OfBlock> part(grains.count());
    std::size_t bad = size();
#pragma omp parallel for schedule(static) reduction(min : bad) if (threads_pay_off())
    for (std::size_t block = 0; block < grains.count(); ++block) {
        const std::size_t begin = grains.begin(block), end = grains.end(block);
        if (periodic) part[block].flux = momentum_flux(before, begin, end);
        if (flow_changes) follow_flow(before, begin, end);
        part[block].work = move_grains(input, grains_, memory_, times, begin, end, bad);
    }
    Mat2 flux = Mat2::Zero();
    for (const OfBlock& p : part) flux += p.flux;
    add_boundary_work(ledger_, before, flux, lag_);
    add_boundary_work(ledger_, walls, flux, 0.5 * dt);
    for (const OfBlock& p : part) {
        if (!has_potential()) ledger_.elastic += p.work.stored;
        ledger_.damping += p.work.damped;
        ledger_.plastic += p.work.plastic;
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
void SoftDiscSolver::follow_flow(const WallMotion& before, std::size_t begin, std::size_t end) {
    WallMotion old = before;
    old.box = motion_.box;
    for (std::size_t g = begin; g < end; ++g) {
        Grain& grain = grains_.grain[g];
        const Vec2 x{grain.x, grain.y};
        const Vec2 change = motion_.affine_velocity(x) - old.affine_velocity(x);
        grain.vx += change.x();
        grain.vy += change.y();
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
    find_contacts();
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

void SoftDiscSolver::find_contacts() {
    const WallMotion lattice = cell();
    const bool with_rates = options_.contact_damping > 0.0 || options_.sliding.slides();
    const PairInput in{
        grains_,           contacts_.pairs(),        contacts_.images(), lattice, options_.motion.contact_law,
        options_.geometry, options_.contact_damping, with_rates};
    const PairOutput out{contacts_.pair_contact, contacts_.guess, contacts_.pair_opening,
                         contacts_.pair_history.slip_rate};
    const WallInput walls{grains_, lattice, options_.motion.contact_law, options_.contact_damping};
    guess_before_.resize(contacts_.guess.size());
    const Chunks pairs(contacts_.pairs().size(), pairs_per_chunk);
    const Chunks wall_pairs(contacts_.wall_pairs().size(), pairs_per_chunk);
    std::vector<PairNews> pair_news(pairs.count());
    std::vector<WallNews> wall_news(wall_pairs.count());
#pragma omp parallel if (threads_pay_off())
    {
#pragma omp for schedule(static) nowait
        for (std::size_t c = 0; c < wall_pairs.count(); ++c)
            wall_news[c] = evaluate_walls(walls, contacts_, wall_pairs.begin(c), wall_pairs.end(c));
#pragma omp for schedule(static)
        for (std::size_t c = 0; c < pairs.count(); ++c) {
            const auto guess = contacts_.guess.begin();
            std::copy(guess + pairs.begin(c), guess + pairs.end(c), guess_before_.begin() + pairs.begin(c));
            pair_news[c] = evaluate_pairs(in, out, pairs.begin(c), pairs.end(c));
        }
    }
    closed_pairs_.clear();
    closed_walls_.clear();
    for (const PairNews& n : pair_news) {
        if (n.bad.pair < contacts_.pairs().size()) throw_bad_pair(n.bad);
        closed_pairs_.insert(closed_pairs_.end(), n.closed.begin(), n.closed.end());
    }
    for (const WallNews& n : wall_news) {
        if (n.bad < contacts_.wall_pairs().size())
            throw DivergedError(packing_index(static_cast<std::size_t>(contacts_.wall_pairs()[n.bad].grain)),
                                "wall contact", time_,
                                "the grain went through a wall, or its cap is too deep for Eq. 57");
        closed_walls_.insert(closed_walls_.end(), n.closed.begin(), n.closed.end());
    }
}

void SoftDiscSolver::find_all_pressures() {
    pressures_.side.resize(contacts_);
    const Chunks grains = blocks(), pairs(contacts_.pairs().size(), pairs_per_chunk);
    std::size_t bad = size();
#pragma omp parallel if (threads_pay_off())
    {
#pragma omp for schedule(static) reduction(min : bad)
        for (std::size_t c = 0; c < grains.count(); ++c)
            bad = std::min(bad, find_pressures(grains_, options_.motion.grain_law, smallest_area_ratio,
                                               contacts_, pressures_, grains.begin(c), grains.end(c)));
#pragma omp for schedule(static)
        for (std::size_t c = 0; c < pairs.count(); ++c)
            find_pair_forces(pressures_.side, contacts_, pairs.begin(c), pairs.end(c));
    }
    find_wall_forces(pressures_.side, contacts_);
    if (bad < size())
        throw DivergedError(packing_index(bad), "area", time_,
                            "its contacts have squeezed the grain to nothing");
}

void SoftDiscSolver::slide(double dt) {
    const Chunks pairs(contacts_.pairs().size(), pairs_per_chunk);
    std::vector<SlidingWork> work(pairs.count());
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t c = 0; c < pairs.count(); ++c)
        work[c] = slide_pairs(options_.sliding, grains_, contacts_, dt, pairs.begin(c), pairs.end(c));
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
    const Chunks pairs(contacts_.pairs().size(), pairs_per_chunk);
    std::vector<CellStress> part(pairs.count());
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t c = 0; c < pairs.count(); ++c)
        for (std::size_t k = pairs.begin(c); k < pairs.end(c); ++k) add_stress(part[c], k);
    cell_stress_ = CellStress{};
    for (const CellStress& p : part) {
        cell_stress_.total += p.total / motion_.box.area();
        cell_stress_.damping += p.damping / motion_.box.area();
    }
}

/// What pair k adds, times the area of the cell.
void SoftDiscSolver::add_stress(CellStress& sum, std::size_t k) const {
    const Contact& c = contacts_.pair_contact[k];
    if (!c.touching()) return;
    const Pair& pair = contacts_.pairs()[k];
    const double dashpot = damping_without_pull(c.q, c.q_damping);
    const Vec2 chord{c.chord_x, c.chord_y};
    const Vec2 branch = grains_.center[static_cast<std::size_t>(pair.j)] -
                        grains_.center[static_cast<std::size_t>(pair.i)] +
                        lattice_.image(contacts_.images()[k]);
    Vec2 force = (c.q + dashpot) * chord;
    if (options_.sliding.slides()) force += contacts_.pair_history.tangential[k] * perpendicular(chord);
    sum.total += force * branch.transpose();
    sum.damping += dashpot * chord * branch.transpose();
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
