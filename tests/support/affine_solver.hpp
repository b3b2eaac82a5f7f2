#pragma once
// A method without physics: grains follow the walls or the cell affinely and push back with p = stiffness *
// (phi - phi_start), a cell also with a shear stress of -stiffness times its shear strain. For tests of the
// loop, the observables and the writers.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "common/errors.hpp"
#include "common/solver.hpp"

namespace softgrain::testing {

class AffineSolver final : public Solver {
  public:
    explicit AffineSolver(const Packing& packing, double stiffness = 1.0)
        : packing_(packing), start_(packing.box), box_(packing.box), stiffness_(stiffness) {
        for (double r : packing.radius) area_.push_back(M_PI * r * r);
        velocity_.assign(packing.size(), Vec2::Zero());
        update();
    }
    double stable_time_step() const override { return time_step; }
    void advance(const WallMotion& walls, double dt) override {
        box_ = walls.after(dt);
        time_ += dt;
        ++steps;
        if (time_ > poison_at) velocity_[0].x() = std::nan("");
        update();
    }
    GrainView view(Need) override {
        GrainView v;
        v.time = time_;
        v.box = box_;
        v.centroid = center_;
        v.velocity = velocity_;
        v.mass = area_;
        v.reference_area = area_;
        v.wall_force = force_;
        v.area = area_;
        v.covered_area = packing_.packing_fraction_undeformed() * packing_.box.area();
        return v;
    }
    const std::array<Vec2, 4>& wall_force() const override { return force_; }
    Mat2 cell_stress() const override { return cell_stress_; }
    double stress_scale() const override { return stiffness_; }
    std::optional<std::string> outside_validity() const override {
        if (box_.width() < invalid_below) return "the box is too narrow";
        return std::nullopt;
    }
    void check_finite() const override {
        if (!velocity_[0].allFinite()) throw DivergedError(0, "velocity", time_, "not a finite number");
    }
    void save(Checkpoint& to) const override {
        to.put("box", std::span<const double>(box_.position));
        to.put("tilt", box_.tilt);
        to.put("time", time_);
    }
    void load(const Checkpoint& from) override {
        std::vector<double> p;
        from.get("box", p);
        std::copy(p.begin(), p.end(), box_.position.begin());
        box_.tilt = from.number("tilt");
        time_ = from.number("time");
        update();
    }

    double time_step = 0.01;
    double poison_at = 1e300;
    double invalid_below = 0.0;
    int steps = 0;

  private:
    void update() {
        center_.clear();
        for (const Vec2& c : packing_.center) {
            const Vec2 unit{(c.x() - start_.position[0]) / start_.width(),
                            (c.y() - start_.position[2]) / start_.height()};
            center_.emplace_back(box_.position[0] + unit.x() * box_.width() + unit.y() * box_.tilt,
                                 box_.position[2] + unit.y() * box_.height());
        }
        const double p = stiffness_ * (start_.area() / box_.area() - 1.0);
        const double shear = -stiffness_ * box_.shear_strain();
        cell_stress_ << p, shear, shear, p;
        if (box_.periodic) return;
        for (int w = 0; w < 4; ++w)
            force_[static_cast<std::size_t>(w)] =
                -p * (wall_axis(w) == 0 ? box_.height() : box_.width()) * wall_normal(w);
    }

    Packing packing_;
    Box start_, box_;
    double stiffness_;
    double time_ = 0.0;
    std::vector<Vec2> center_, velocity_;
    std::vector<double> area_;
    Mat2 cell_stress_ = Mat2::Zero();
    std::array<Vec2, 4> force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

}  // namespace softgrain::testing
