// What a restart needs, so that it goes on with the same bits.
#include <algorithm>

#include "common/errors.hpp"
#include "mpm/dynamics/explicit_motion.hpp"

namespace softgrain::mpm {
namespace {

template <class T>
void get(const Checkpoint& from, std::string_view name, std::vector<T>& values) {
    const std::size_t size = values.size();
    from.get(name, values);
    if (values.size() != size)
        throw InputError(
            "checkpoint: its grains are not those of this scenario; use the same scenario, packing and "
            "[mpm]");
}

}  // namespace

void ExplicitMotion::save(Checkpoint& to) const {
    to.put("mpm.motion.box", std::span<const double>(box_.position));
    to.put("mpm.motion.acceleration", std::span<const Vec2>(acceleration_));
    to.put("mpm.motion.elastic", std::span<const double>(elastic_));
    const std::array numbers{static_cast<double>(steps_), counted_.external_work, counted_.damping,
                             counted_.friction, counted_.impact};
    to.put("mpm.motion.numbers", std::span<const double>(numbers));
    fastest_.save(to);
    friction_.save(to);
    if (grid_) grid_->save(to);
}

void ExplicitMotion::load(const Checkpoint& from, std::span<const Vec2> q) {
    std::vector<double> box(4), numbers(5);
    get(from, "mpm.motion.box", box);
    get(from, "mpm.motion.numbers", numbers);
    std::ranges::copy(box, box_.position.begin());
    counted_ = {};
    steps_ = static_cast<long long>(numbers[0]);
    counted_.external_work = numbers[1];
    counted_.damping = numbers[2];
    counted_.friction = numbers[3];
    counted_.impact = numbers[4];
    fastest_.load(from);
    friction_.load(from);
    if (grid_) grid_->load(from);
    evaluate(q, false);
    // With plastic states that have followed, those just found differ in the last digits.
    get(from, "mpm.motion.acceleration", acceleration_);
    get(from, "mpm.motion.elastic", elastic_);
}

void FastestMode::save(Checkpoint& to) const {
    to.put("mpm.fastest.squared", std::span<const double>(squared_));
    to.put("mpm.fastest.mode", std::span<const Vec2>(mode_));
    to.put("mpm.fastest.deformation", std::span<const Mat2>(deformation_));
}

void FastestMode::load(const Checkpoint& from) {
    get(from, "mpm.fastest.squared", squared_);
    get(from, "mpm.fastest.mode", mode_);
    get(from, "mpm.fastest.deformation", deformation_);
    largest_ = *std::ranges::max_element(squared_);
}

void CommonGrid::save(Checkpoint& to) const {
    std::vector<int> place;
    std::vector<Vec2> impulse, normal;
    for (const NodeContact& c : contact_) {
        place.insert(place.end(), {c.x, c.y, c.i, c.j});
        impulse.push_back(c.impulse);
        normal.push_back(c.normal);
    }
    to.put("mpm.grid.place", std::span<const int>(place));
    to.put("mpm.grid.impulse", std::span<const Vec2>(impulse));
    to.put("mpm.grid.normal", std::span<const Vec2>(normal));
    to.put("mpm.grid.wall_force", std::span<const Vec2>(wall_force_));
    to.put("mpm.grid.dt", dt_);
    to.put("mpm.grid.unconverged_steps", unconverged_steps_);
}

void CommonGrid::load(const Checkpoint& from) {
    std::vector<int> place;
    from.get("mpm.grid.place", place);
    std::vector<Vec2> impulse(place.size() / 4), normal(impulse.size()), wall_force(4);
    get(from, "mpm.grid.impulse", impulse);
    get(from, "mpm.grid.normal", normal);
    get(from, "mpm.grid.wall_force", wall_force);
    contact_.clear();
    for (std::size_t k = 0; k < impulse.size(); ++k) {
        const int* at = place.data() + 4 * k;
        contact_.push_back({at[0], at[1], at[2], at[3], -1, -1, normal[k], 0.0, 0.0, Vec2::Zero(), impulse[k],
                            Vec2::Zero(), Vec2::Zero()});
    }
    std::ranges::copy(wall_force, wall_force_.begin());
    dt_ = from.number("mpm.grid.dt");
    unconverged_steps_ = from.number("mpm.grid.unconverged_steps");
}

}  // namespace softgrain::mpm
