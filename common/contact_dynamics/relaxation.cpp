#include "common/contact_dynamics/relaxation.hpp"

#include <omp.h>

#include <algorithm>

#include "common/at.hpp"
#include "common/stop.hpp"

namespace softgrain {
namespace {

constexpr double quiet = 0.5;            // a block rests when a sweep changes it by less, in tolerances
constexpr int rows_worth_a_wait = 2000;  // fewer are relaxed by one thread while the others wait

/// A barrier, free of charge for a single thread.
void wait() {
    if (omp_get_num_threads() > 1) {
#pragma omp barrier
    }
}

}  // namespace

Relaxation::Relaxation(ContactRows& rows, WallRows& wall_rows, const ContactBlocks& blocks,
                       const Discs& discs, const WallMotion& walls, double h, const ContactSettings& settings)
    : rows_(rows),
      wall_rows_(wall_rows),
      blocks_(blocks),
      discs_(discs),
      walls_(walls),
      h_(h),
      settings_(settings),
      limit_(settings.tolerance / h),
      awake_(at(blocks.size()), 1),
      pushed_(at(blocks.size()), 0.0),
      change_(at(blocks.size()) + rows.seams.size(), 0.0),
      overlap_(change_.size(), 0.0) {
    choose_blocks();
}

ContactResult Relaxation::run(bool threads) {
    std::array<Plan, 2> plans;  // used in turn: one is read while the next is written
#pragma omp parallel if (threads)
    {
        const int thread = omp_get_thread_num();
        const int team = omp_get_num_threads();
        const auto sweep_once = [&](int member, int members) {
            sweep(
                member, members, [&](int block) { relax_block(block); },
                [&](std::size_t seam) { relax_seam(seam); });
        };
        sweep(
            thread, team, [&](int block) { start_block(block); },
            [&](std::size_t seam) { start_seam(seam); });
        for (std::size_t round = 0;; ++round) {
            const Plan now = plans[round % 2];
            Plan& next = plans[(round + 1) % 2];
            if (now.done) break;
            if (!now.alone) {
                sweep_once(thread, team);
                if (thread == 0) next = after_sweep();
            } else if (thread == 0) {
                do {
                    sweep_once(0, 1);
                    next = after_sweep();
                } while (next.alone && !next.done);
            }
            wait();
        }
    }
    if (stopped_) throw StopAsked();
    result_.penetration =
        overlap_.empty() ? 0.0 : std::max(0.0, *std::max_element(overlap_.begin(), overlap_.end()));
    result_.sweeps = relaxed_rows_ / std::max(1.0, static_cast<double>(rows_.size()));
    return result_;
}

void Relaxation::start_block(int block) {
    const auto b = at(block);
    const int first = rows_.block_start[b], last = rows_.block_start[b + 1];
    const int first_wall = wall_rows_.block_start[b], last_wall = wall_rows_.block_start[b + 1];
    overlap_[b] =
        std::max(contact_sweep::set_geometry(rows_, discs_, h_, settings_.largest_push, first, last),
                 contact_sweep::set_geometry(wall_rows_, discs_, walls_.box, h_, settings_.largest_push,
                                             first_wall, last_wall));
    contact_sweep::warm_start(rows_, discs_, settings_.within, first, last);
    contact_sweep::warm_start(wall_rows_, discs_, first_wall, last_wall);
}

void Relaxation::start_seam(std::size_t seam) {
    const Seam& s = rows_.seams[seam];
    overlap_[at(blocks_.size()) + seam] =
        contact_sweep::set_geometry(rows_, discs_, h_, settings_.largest_push, s.first, s.last);
    contact_sweep::warm_start(rows_, discs_, resistance(s.a, s.b), s.first, s.last);
}

void Relaxation::relax_block(int block) {
    const auto b = at(block);
    const double omega = settings_.over_relaxation;
    change_[b] = std::max(contact_sweep::relax_block(rows_, discs_, settings_.within, omega, block),
                          contact_sweep::relax(wall_rows_, discs_, walls_, omega, wall_rows_.block_start[b],
                                               wall_rows_.block_start[b + 1]));
    awake_[b] = change_[b] >= quiet * limit_ ? 1 : 0;
    pushed_[b] = 0.0;
}

void Relaxation::relax_seam(std::size_t seam) {
    const Seam& s = rows_.seams[seam];
    double& change = change_[at(blocks_.size()) + seam];
    if (!full_ && awake_[at(s.a)] == 0 && awake_[at(s.b)] == 0) {
        change = -1.0;
        return;
    }
    change =
        contact_sweep::relax(rows_, discs_, resistance(s.a, s.b), settings_.over_relaxation, s.first, s.last);
    push(s.a, change);
    push(s.b, change);
}

void Relaxation::push(int block, double change) {
    double& pushed = pushed_[at(block)];
    pushed += change;
    if (pushed >= quiet * limit_) awake_[at(block)] = 1;
}

Relaxation::Plan Relaxation::after_sweep() {
    double largest = 0.0;
    for (int block : chosen_) largest = std::max(largest, change_[at(block)]);
    relaxed_rows_ += chosen_start_.back();
    for (std::size_t seam = 0; seam < rows_.seams.size(); ++seam) {
        const double change = change_[at(blocks_.size()) + seam];
        if (change < 0.0) continue;
        largest = std::max(largest, change);
        relaxed_rows_ += rows_.seams[seam].last - rows_.seams[seam].first;
    }
    ++result_.iterations;
    const bool quiet_sweep = largest < limit_;
    if (full_) {
        result_.residual = h_ * largest;
        result_.converged = quiet_sweep;
    }
    Plan plan;
    plan.done = (full_ && quiet_sweep) || (full_ && result_.iterations >= settings_.max_iterations);
    stopped_ = settings_.heeds_stop && stop_request() != 0;
    plan.done = plan.done || stopped_;
    if (plan.done) return plan;
    full_ = quiet_sweep || result_.iterations + 1 >= settings_.max_iterations;
    choose_blocks();
    if (chosen_.empty() && !full_) {
        full_ = true;
        choose_blocks();
    }
    plan.alone = !full_ && chosen_start_.back() < rows_worth_a_wait;
    return plan;
}

void Relaxation::choose_blocks() {
    chosen_.clear();
    chosen_start_.assign(1, 0);
    for (int b = 0; b < blocks_.size(); ++b) {
        if (!full_ && awake_[at(b)] == 0) continue;
        chosen_.push_back(b);
        chosen_start_.push_back(chosen_start_.back() + rows_.block_start[at(b) + 1] -
                                rows_.block_start[at(b)]);
    }
}

template <class OnBlock, class OnSeam>
void Relaxation::sweep(int thread, int threads, OnBlock on_block, OnSeam on_seam) {
    const auto wait_for_team = [&] {
        if (threads > 1) wait();
    };
    for (int k = first_choice_of(thread, threads); k < first_choice_of(thread + 1, threads); ++k)
        on_block(chosen_[at(k)]);
    wait_for_team();
    const auto share = [&](int first, int last, int member) {
        return first + static_cast<int>(static_cast<long long>(last - first) * member / threads);
    };
    for (std::size_t c = 0; c + 1 < rows_.colour_start.size(); ++c) {
        const int first = rows_.colour_start[c], last = rows_.colour_start[c + 1];
        for (int seam = share(first, last, thread); seam < share(first, last, thread + 1); ++seam)
            on_seam(at(seam));
        wait_for_team();
    }
}

/// The threads get about the same number of rows.
int Relaxation::first_choice_of(int thread, int threads) const {
    if (thread == threads) return static_cast<int>(chosen_.size());
    const auto row = static_cast<int>(static_cast<long long>(chosen_start_.back()) * thread / threads);
    return static_cast<int>(std::lower_bound(chosen_start_.begin(), chosen_start_.end(), row) -
                            chosen_start_.begin());
}

}  // namespace softgrain
