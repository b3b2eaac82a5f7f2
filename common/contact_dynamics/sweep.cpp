#include "common/contact_dynamics/sweep.hpp"

#include <algorithm>
#include <cmath>

#include "common/at.hpp"
#include "common/contact_dynamics/row_batches.hpp"
#include "common/simd.hpp"

namespace softgrain::contact_sweep {
namespace {

/// The row's half of a pair's inertia against rolling: I_e / m_e [m^2], and what an angular impulse does to
/// the two rim speeds. Discs: I = m r^2 / 2.
struct Roll {
    double inertia, on_i, on_j, length;

    Roll(const ContactRows& rows, const Discs& discs, std::size_t k) {
        const double ri = discs.radius[at(rows.i[k])], rj = discs.radius[at(rows.j[k])];
        const double share_i = rows.share[k], share_j = 1.0 - share_i;
        on_i = 2.0 * share_i / ri;
        on_j = 2.0 * share_j / rj;
        inertia = 1.0 / (on_i / ri + on_j / rj);
        length = ri + rj;
    }
    /// Angular velocity of j relative to i [1/s].
    static double speed(const ContactRows& rows, const Discs& discs, std::size_t k) {
        const std::size_t i = at(rows.i[k]), j = at(rows.j[k]);
        return discs.rim_speed[j] / discs.radius[j] - discs.rim_speed[i] / discs.radius[i];
    }
    void apply(const ContactRows& rows, const Discs& discs, std::size_t k, double impulse) const {
        discs.rim_speed[at(rows.i[k])] -= on_i * impulse;
        discs.rim_speed[at(rows.j[k])] += on_j * impulse;
    }
};

/// Gives j an impulse along a direction, and i the opposite one.
void push(const ContactRows& rows, const Discs& discs, std::size_t k, double impulse, const Vec2& along) {
    const double on_i = rows.share[k] * impulse;
    discs.v[at(rows.i[k])] -= on_i * along;
    discs.v[at(rows.j[k])] += (impulse - on_i) * along;
}
void rub(const ContactRows& rows, const Discs& discs, std::size_t k, double impulse) {
    push(rows, discs, k, impulse, perpendicular(rows.direction[k]));
    discs.rim_speed[at(rows.i[k])] -= 2.0 * rows.share[k] * impulse;
    discs.rim_speed[at(rows.j[k])] -= 2.0 * (1.0 - rows.share[k]) * impulse;
}

/// Relaxes one normal impulse; returns its change. Not inlined, each call would pay for a guard of the stack.
SOFTGRAIN_INLINE double relax_normal(ContactRows& rows, const Discs& discs, double omega, std::size_t k) {
    const Vec2 n = rows.direction[k];
    const double old = rows.normal[k];
    const double opening = n.dot(discs.v[at(rows.j[k])] - discs.v[at(rows.i[k])]) + rows.gap_speed[k];
    const double now = std::max(0.0, old - omega * opening);
    rows.normal[k] = now;
    push(rows, discs, k, now - old, n);
    return now - old;
}

/// Relaxes one tangential impulse; returns its change divided by what it does to the slip.
double relax_tangential(ContactRows& rows, const Discs& discs, double friction, std::size_t k) {
    const std::size_t i = at(rows.i[k]), j = at(rows.j[k]);
    const double slip = perpendicular(rows.direction[k]).dot(discs.v[j] - discs.v[i]) - discs.rim_speed[i] -
                        discs.rim_speed[j];
    const double limit = friction * rows.normal[k];
    const double now = std::clamp(rows.tangential[k] - slip / 3.0, -limit, limit);
    const double change = now - rows.tangential[k];
    rows.tangential[k] = now;
    rub(rows, discs, k, change);
    return 3.0 * change;
}

/// Relaxes one rolling impulse; returns what its change does to the rolling speed of the rims.
double relax_rolling(ContactRows& rows, const Discs& discs, double rolling, std::size_t k) {
    const Roll roll(rows, discs, k);
    const double limit = rolling * roll.length * rows.normal[k];
    const double now =
        std::clamp(rows.rolling[k] - roll.inertia * Roll::speed(rows, discs, k), -limit, limit);
    const double change = now - rows.rolling[k];
    rows.rolling[k] = now;
    roll.apply(rows, discs, k, change);
    return 0.5 * roll.length * change / roll.inertia;
}

double relax_frictionless(ContactRows& rows, const Discs& discs, double omega, int first, int last) {
    double largest = 0.0;
    for (std::size_t k = at(first); k < at(last); ++k)
        largest = std::max(largest, std::abs(relax_normal(rows, discs, omega, k)));
    return largest / omega;
}

}  // namespace

double set_geometry(ContactRows& rows, const Discs& discs, double h, double largest_push, int first,
                    int last) {
    const double per_step = 1.0 / h;
    double closest = 0.0;
    for (std::size_t k = at(first); k < at(last); ++k) {
        const std::size_t i = at(rows.i[k]);
        const std::size_t j = at(rows.j[k]);
        const Vec2 line = discs.x[j] - discs.x[i];
        const double distance = std::sqrt(line.squaredNorm());
        const double gap = distance - discs.radius[i] - discs.radius[j];
        rows.direction[k] = distance > 0.0 ? Vec2(line / distance) : Vec2::UnitX();
        rows.gap_speed[k] = std::max(gap, -largest_push) * per_step;
        closest = std::min(closest, gap);
    }
    return -closest;
}

double set_geometry(WallRows& rows, const Discs& discs, const Box& box, double h, double largest_push,
                    int first, int last) {
    double closest = 0.0;
    for (std::size_t k = at(first); k < at(last); ++k) {
        const std::size_t d = at(rows.disc[k]);
        const double gap = box.distance(rows.wall[k], discs.x[d]) - discs.radius[d];
        rows.gap_speed[k] = std::max(gap, -largest_push) / h;
        closest = std::min(closest, gap);
    }
    return -closest;
}

void warm_start(const ContactRows& rows, const Discs& discs, const Resistance& resistance, int first,
                int last) {
    if (resistance.friction == 0.0 && resistance.rolling == 0.0) {
        for (std::size_t k = at(first); k < at(last); ++k)
            push(rows, discs, k, rows.normal[k], rows.direction[k]);
        return;
    }
    for (std::size_t k = at(first); k < at(last); ++k) {
        push(rows, discs, k, rows.normal[k], rows.direction[k]);
        if (resistance.friction > 0.0) rub(rows, discs, k, rows.tangential[k]);
        if (resistance.rolling > 0.0) Roll(rows, discs, k).apply(rows, discs, k, rows.rolling[k]);
    }
}

void warm_start(const WallRows& rows, const Discs& discs, int first, int last) {
    for (std::size_t k = at(first); k < at(last); ++k) {
        const int axis = wall_axis(rows.wall[k]);
        discs.v[at(rows.disc[k])][axis] += wall_sign(rows.wall[k]) * rows.normal[k];
    }
}

double relax_block(ContactRows& rows, const Discs& discs, const Resistance& resistance, double omega,
                   int block) {
    const int first = rows.block_start[at(block)], last = rows.block_start[at(block) + 1];
    const int single = rows.first_single[at(block)];
    if (resistance.friction > 0.0 || resistance.rolling > 0.0)
        return relax(rows, discs, resistance, omega, first, last);
    double largest = 0.0;
    if (first < single) {
        const FrictionlessRows batches{
            rows.i.data(),     rows.j.data(),      rows.direction.data()->data(), rows.gap_speed.data(),
            rows.share.data(), rows.normal.data(), discs.v.data()->data()};
        largest = relax_batches(batches, omega, first, single) / omega;
    }
    return std::max(largest, relax_frictionless(rows, discs, omega, single, last));
}

double relax(ContactRows& rows, const Discs& discs, const Resistance& resistance, double omega, int first,
             int last) {
    if (resistance.friction == 0.0 && resistance.rolling == 0.0)
        return relax_frictionless(rows, discs, omega, first, last);
    const double normal_omega = resistance.friction > 0.0 ? 1.0 : omega;
    double largest = 0.0;
    for (std::size_t k = at(first); k < at(last); ++k) {
        largest = std::max(largest, std::abs(relax_normal(rows, discs, normal_omega, k)) / normal_omega);
        if (resistance.friction > 0.0)
            largest = std::max(largest, std::abs(relax_tangential(rows, discs, resistance.friction, k)));
        if (resistance.rolling > 0.0)
            largest = std::max(largest, std::abs(relax_rolling(rows, discs, resistance.rolling, k)));
    }
    return largest;
}

double relax(WallRows& rows, const Discs& discs, const WallMotion& walls, double omega, int first, int last) {
    double largest = 0.0;
    for (std::size_t k = at(first); k < at(last); ++k) {
        const int axis = wall_axis(rows.wall[k]);
        const double sign = wall_sign(rows.wall[k]);
        double& v = discs.v[at(rows.disc[k])][axis];
        const double closing = sign * (v - walls.velocity[at(rows.wall[k])]) + rows.gap_speed[k];
        const double now = std::max(0.0, rows.normal[k] - omega * closing);
        const double change = now - rows.normal[k];
        rows.normal[k] = now;
        v += sign * change;
        largest = std::max(largest, std::abs(change));
    }
    return largest / omega;
}

}  // namespace softgrain::contact_sweep
