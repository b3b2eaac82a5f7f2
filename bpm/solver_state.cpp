// Checkpoints of the solver, and the check of its state.
#include <algorithm>
#include <cmath>

#include "bpm/solver.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

// Largest relative difference of a disc's radius between the checkpoint and the prepared aggregate.
constexpr double same_radius = 1e-12;

}  // namespace

void BpmSolver::check_finite() const {
    for (std::size_t d = 0; d < x_.size(); ++d) {
        if (!x_[d].allFinite()) throw DivergedError(grain_[d], "disc position", time_, "not finite");
        if (!v_[d].allFinite() || !std::isfinite(rim_speed_[d]))
            throw DivergedError(grain_[d], "disc velocity", time_, "not finite");
    }
    for (const Vec2& force : wall_force_)
        if (!force.allFinite()) throw DivergedError(-1, "wall force", time_, "not finite");
}

void BpmSolver::save(Checkpoint& to) const {
    to.put("bpm.radius", std::span<const double>(radius_));
    to.put("bpm.x", std::span<const Vec2>(x_));
    to.put("bpm.x_start", std::span<const Vec2>(x_start_));
    to.put("bpm.v", std::span<const Vec2>(v_));
    to.put("bpm.rim_speed", std::span<const double>(rim_speed_));
    to.put("bpm.box", std::span<const double>(box_.position));
    to.put("bpm.wall_force", std::span<const Vec2>(wall_force_));
    const std::array<double, 14> scalars{time_,
                                         last_step_,
                                         potential_at_start_,
                                         penetration_,
                                         energy_.external_work,
                                         energy_.friction,
                                         energy_.impact,
                                         static_cast<double>(contact_result_.iterations),
                                         contact_result_.residual,
                                         energy_.damping,
                                         energy_.plastic,
                                         static_cast<double>(steps_),
                                         static_cast<double>(unconverged_steps_),
                                         contact_result_.sweeps};
    to.put("bpm.scalars", std::span<const double>(scalars));
    to.put("bpm.converged", contact_result_.converged ? 1.0 : 0.0);
    attraction_.save(to, "bpm.attraction.");
    if (bonds_) bonds_->save(to, "bpm.bonds.");
    contacts_.save(to, "bpm.contacts.");
}

void BpmSolver::load(const Checkpoint& from) {
    if (box2d_)
        throw InputError(
            "bpm: a run with engine = \"box2d\" cannot be resumed, for Box2D does not give out all of its "
            "state; run it again from the start, or use engine = \"nscd\"");
    std::vector<double> radius, rim_speed, box, scalars;
    std::vector<Vec2> x, x_start, v, wall_force;
    from.get("bpm.radius", radius);
    from.get("bpm.x", x);
    from.get("bpm.x_start", x_start);
    from.get("bpm.v", v);
    from.get("bpm.rim_speed", rim_speed);
    from.get("bpm.box", box);
    from.get("bpm.wall_force", wall_force);
    from.get("bpm.scalars", scalars);
    const bool fits = radius.size() == radius_.size() && x.size() == x_.size() &&
                      x_start.size() == x_.size() && v.size() == v_.size() &&
                      rim_speed.size() == rim_speed_.size() && box.size() == 4 && wall_force.size() == 4 &&
                      scalars.size() == 14 &&
                      std::equal(radius.begin(), radius.end(), radius_.begin(),
                                 [](double a, double b) { return std::abs(a - b) <= same_radius * b; });
    if (!fits)
        throw InputError(
            "checkpoint: its discs are not those of this scenario; use the same scenario, packing and seed");
    x_ = std::move(x);
    x_start_ = std::move(x_start);
    v_ = std::move(v);
    rim_speed_ = std::move(rim_speed);
    std::copy(box.begin(), box.end(), box_.position.begin());
    std::copy(wall_force.begin(), wall_force.end(), wall_force_.begin());
    time_ = scalars[0];
    last_step_ = scalars[1];
    potential_at_start_ = scalars[2];
    penetration_ = scalars[3];
    energy_.external_work = scalars[4];
    energy_.friction = scalars[5];
    energy_.impact = scalars[6];
    contact_result_ = {.iterations = static_cast<int>(scalars[7]),
                       .sweeps = scalars[13],
                       .residual = scalars[8],
                       .converged = from.number("bpm.converged") != 0.0};
    energy_.damping = scalars[9];
    energy_.plastic = scalars[10];
    steps_ = static_cast<long long>(scalars[11]);
    unconverged_steps_ = static_cast<long long>(scalars[12]);
    attraction_.load(from, "bpm.attraction.");
    if (bonds_) {
        bonds_->load(from, "bpm.bonds.");
        contacts_.exclude(bonds_->pairs(), discs(), box_);
    }
    contacts_.load(from, "bpm.contacts.", discs());
}

}  // namespace softgrain::bpm
