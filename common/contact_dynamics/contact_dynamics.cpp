#include "common/contact_dynamics/contact_dynamics.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/contact_dynamics/sweep.hpp"
#include "common/errors.hpp"

namespace softgrain {
namespace {

// A colour of fewer rows is not split: a barrier costs more than it saves.
constexpr int colour_rows_worth_threads = 1000;

std::size_t at(int k) {
    return static_cast<std::size_t>(k);
}

/// One solve, run by every thread of a team: the same sequence of operations on every disc, however the
/// threads share it.
class Solve {
  public:
    Solve(ContactRows& rows, WallRows& wall_rows, const Discs& discs, const WallMotion& walls, double h,
          const ContactSettings& settings)
        : rows_(rows), wall_rows_(wall_rows), discs_(discs), walls_(walls), h_(h), settings_(settings) {}

    void start() {
        within_groups([&](int first, int last, int first_wall, int last_wall) {
            contact_sweep::set_geometry(rows_, discs_, h_, settings_.largest_push, first, last);
            contact_sweep::set_geometry(wall_rows_, discs_, walls_.box, h_, settings_.largest_push,
                                        first_wall, last_wall);
            contact_sweep::warm_start(rows_, discs_, first, last);
            contact_sweep::warm_start(wall_rows_, discs_, first_wall, last_wall);
        });
        between_groups([&](int first, int last) {
            contact_sweep::set_geometry(rows_, discs_, h_, settings_.largest_push, first, last);
            if (settings_.friction > 0.0)
                contact_sweep::warm_start_with_friction(rows_, discs_, first, last);
            else
                contact_sweep::warm_start(rows_, discs_, first, last);
        });
        wait();
    }

    /// Writes the calling thread's largest change [m/s]; all of them can be read when sweep returns.
    void sweep(double& largest) {
        largest = 0.0;
        const double omega = settings_.over_relaxation;
        within_groups([&](int first, int last, int first_wall, int last_wall) {
            largest =
                std::max({largest, contact_sweep::relax(rows_, discs_, omega, first, last),
                          contact_sweep::relax(wall_rows_, discs_, walls_, omega, first_wall, last_wall)});
        });
        between_groups([&](int first, int last) {
            largest = std::max(largest, settings_.friction > 0.0
                                            ? contact_sweep::relax_with_friction(
                                                  rows_, discs_, settings_.friction, first, last)
                                            : contact_sweep::relax(rows_, discs_, omega, first, last));
        });
        wait();
    }

  private:
    /// A barrier, free of charge for a single thread.
    static void wait() {
        if (omp_get_num_threads() > 1) {
#pragma omp barrier
        }
    }

    /// Each thread takes some of the groups, with about the same number of rows; then all wait.
    template <class Work>
    void within_groups(Work work) {
        const int first = first_group_of(omp_get_thread_num());
        const int last = first_group_of(omp_get_thread_num() + 1);
        if (first < last)
            work(rows_.block_start[at(first)], rows_.block_start[at(last)], wall_rows_.block_start[at(first)],
                 wall_rows_.block_start[at(last)]);
        wait();
    }
    int first_group_of(int thread) const {
        const auto groups = static_cast<int>(rows_.block_start.size()) - 1;
        const int threads = omp_get_num_threads();
        if (thread == threads) return groups;
        const auto row = static_cast<int>(static_cast<long long>(rows_.within_groups()) * thread / threads);
        const auto group = std::lower_bound(rows_.block_start.begin(), rows_.block_start.end() - 1, row);
        return static_cast<int>(group - rows_.block_start.begin());
    }

    /// Colours one after the other; a large colour is split between the threads. No wait after the last.
    template <class Work>
    void between_groups(Work work) {
        const std::vector<int>& start = rows_.colour_start;
        const long long threads = omp_get_num_threads();
        const int thread = omp_get_thread_num();
        const auto is_small = [&](std::size_t c) {
            return start[c + 1] - start[c] < colour_rows_worth_threads;
        };
        for (std::size_t c = 0; c + 1 < start.size(); ++c) {
            if (is_small(c)) {
                if (thread == 0) work(start[c], start[c + 1]);
                if (c + 2 < start.size() && is_small(c + 1)) continue;  // thread 0 goes on alone
            } else {
                const long long count = start[c + 1] - start[c];
                work(start[c] + static_cast<int>(count * thread / threads),
                     start[c] + static_cast<int>(count * (thread + 1) / threads));
            }
            if (c + 2 < start.size()) wait();
        }
    }

    ContactRows& rows_;
    WallRows& wall_rows_;
    const Discs& discs_;
    const WallMotion& walls_;
    double h_;
    const ContactSettings& settings_;
};

}  // namespace

ContactDynamics::ContactDynamics(const ContactSettings& settings) : settings_(settings) {
    if (!(settings.tolerance > 0.0) || !(settings.skin > 0.0) || settings.max_iterations < 1 ||
        !(settings.over_relaxation > 0.0 && settings.over_relaxation < 2.0) || settings.friction < 0.0 ||
        !(settings.largest_push > 0.0))
        throw InputError(
            "contact dynamics: tolerance and skin must be > 0, max_iterations >= 1, over_relaxation between "
            "0 "
            "and 2, friction >= 0, largest_push > 0");
}

ContactResult ContactDynamics::solve(const Discs& discs, const WallMotion& walls, double h) {
    if (discs.x.empty()) return {0, 0.0, true};
    if (stale(discs, walls, h)) rebuild(discs, walls.box);
    if (last_step_ > 0.0 && last_step_ != h) scale_impulses(h / last_step_);
    last_step_ = h;

    ContactResult result;
    Solve one(rows_, wall_rows_, discs, walls, h, settings_);
    // Two sets of slots, used in turn, save a barrier.
    std::array<std::vector<double>, 2> change;
    change.fill(std::vector<double>(static_cast<std::size_t>(omp_get_max_threads()), 0.0));
#pragma omp parallel if (rows_.size() > settings_.rows_worth_threads)
    {
        const auto thread = static_cast<std::size_t>(omp_get_thread_num());
        one.start();
        for (int iteration = 1; iteration <= settings_.max_iterations; ++iteration) {
            std::vector<double>& slots = change[static_cast<std::size_t>(iteration % 2)];
            one.sweep(slots[thread]);
            const double residual = h * *std::max_element(slots.begin(), slots.end());
            const bool done = residual < settings_.tolerance;
            if (thread == 0) result = {iteration, residual, done};
            if (done) break;
        }
    }
    return result;
}

bool ContactDynamics::stale(const Discs& discs, const WallMotion& walls, double h) const {
    if (candidates_.built_at().size() != discs.x.size()) return true;
    double moved = 0.0;
    for (std::size_t d = 0; d < discs.x.size(); ++d)
        moved = std::max(moved, (discs.x[d] + h * discs.v[d] - candidates_.built_at()[d]).squaredNorm());
    moved = std::sqrt(moved);
    double wall_moved = 0.0;
    const Box after = walls.after(h);
    for (std::size_t w = 0; w < 4; ++w)
        wall_moved = std::max(wall_moved, std::abs(after.position[w] - built_box_.position[w]));
    return moved + std::max(moved, wall_moved) >= settings_.skin;
}

void ContactDynamics::rebuild(const Discs& discs, const Box& box) {
    candidates_.build(discs.x, discs.radius, settings_.skin);
    const ContactRows old_rows = std::move(rows_);
    const WallRows old_walls = std::move(wall_rows_);
    list_candidates(discs, box);
    carry_impulses(old_rows, rows_);
    carry_impulses(old_walls, wall_rows_);
    ++rebuilds_;
}

void ContactDynamics::list_candidates(const Discs& discs, const Box& box) {
    const int groups =
        discs.group.empty() ? 0 : 1 + *std::max_element(discs.group.begin(), discs.group.end());
    built_box_ = box;
    rows_ = make_contact_rows(candidates_.pairs(), discs, groups);
    wall_rows_ = make_wall_rows(discs, box, settings_.skin, groups);
}

void ContactDynamics::scale_impulses(double factor) {
    for (std::vector<double>* column : {&rows_.normal, &rows_.tangential, &wall_rows_.normal})
        for (double& impulse : *column) impulse *= factor;
}

void ContactDynamics::save(Checkpoint& to, const std::string& prefix) const {
    to.put(prefix + "built_at", candidates_.built_at());
    to.put(prefix + "built_box", std::span<const double>(built_box_.position));
    to.put(prefix + "last_step", last_step_);
    to.put(prefix + "direction", std::span<const Vec2>(rows_.direction));
    to.put(prefix + "gap_speed", std::span<const double>(rows_.gap_speed));
    to.put(prefix + "normal", std::span<const double>(rows_.normal));
    to.put(prefix + "tangential", std::span<const double>(rows_.tangential));
    to.put(prefix + "wall_gap_speed", std::span<const double>(wall_rows_.gap_speed));
    to.put(prefix + "wall_normal", std::span<const double>(wall_rows_.normal));
}

void ContactDynamics::load(const Checkpoint& from, const std::string& prefix, const Discs& discs) {
    std::vector<Vec2> built_at;
    std::vector<double> box;
    from.get(prefix + "built_at", built_at);
    from.get(prefix + "built_box", box);
    last_step_ = from.number(prefix + "last_step");
    candidates_ = NeighborList();
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
    candidates_.build(then.x, then.radius, settings_.skin);
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
    restore("wall_gap_speed", wall_rows_.gap_speed);
    restore("wall_normal", wall_rows_.normal);
}

}  // namespace softgrain
