#pragma once
// Two rows of discs, one along each axis, each between two walls: a packing whose stiffness and inertia are
// known in closed form. For tests of servo-control: waves run through it, and it may have gaps at the start.
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/solver.hpp"

namespace softgrain::testing {

/// Discs of diameter 1 and mass 1; a contact pushes with stiffness * overlap^power and a dashpot.
class ChainSolver final : public Solver {
  public:
    struct Law {
        double stiffness = 1.0;  ///< of a contact [N/m^power]
        double power = 1.0;
        double damping = 0.1;  ///< share of critical
        double gap = 0.0;      ///< between discs at the start / diameter
        double tremble = 0.0;  ///< wall forces go up and down by this share, at random
        double scale = 1.0;    ///< that it says its stress has, whatever it is
    };

    /// `discs` along each axis, in the box of packing(); one row stands for a whole square of them.
    ChainSolver(int discs, const Law& law) : law_(law), box_(box(discs, law)) {
        for (auto& row : rows_) {
            row.velocity.assign(static_cast<std::size_t>(discs), 0.0);
            for (int k = 0; k < discs; ++k) row.position.push_back((k + 0.5) * (1.0 + law.gap));
        }
    }
    /// The same discs for the time loop: a square of them, of density 1.
    static Packing packing(int discs, const Law& law) {
        Packing p;
        p.box = box(discs, law);
        for (int k = 0; k < discs * discs; ++k) {
            p.center.emplace_back((k % discs + 0.5) * (1.0 + law.gap), (k / discs + 0.5) * (1.0 + law.gap));
            p.radius.push_back(0.5);
        }
        return p;
    }

    double stable_time_step() const override { return 0.1 / std::sqrt(law_.stiffness); }
    void advance(const WallMotion& walls, double dt) override {
        box_ = walls.after(dt);
        time_ += dt;
        for (std::size_t a = 0; a < 2; ++a) {
            const auto row_force = step(rows_[a], box_.position[2 * a], box_.position[2 * a + 1],
                                        walls.velocity[2 * a], walls.velocity[2 * a + 1], dt);
            const double rows = a == 0 ? box_.height() : box_.width();
            for (std::size_t side = 0; side < 2; ++side) {
                Vec2& force = force_[2 * a + side];
                force = -row_force[side] * rows * (1.0 + law_.tremble * noise()) *
                        wall_normal(static_cast<int>(2 * a + side));
            }
        }
    }
    GrainView view(Need) override {
        center_.assign(rows_[0].position.size(), Vec2::Zero());
        GrainView v;
        v.time = time_;
        v.box = box_;
        v.centroid = v.velocity = center_;
        mass_.assign(center_.size(), 1.0);
        v.mass = v.reference_area = v.area = mass_;
        v.wall_force = force_;
        return v;
    }
    const std::array<Vec2, 4>& wall_force() const override { return force_; }
    double stress_scale() const override { return law_.scale; }
    void check_finite() const override {}
    void save(Checkpoint& to) const override {
        std::vector<double> all{time_, random_};
        all.insert(all.end(), box_.position.begin(), box_.position.end());
        for (const Row& row : rows_) {
            all.insert(all.end(), row.position.begin(), row.position.end());
            all.insert(all.end(), row.velocity.begin(), row.velocity.end());
        }
        to.put("all", all);
        to.put("force", std::span<const Vec2>(force_));
    }
    void load(const Checkpoint& from) override {
        std::vector<double> all;
        from.get("all", all);
        std::size_t next = 0;
        time_ = all.at(next++);
        random_ = all.at(next++);
        for (double& p : box_.position) p = all.at(next++);
        for (Row& row : rows_) {
            for (double& x : row.position) x = all.at(next++);
            for (double& v : row.velocity) v = all.at(next++);
        }
        std::vector<Vec2> force;
        from.get("force", force);
        std::copy(force.begin(), force.end(), force_.begin());
    }

    /// Stress in the middle of the row along x, without the dashpots [N/m].
    double middle_stress() const {
        const auto& x = rows_[0].position;
        const double overlap = 1.0 - (x[x.size() / 2] - x[x.size() / 2 - 1]);
        return overlap > 0.0 ? law_.stiffness * std::pow(overlap, law_.power) : 0.0;
    }
    /// Time of a wave through the row at this stress.
    double response_time(double stress) const {
        const double slope = law_.power * std::pow(law_.stiffness, 1.0 / law_.power) *
                             std::pow(stress, 1.0 - 1.0 / law_.power);
        return static_cast<double>(rows_[0].position.size()) / std::sqrt(slope);
    }

  private:
    struct Row {
        std::vector<double> position, velocity;
    };

    static Box box(int discs, const Law& law) {
        Box b;
        b.position = {0.0, discs * (1.0 + law.gap), 0.0, discs * (1.0 + law.gap)};
        return b;
    }
    /// -1 to 1, repeatable.
    double noise() {
        random_ = std::fmod(16807.0 * random_, 2147483647.0);
        return 2.0 * random_ / 2147483647.0 - 1.0;
    }
    /// Force on each wall.
    std::array<double, 2> step(Row& row, double low, double high, double low_rate, double high_rate,
                               double dt) const {
        auto& x = row.position;
        auto& v = row.velocity;
        const double dashpot = 2.0 * law_.damping * std::sqrt(law_.stiffness);
        const auto force = [&](double overlap, double rate) {
            return overlap > 0.0
                       ? std::max(0.0, law_.stiffness * std::pow(overlap, law_.power) + dashpot * rate)
                       : 0.0;
        };
        const std::size_t n = x.size();
        std::vector<double> f(n + 1);
        f[0] = force(0.5 - (x[0] - low), low_rate - v[0]);
        for (std::size_t k = 1; k < n; ++k) f[k] = force(1.0 - (x[k] - x[k - 1]), v[k - 1] - v[k]);
        f[n] = force(0.5 - (high - x[n - 1]), v[n - 1] - high_rate);
        for (std::size_t k = 0; k < n; ++k) {
            v[k] += (f[k] - f[k + 1]) * dt;
            x[k] += v[k] * dt;
        }
        return {f[0], f[n]};
    }

    Law law_;
    Box box_;
    std::array<Row, 2> rows_;
    double time_ = 0.0, random_ = 1.0;
    std::array<Vec2, 4> force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    std::vector<Vec2> center_;
    std::vector<double> mass_;
};

}  // namespace softgrain::testing
