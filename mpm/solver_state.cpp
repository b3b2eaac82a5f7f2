// Checkpoints of the solver, and the check of its state.
#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

constexpr std::size_t numbers_of_a_state = 6;

}  // namespace

void MpmSolver::check_finite() const {
    for (std::size_t k = 0; k < q_.size(); ++k)
        if (!q_[k].allFinite())
            throw DivergedError(static_cast<int>(k / grains_.nodes()), "position of a node", time_,
                                "not finite");
    for (const Vec2& force : wall_force_)
        if (!force.allFinite()) throw DivergedError(-1, "wall force", time_, "not finite");
}

void MpmSolver::save(Checkpoint& to) const {
    to.put("mpm.q", std::span<const Vec2>(q_));
    to.put("mpm.v", std::span<const Vec2>(v_));
    to.put("mpm.velocity", std::span<const Vec2>(velocity_));
    to.put("mpm.box", std::span<const double>(box_.position));
    to.put("mpm.wall_force", std::span<const Vec2>(wall_force_));
    const std::array scalars{
        time_,        energy_.external_work, iterations_of_step_, static_cast<double>(iterations_),
        strain_rate_, energy_.damping,       energy_.friction};
    to.put("mpm.scalars", std::span<const double>(scalars));
    std::vector<double> plastic;
    for (const PlasticState& s : this->plastic())
        plastic.insert(plastic.end(),
                       {s.inverse_xx, s.inverse_xy, s.inverse_yy, s.inverse_zz, s.equivalent, s.dissipated});
    to.put("mpm.plastic", std::span<const double>(plastic));
    if (motion_)
        motion_->save(to);
    else
        friction().save(to);
}

void MpmSolver::load(const Checkpoint& from) {
    std::vector<Vec2> q, v, velocity, wall_force;
    std::vector<double> box, scalars, plastic;
    from.get("mpm.q", q);
    from.get("mpm.v", v);
    from.get("mpm.velocity", velocity);
    from.get("mpm.box", box);
    from.get("mpm.wall_force", wall_force);
    from.get("mpm.scalars", scalars);
    from.get("mpm.plastic", plastic);
    if (q.size() != q_.size() || v.size() != q_.size() || velocity.size() != grains_.size() ||
        box.size() != 4 || wall_force.size() != 4 || scalars.size() != 7 ||
        plastic.size() != numbers_of_a_state * this->plastic().size())
        throw InputError(
            "checkpoint: its grains are not those of this scenario; use the same scenario, packing and "
            "[mpm]");
    q_ = std::move(q);
    v_ = std::move(v);
    velocity_ = std::move(velocity);
    std::copy(box.begin(), box.end(), box_.position.begin());
    std::copy(wall_force.begin(), wall_force.end(), wall_force_.begin());
    time_ = scalars[0];
    energy_.external_work = scalars[1];
    iterations_of_step_ = scalars[2];
    iterations_ = static_cast<long long>(scalars[3]);
    strain_rate_ = scalars[4];
    energy_.damping = scalars[5];
    energy_.friction = scalars[6];
    for (std::size_t k = 0; k < this->plastic().size(); ++k) {
        const double* s = plastic.data() + numbers_of_a_state * k;
        this->plastic()[k] = {s[0], s[1], s[2], s[3], s[4], s[5]};
    }
    find_centroids();
    if (motion_)
        motion_->load(from, q_);
    else
        equilibrium_->friction().load(from);
    evaluate();
    find_energy();
}

}  // namespace softgrain::mpm
