#include "sdem/quasi_static.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "sdem/motion_block.hpp"

namespace softgrain::sdem {
namespace {

constexpr int most_steps = 100000;
constexpr int steps_between_limits = 50;
/// Force out of balance that counts as rest where no contact carries any, in E and mean radii.
constexpr double floating_force = 1e-6;

}  // namespace

QuasiStaticSolver::QuasiStaticSolver(std::vector<GrainMaterial> material, const Packing& packing,
                                     const Options& options, const QuasiStaticOptions& quasi_static)
    : SoftDiscSolver(std::move(material), packing, options),
      quasi_static_(quasi_static),
      mean_radius_(packing.mean_radius()) {
    acceleration_.resize(6 * size());
}

double QuasiStaticSolver::stable_time_step() const {
    double fastest = 0.0;
    for (std::size_t w = 0; w < 4; ++w) {
        const double length =
            wall_axis(static_cast<int>(w)) == 0 ? motion_.box.width() : motion_.box.height();
        const std::size_t opposite = w ^ 1U;
        fastest = std::max(fastest, std::abs(motion_.velocity[w] - motion_.velocity[opposite]) / length);
    }
    fastest = std::max(fastest, std::abs(motion_.tilt_rate) / motion_.box.height());
    if (time_ == 0.0) return SoftDiscSolver::stable_time_step();  // nothing has moved yet
    return fastest > 0.0 ? quasi_static_.strain_step / fastest : std::numeric_limits<double>::infinity();
}

void QuasiStaticSolver::advance(const WallMotion& walls, double dt) {
    const std::array<Vec2, 4> force_before = wall_force_;
    const Mat2 stress_before = cell_stress();
    const double energy_before = potential_energy() + height_energy();
    const Box before = walls.box;
    motion_ = walls;
    motion_.box = walls.after(dt);
    lattice_ = cell().box;
    time_ += dt;
    carry_along(before, motion_.box);
    relax();
    const double plastic = options_.motion.plastic ? flow() : 0.0;

    double work = 0.0;
    if (before.periodic) {
        const Mat2 L = walls.velocity_gradient();
        work = -0.5 * dt * before.area() * (stress_before + cell_stress()).cwiseProduct(L).sum();
    } else {
        for (std::size_t w = 0; w < 4; ++w) {
            const int axis = wall_axis(static_cast<int>(w));
            work -= 0.5 * (force_before[w][axis] + wall_force_[w][axis]) * walls.velocity[w] * dt;
        }
    }
    ledger_.external_work += work;
    // What rearrangements set free is taken away by the relaxation.
    ledger_.damping += work - (potential_energy() + height_energy() - energy_before) - plastic;
    ledger_.plastic += plastic;
}

/// Every centre keeps its place relative to the box.
void QuasiStaticSolver::carry_along(const Box& before, const Box& after) {
    const Mat2 map = after.lattice() * before.lattice().inverse();
    for (std::size_t g = 0; g < size(); ++g) {
        const Vec2 x = after.origin() + map * (grains_.center[g] - before.origin());
        grains_.center[g] = x;
        grains_.next_center[g] = x;
        grains_.grain[g].x = x.x();
        grains_.grain[g].y = x.y();
    }
    refresh_contacts(0.0);
}

int QuasiStaticSolver::relax() {
    constexpr double first_alpha = 0.1, alpha_factor = 0.99, speed_up = 1.1, slow_down = 0.5;
    constexpr int patience = 5;
    stop();
    double longest = time_step_limit(), dt = 0.3 * longest, alpha = first_alpha;
    int downhill = 0;
    Descent now;
    double rest = 0.0;
    for (int k = 0; k < most_steps; ++k) {
        now = find_accelerations();
        rest = std::max(quasi_static_.tolerance * mean_contact_force(),
                        floating_force * stress_scale() * mean_radius_);
        if (now.worst <= rest) {
            stop();
            return k;
        }
        if (k % steps_between_limits == 0) longest = time_step_limit();
        double keep = 0.0, turn = 0.0;
        if (now.power > 0.0) {
            keep = 1.0 - alpha;
            turn = alpha * std::sqrt(now.speed2 / now.pull2);
            if (++downhill > patience) {
                dt = std::min(dt * speed_up, longest);
                alpha *= alpha_factor;
            }
        } else {
            downhill = 0;
            dt *= slow_down;
            alpha = first_alpha;
        }
        step(keep, turn, std::min(dt, longest));
    }
    throw DivergedError(
        packing_index(now.worst_grain), "balance", time_,
        fmt::format("no equilibrium after {} steps: {:.3g} N out of balance where {:.3g} N count as rest; "
                    "use a larger sdem.tolerance or sdem.driver = \"explicit\"",
                    most_steps, now.worst, rest));
}

QuasiStaticSolver::Descent QuasiStaticSolver::find_accelerations() {
    const Chunks grains = blocks();
    std::vector<Descent> part(grains.count());
    const MotionInput input = motion_input();
#pragma omp parallel for schedule(static) if (threads_pay_off())
    for (std::size_t chunk = 0; chunk < grains.count(); ++chunk) {
        const std::size_t begin = grains.begin(chunk), end = grains.end(chunk);
        MotionBlock block;
        kick_from_rest(block, input, grains_, memory_, begin, end);
        Descent& sum = part[chunk];
        for (std::size_t g = begin; g < end; ++g) {
            const auto l = static_cast<int>(g - begin);
            const Grain& grain = grains_.grain[g];
            const double mx = block.inertia_x[l], my = block.inertia_y[l];
            const Tensor a = block.new_rate[l];
            const double ax = block.new_vx[l], ay = block.new_vy[l];
            double* to = &acceleration_[6 * g];
            to[0] = ax, to[1] = ay, to[2] = a.xx, to[3] = a.xy, to[4] = a.yx, to[5] = a.yy;
            const Tensor& v = grain.F_rate;
            sum.power += grain.mass * (ax * grain.vx + ay * grain.vy) + mx * (a.xx * v.xx + a.yx * v.yx) +
                         my * (a.xy * v.xy + a.yy * v.yy);
            sum.speed2 += grain.mass * (grain.vx * grain.vx + grain.vy * grain.vy) +
                          mx * (v.xx * v.xx + v.yx * v.yx) + my * (v.xy * v.xy + v.yy * v.yy);
            sum.pull2 += grain.mass * (ax * ax + ay * ay) + mx * (a.xx * a.xx + a.yx * a.yx) +
                         my * (a.xy * a.xy + a.yy * a.yy);
            const double force = std::hypot(block.fx[l], block.fy[l]);
            const double moment = std::sqrt(block.moment[l].squared()) / grain.radius;
            sum.note(std::max(force, moment), g);
        }
    }
    Descent sum;
    for (const Descent& d : part) {
        sum.power += d.power;
        sum.speed2 += d.speed2;
        sum.pull2 += d.pull2;
        sum.note(d.worst, d.worst_grain);
    }
    return sum;
}

void QuasiStaticSolver::step(double keep, double turn, double dt) {
    std::size_t bad = size();
#pragma omp parallel for schedule(static) reduction(min : bad) if (threads_pay_off())
    for (std::size_t g = 0; g < size(); ++g) {
        Grain& grain = grains_.grain[g];
        const double* a = &acceleration_[6 * g];
        const double pull = turn + dt;
        grain.vx = keep * grain.vx + pull * a[0];
        grain.vy = keep * grain.vy + pull * a[1];
        grain.F_rate = keep * grain.F_rate + pull * Tensor{a[2], a[3], a[4], a[5]};
        grain.x += dt * grain.vx;
        grain.y += dt * grain.vy;
        grain.F = grain.F + dt * grain.F_rate;
        grains_.next_center[g] = grains_.center[g];
        grains_.center[g] = Vec2{grain.x, grain.y};
        grains_.reach[g] = reach_of(grain);
        if (!sound(grain, (grains_.center[g] - grains_.next_center[g]).squaredNorm(), grain.F.det(),
                   grains_.reach[g]))
            bad = std::min(bad, g);
    }
    if (bad < size()) throw_bad_grain(bad);
    refresh_contacts(0.0);
}

double QuasiStaticSolver::mean_contact_force() const {
    double sum = 0.0;
    int count = 0;
    for (const auto* contacts : {&contacts_.pair_contact, &contacts_.wall_contact})
        for (const Contact& c : *contacts) {
            if (!c.touching()) continue;
            sum += std::abs(c.q) * std::sqrt(c.length_squared());
            ++count;
        }
    return count > 0 ? sum / count : 0.0;
}

double QuasiStaticSolver::flow() {
    double work = 0.0;
    const Chunks grains = blocks();
    for (std::size_t c = 0; c < grains.count(); ++c)
        work += flow_grains(motion_input(), grains_, memory_, grains.begin(c), grains.end(c));
    return work;
}

void QuasiStaticSolver::stop() {
    for (Grain& grain : grains_.grain) {
        grain.vx = grain.vy = 0.0;
        grain.F_rate = Tensor{0.0, 0.0, 0.0, 0.0};
    }
}

}  // namespace softgrain::sdem
