// One step of SDEM. Equation numbers: Mollon 2022 (see README.md for where they are corrected).
#include "sdem/solver.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/errors.hpp"
#include "common/space_order.hpp"
#include "sdem/wall_contacts.hpp"

namespace softgrain::sdem {
namespace {

constexpr std::size_t pairs_per_chunk = 128;
constexpr int steps_per_time_step_check = 16;
constexpr double worth_a_change = 1.25;
/// Threads are not tried with fewer grains.
constexpr std::size_t worth_threads = 400;

}  // namespace

SoftDiscSolver::SoftDiscSolver(std::vector<GrainMaterial> material, const Packing& packing,
                               const Options& options)
    : options_(options),
      threads_(packing.size() >= worth_threads ? omp_get_max_threads() : 1),
      rest_(options.rest_tolerance * packing.mean_radius()) {
    motion_.box = lattice_ = packing.box;
    skin_ = options.skin * packing.mean_radius();
    grains_.material = std::move(material);
    place(packing);
    height_energy_at_start_ = height_energy();
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
    contacts_.keeps_history = options_.sliding.needs_history();
    rebuild_contacts();
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
    return {forces(), pressures_.stress, options_.motion, motion_, motion_};
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
    wake_pushed(walls);
    put_to_rest(walls, dt);
    const StepTimes times{2.0 * lag_, lag_ + 0.5 * dt, dt};
    MotionInput input = motion_input();
    input.flow = walls;
    const Chunks grains = blocks();
    std::vector<StepWork> part(grains.count());
    std::size_t bad = size();
#pragma omp parallel for schedule(static) reduction(min : bad) if (threads_pay_off())
    for (std::size_t c = 0; c < grains.count(); ++c)
        if (!block_rests(c))
            part[c] = move_grains(input, grains_, memory_, times, grains.begin(c), grains.end(c), bad);
    wake_touched(dt);
    Tensor flux{0.0, 0.0, 0.0, 0.0};
    for (const StepWork& work : part) {
        if (!has_potential()) ledger_.elastic += work.stored;
        ledger_.damping += work.damped;
        ledger_.plastic += work.plastic;
        flux = flux + work.flux;
    }
    add_boundary_work(ledger_, motion_, flux, lag_);
    add_boundary_work(ledger_, walls, flux, 0.5 * dt);
    time_ += dt;
    lag_ = 0.5 * dt;
    ++steps_;
    motion_ = walls;
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
    start_rest();
}

void SoftDiscSolver::update_contacts(double dt) {
    const double start = omp_get_wtime();
    find_contacts();
    find_forces(dt);
    threads_.note(omp_get_wtime() - start);
    sum_wall_forces();
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

/// Contacts, and the pressures of the grains while their contacts are still at hand.
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
    if (has_potential()) pressures_.side.resize(contacts_);
    const Chunks parts = this->parts(), grains = blocks();
    std::vector<PairNews> pair_news(parts.count());
    std::vector<WallNews> wall_news(parts.count());
    std::vector<std::size_t> crushed(grains.count(), size());
    std::vector<char> later(grains.count(), 0);
    const auto press = [&](std::size_t block) {
        crushed[block] = find_pressures(grains_, options_.motion.grain_law, smallest_area_ratio, contacts_,
                                        pressures_, grains.begin(block), grains.end(block));
    };
#pragma omp parallel if (threads_pay_off())
    {
        // A thread does the parts from `first` on, one after the other: all contacts of a grain are then
        // known but for those with grains before `first`.
        std::size_t first = size();
#pragma omp for schedule(static)
        for (std::size_t part = 0; part < parts.count(); ++part) {
            const std::size_t begin = parts.begin(part), end = parts.end(part);
            const std::size_t pairs = contacts_.first(begin), pairs_end = contacts_.first(end);
            first = std::min(first, begin);
            if (rest_.resting(part)) continue;
            std::copy(contacts_.guess.begin() + pairs, contacts_.guess.begin() + pairs_end,
                      guess_before_.begin() + pairs);
            pair_news[part] = evaluate_pairs(in, out, pairs, pairs_end);
            wall_news[part] =
                evaluate_walls(walls, contacts_, contacts_.wall_first(begin), contacts_.wall_first(end));
            if (!has_potential()) continue;
            for (std::size_t block = begin / grains_per_block;
                 block < grains.count() && grains.begin(block) < end; ++block)
                if (contacts_.reach_below(first, grains.begin(block), grains.end(block)))
                    later[block] = 1;
                else
                    press(block);
        }
#pragma omp for schedule(static, 1)
        for (std::size_t block = 0; block < grains.count(); ++block)
            if (later[block] != 0) press(block);
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
    const std::size_t bad = *std::min_element(crushed.begin(), crushed.end());
    if (bad < size())
        throw DivergedError(packing_index(bad), "area", time_,
                            "its contacts have squeezed the grain to nothing");
}

template <class GrainOf, class First, class Visit>
void SoftDiscSolver::each_awake_stretch(std::size_t begin, std::size_t end, const GrainOf& grain_of,
                                        const First& first, const Visit& visit) const {
    std::size_t from = begin;
    for (std::size_t k = begin, next; k < end; k = next) {
        const std::size_t part = static_cast<std::size_t>(grain_of(k)) / grains_per_part;
        next = std::min(end, first(parts().end(part)));
        if (!rest_.resting(part)) continue;
        if (from < k) visit(from, k);
        from = next;
    }
    if (from < end) visit(from, end);
}

/// Forces of the contacts, what they remember, and the stress of a cell.
void SoftDiscSolver::find_forces(double dt) {
    struct OfPart {
        SlidingWork work;
        CellStress stress;
    };
    const bool slides = options_.sliding.acts(), periodic = motion_.box.periodic;
    const Chunks pairs(contacts_.pairs().size(), pairs_per_chunk);
    std::vector<OfPart> part(pairs.count());
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t c = 0; c < pairs.count(); ++c) {
        const std::size_t begin = pairs.begin(c), end = pairs.end(c);
        each_awake_stretch(
            begin, end, [&](std::size_t k) { return contacts_.pairs()[k].i; },
            [&](std::size_t g) { return contacts_.first(g); },
            [&](std::size_t from, std::size_t to) {
                if (has_potential()) find_pair_forces(pressures_.side, contacts_, from, to);
                if (slides) part[c].work.add(slide_pairs(options_.sliding, grains_, contacts_, dt, from, to));
            });
        for (std::size_t k = begin; periodic && k < end; ++k) add_stress(part[c].stress, k);
    }
    SlidingWork work;
    each_awake_stretch(
        0, contacts_.wall_pairs().size(), [&](std::size_t w) { return contacts_.wall_pairs()[w].grain; },
        [&](std::size_t g) { return contacts_.wall_first(g); },
        [&](std::size_t from, std::size_t to) {
            if (has_potential()) find_wall_forces(pressures_.side, contacts_, from, to);
            if (slides) work.add(slide_walls(options_.sliding, grains_, contacts_, dt, from, to));
        });
    cell_stress_ = CellStress{};
    for (const OfPart& p : part) {
        work.add(p.work);
        cell_stress_.total += p.stress.total / motion_.box.area();
        cell_stress_.damping += p.stress.damping / motion_.box.area();
    }
    ledger_.friction += work.friction;
    ledger_.adhesion += work.adhesion;
    if (!has_potential()) ledger_.elastic -= work.friction + work.adhesion;
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

/// Pair k's share in the Love-Weber stress of the cell, compression positive, times its area: f on j (x)
/// branch from i to j.
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
