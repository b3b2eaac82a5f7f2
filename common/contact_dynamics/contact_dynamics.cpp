#include "common/contact_dynamics/contact_dynamics.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "common/contact_dynamics/relaxation.hpp"
#include "common/errors.hpp"

namespace softgrain {

ContactDynamics::ContactDynamics(const ContactSettings& settings) : settings_(settings) {
    if (!(settings.tolerance > 0.0) || !(settings.skin > 0.0) || settings.max_iterations < 1 ||
        !(settings.over_relaxation > 0.0 && settings.over_relaxation < 2.0) ||
        !(settings.largest_push > 0.0) || settings.block_discs < 1)
        throw InputError(
            "contact dynamics: tolerance and skin must be > 0, max_iterations >= 1, over_relaxation between "
            "0 and 2, largest_push > 0, block_discs >= 1");
    for (const contact_sweep::Resistance& r : {settings_.within, settings_.between})
        if (!(r.friction >= 0.0) || !(r.rolling >= 0.0))
            throw InputError("contact dynamics: friction and rolling resistance must be >= 0");
}

ContactResult ContactDynamics::solve(const Discs& discs, const WallMotion& walls, double h, bool threads) {
    if (discs.x.empty()) return {.converged = true};
    if (stale(discs, walls, h, threads)) rebuild(discs, walls.box);
    if (last_step_ > 0.0 && last_step_ != h) scale_impulses(h / last_step_);
    last_step_ = h;
    return Relaxation(rows_, wall_rows_, blocks_, discs, walls, h, settings_).run(threads);
}

bool ContactDynamics::stale(const Discs& discs, const WallMotion& walls, double h, bool threads) const {
    if (built_at_.size() != discs.x.size()) return true;
    double moved = 0.0;
#pragma omp parallel for schedule(static) reduction(max : moved) if (threads)
    for (std::size_t d = 0; d < discs.x.size(); ++d)
        moved = std::max(moved, (discs.x[d] + h * discs.v[d] - built_at_[d]).squaredNorm());
    moved = std::sqrt(moved);
    double wall_moved = 0.0;
    const Box after = walls.after(h);
    for (std::size_t w = 0; w < 4; ++w)
        wall_moved = std::max(wall_moved, std::abs(after.position[w] - built_box_.position[w]));
    return moved + std::max(moved, wall_moved) >= settings_.skin;
}

void ContactDynamics::exclude(std::span<const Pair> pairs, const Discs& discs, const Box& box) {
    excluded_.assign(pairs.begin(), pairs.end());
    if (!built_at_.empty()) rebuild(discs, box);
}

void ContactDynamics::rebuild(const Discs& discs, const Box& box) {
    const ContactRows old_rows = std::move(rows_);
    const WallRows old_walls = std::move(wall_rows_);
    list_candidates(discs, box);
    carry_impulses(old_rows, rows_);
    carry_impulses(old_walls, wall_rows_);
    ++rebuilds_;
}

void ContactDynamics::list_candidates(const Discs& discs, const Box& box) {
    built_at_.assign(discs.x.begin(), discs.x.end());
    built_box_ = box;
    NeighborList candidates;  // not kept: it would take more memory than the rows
    candidates.build(discs.x, discs.radius, settings_.skin);
    blocks_ = ContactBlocks(discs, settings_.block_discs);
    std::vector<Pair> pairs;
    std::set_difference(candidates.pairs().begin(), candidates.pairs().end(), excluded_.begin(),
                        excluded_.end(), std::back_inserter(pairs));
    rows_ =
        make_contact_rows(pairs, discs, blocks_,
                          {.tangential = settings_.within.friction > 0.0 || settings_.between.friction > 0.0,
                           .rolling = settings_.within.rolling > 0.0 || settings_.between.rolling > 0.0});
    wall_rows_ = make_wall_rows(discs, box, settings_.skin, blocks_);
}

void ContactDynamics::scale_impulses(double factor) {
    for (std::vector<double>* column : {&rows_.normal, &rows_.tangential, &rows_.rolling, &wall_rows_.normal})
        for (double& impulse : *column) impulse *= factor;
}

void ContactDynamics::save(Checkpoint& to, const std::string& prefix) const {
    to.put(prefix + "built_at", std::span<const Vec2>(built_at_));
    to.put(prefix + "built_box", std::span<const double>(built_box_.position));
    to.put(prefix + "last_step", last_step_);
    to.put(prefix + "direction", std::span<const Vec2>(rows_.direction));
    to.put(prefix + "gap_speed", std::span<const double>(rows_.gap_speed));
    to.put(prefix + "normal", std::span<const double>(rows_.normal));
    to.put(prefix + "tangential", std::span<const double>(rows_.tangential));
    to.put(prefix + "rolling", std::span<const double>(rows_.rolling));
    to.put(prefix + "wall_gap_speed", std::span<const double>(wall_rows_.gap_speed));
    to.put(prefix + "wall_normal", std::span<const double>(wall_rows_.normal));
}

void ContactDynamics::load(const Checkpoint& from, const std::string& prefix, const Discs& discs) {
    std::vector<Vec2> built_at;
    std::vector<double> box;
    from.get(prefix + "built_at", built_at);
    from.get(prefix + "built_box", box);
    last_step_ = from.number(prefix + "last_step");
    built_at_.clear();
    rows_ = ContactRows();
    wall_rows_ = WallRows();
    if (built_at.empty()) return;
    if (built_at.size() != discs.x.size() || box.size() != 4)
        throw InputError(
            "checkpoint: the contact list is for another number of discs; use the same scenario");
    Discs then = discs;
    then.x = built_at;
    Box built_box;
    std::copy(box.begin(), box.end(), built_box.position.begin());
    list_candidates(then, built_box);
    const auto restore = [&](const char* name, auto& column) {
        const std::size_t size = column.size();
        from.get(prefix + name, column);
        if (column.size() != size)
            throw InputError("checkpoint: the stored contacts do not fit the discs; use the same scenario");
    };
    restore("direction", rows_.direction);
    restore("gap_speed", rows_.gap_speed);
    restore("normal", rows_.normal);
    restore("tangential", rows_.tangential);
    restore("rolling", rows_.rolling);
    restore("wall_gap_speed", wall_rows_.gap_speed);
    restore("wall_normal", wall_rows_.normal);
}

}  // namespace softgrain
