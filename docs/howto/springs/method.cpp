#include "springs/method.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/gravity.hpp"
#include "common/observables/stress.hpp"

namespace softgrain::springs {
namespace {

/// Discs without rotation: N = max(0, k overlap + c d(overlap)/dt). Every pair is looked at in each step.
class Springs final : public Solver {
  public:
    Springs(const Scenario& scenario, const Packing& packing)
        : box_(packing.box),
          x_(packing.center),
          v_(x_.size(), Vec2::Zero()),
          radius_(packing.radius),
          gravity_(gravity_of(scenario, packing)),
          youngs_modulus_(scenario.material.youngs_modulus),
          k_(scenario.method_settings.at("springs").number("stiffness") * youngs_modulus_) {
        for (const double r : radius_) {
            area_.push_back(std::numbers::pi * r * r);
            mass_.push_back(scenario.material.density * area_.back());
        }
        c_ = std::sqrt(0.5 * k_ * *std::ranges::min_element(mass_));
        find_forces({box_, {}});
    }

    // Six contacts, with room for their dashpots, at the lightest grain.
    double stable_time_step() const override {
        return 0.2 / std::sqrt(6.0 * k_ / *std::ranges::min_element(mass_));
    }

    void advance(const WallMotion& walls, double dt) override {  // kick, drift, kick
        const double before = power_of(walls);
        for (std::size_t g = 0; g < x_.size(); ++g) {
            v_[g] += 0.5 * dt * acceleration_[g];
            energy_.external_work += mass_[g] * gravity_.dot(v_[g]) * dt;
            x_[g] += dt * v_[g];
        }
        energy_.damping += 0.5 * dt * damping_power_;
        box_ = walls.after(dt);
        time_ += dt;
        find_forces({box_, walls.velocity});
        for (std::size_t g = 0; g < x_.size(); ++g) v_[g] += 0.5 * dt * acceleration_[g];
        energy_.damping += 0.5 * dt * damping_power_;
        energy_.external_work += 0.5 * dt * (before + power_of(walls));
    }

    GrainView view(Need) override {  // few grains: everything is filled, whatever is needed
        GrainView view;
        view.time = time_;
        view.box = box_;
        view.centroid = x_;
        view.velocity = v_;
        view.mass = mass_;
        view.gravity = gravity_;
        view.reference_area = view.area = area_;
        for (const double a : area_) view.covered_area += a;
        view.covered_area = std::min(view.covered_area - lens_area_, box_.area());
        view.wall_force = wall_force_;
        view.contacts = contacts_;
        view.energy = energy_;
        for (std::size_t g = 0; g < x_.size(); ++g)
            view.energy.kinetic += 0.5 * mass_[g] * v_[g].squaredNorm();

        stress_.assign(x_.size(), Mat2::Zero());
        for (const GrainContact& c : contacts_)
            for (const auto& [grain, force] : {std::pair(c.i, c.force), std::pair(c.j, Vec2(-c.force))}) {
                if (grain < 0) continue;
                const auto g = static_cast<std::size_t>(grain);
                stress_[g] -= force * (c.point - x_[g]).transpose() / area_[g];
            }
        view.stress = stress_;

        constexpr int corners = 32;
        outline_offset_.assign(1, 0);
        outline_.clear();
        for (std::size_t g = 0; g < x_.size(); ++g) {
            for (int p = 0; p < corners; ++p) {
                const double angle = 2.0 * std::numbers::pi * p / corners;
                outline_.push_back(x_[g] + radius_[g] * Vec2{std::cos(angle), std::sin(angle)});
            }
            outline_offset_.push_back(static_cast<int>(outline_.size()));
        }
        view.outline_offset = outline_offset_;
        view.outline_point = outline_;
        return view;
    }

    const std::array<Vec2, 4>& wall_force() const override { return wall_force_; }
    double stress_scale() const override { return youngs_modulus_; }

    std::optional<std::string> outside_validity() const override {
        if (deepest_ > 0.1) return "an overlap is above 0.1 of the smaller radius";
        return std::nullopt;
    }

    void check_finite() const override {
        for (std::size_t g = 0; g < x_.size(); ++g)
            for (int wall = 0; wall < 4; ++wall)
                if (!(box_.distance(wall, x_[g]) > 0.0))
                    throw DivergedError(static_cast<int>(g), "position", time_, "outside the box");
    }

    // The forces are part of the state: they depend on the velocities of half a step ago.
    void save(Checkpoint& to) const override {
        to.put("box", std::span<const double>(box_.position));
        to.put("wall_velocity", std::span<const double>(wall_velocity_));
        to.put("x", x_);
        to.put("v", v_);
        to.put("v_of_forces", v_of_forces_);
        to.put("scalars", std::vector<double>{time_, energy_.external_work, energy_.damping});
    }
    void load(const Checkpoint& from) override {
        const auto read = [&](std::string_view name, auto& into, std::size_t size) {
            from.get(name, into);
            if (into.size() != size)
                throw InputError("checkpoint array '" + std::string(name) + "' does not fit this packing");
        };
        std::vector<double> box, wall_velocity, scalars;
        std::vector<Vec2> v;
        read("box", box, 4);
        read("wall_velocity", wall_velocity, 4);
        read("scalars", scalars, 3);
        read("x", x_, radius_.size());
        read("v", v, radius_.size());
        read("v_of_forces", v_, radius_.size());
        std::copy(box.begin(), box.end(), box_.position.begin());
        WallMotion walls{box_, {}};
        std::copy(wall_velocity.begin(), wall_velocity.end(), walls.velocity.begin());
        find_forces(walls);
        v_ = v;
        time_ = scalars[0];
        energy_.external_work = scalars[1];
        energy_.damping = scalars[2];
    }

  private:
    double power_of(const WallMotion& walls) const {
        double power = 0.0;
        for (int w = 0; w < 4; ++w)
            power -= wall_force_[static_cast<std::size_t>(w)].dot(walls.velocity_of(w));
        return power;
    }

    void find_forces(const WallMotion& walls) {
        v_of_forces_ = v_;
        wall_velocity_ = walls.velocity;
        acceleration_.assign(x_.size(), gravity_);
        wall_force_.fill(Vec2::Zero());
        contacts_.clear();
        energy_.elastic = damping_power_ = lens_area_ = deepest_ = 0.0;
        for (std::size_t i = 0; i < x_.size(); ++i) {
            for (int w = 3; w >= 0; --w)  // sorted: -4 (top) comes before -1 (left)
                touch(i, -1 - w, radius_[i] - box_.distance(w, x_[i]), -wall_normal(w),
                      walls.velocity_of(w) - v_[i]);
            for (std::size_t j = i + 1; j < x_.size(); ++j) {
                const Vec2 d = x_[j] - x_[i];
                touch(i, static_cast<int>(j), radius_[i] + radius_[j] - d.norm(), d.normalized(),
                      v_[j] - v_[i]);
            }
        }
    }

    /// j is a grain or -1 - wall; `normal` points out of i, `velocity` is that of j against i.
    void touch(std::size_t i, int j, double overlap, const Vec2& normal, const Vec2& velocity) {
        if (overlap <= 0.0) return;
        const double k = j < 0 ? k_ : 0.5 * k_;
        const double spring = k * overlap;
        const double push = std::max(0.0, spring - c_ * velocity.dot(normal));
        const Vec2 force = -push * normal;  // on i
        const double arm = radius_[i] - (j < 0 ? overlap : 0.5 * overlap);
        contacts_.push_back({static_cast<int>(i), j, x_[i] + arm * normal, normal, force, 0.0});
        acceleration_[i] += force / mass_[i];
        if (j < 0) {
            wall_force_[static_cast<std::size_t>(-1 - j)] -= force;
        } else {
            acceleration_[static_cast<std::size_t>(j)] -= force / mass_[static_cast<std::size_t>(j)];
        }
        energy_.elastic += 0.5 * spring * overlap;
        damping_power_ -= (push - spring) * velocity.dot(normal);
        // Lens of two discs, or the segment beyond a wall, to first order in overlap / radius.
        const double other = j < 0 ? radius_[i] : radius_[static_cast<std::size_t>(j)];
        const double flat = j < 0 ? radius_[i] : radius_[i] * other / (radius_[i] + other);
        lens_area_ += 4.0 / 3.0 * overlap * std::sqrt(2.0 * flat * overlap);
        deepest_ = std::max(deepest_, overlap / std::min(radius_[i], other));
    }

    Box box_;
    std::vector<Vec2> x_, v_, v_of_forces_, acceleration_;
    std::vector<double> radius_, area_, mass_;
    Vec2 gravity_;
    double youngs_modulus_, k_, c_ = 0.0, time_ = 0.0;
    double damping_power_ = 0.0, lens_area_ = 0.0, deepest_ = 0.0;
    std::array<double, 4> wall_velocity_{};
    std::array<Vec2, 4> wall_force_;
    std::vector<GrainContact> contacts_;
    EnergyLedger energy_;

    // what the last view shows
    std::vector<Mat2> stress_;
    std::vector<int> outline_offset_;
    std::vector<Vec2> outline_;
};

std::span<const KeySpec> keys() {
    static const std::array<KeySpec, 1> table{
        {{"stiffness", KeyType::number, 1.0, "E", "of a grain against a wall; a pair has half of it",
          positive}}};
    return table;
}

constexpr std::array refusals{
    Refusal{Feature::periodic_cell, "it has walls only"},
    Refusal{Feature::grain_classes, "its grains are of one material"},
    Refusal{Feature::ellipses, "its grains are discs"},
    Refusal{Feature::clumps, "its grains are discs"},
    Refusal{Feature::friction, "its grains do not turn"},
    Refusal{Feature::wall_friction, "its grains do not turn"},
    Refusal{Feature::cohesion, "its contacts only push"},
    Refusal{Feature::yield_stress, "its contacts are elastic"},
    Refusal{Feature::driven_grains, "forces move all of its grains"},
};

}  // namespace

const Method& method() {
    static const Method row{
        .name = "springs",
        .title = "frictionless discs on springs, an example",
        .keys = keys,
        .make = [](const Scenario& scenario, const Packing& packing) -> std::unique_ptr<Solver> {
            refuse(scenario, packing, "springs", refusals);
            return std::make_unique<Springs>(scenario, packing);
        },
        .not_given = "contact_penetration, contact_sweeps, unconverged_steps, fragments",
        .refusals = refusals};
    return row;
}

}  // namespace softgrain::springs
