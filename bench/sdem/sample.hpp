#pragma once
// Samples of the size law of Mollon 2022 at any packing fraction, and copies of a relaxed cell side by side.
#include <malloc.h>

#include <memory>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/packing/make_packing.hpp"
#include "common/solver.hpp"
#include "sdem/method.hpp"

namespace softgrain::sdem {

struct Case {
    std::string law = "lens_potential", geometry = "batch";
    int threads = 1;
    bool periodic = false;
    double damping = 1.0;
};

/// 1000 grains of sample A.
inline Scenario scenario_of(const Case& c) {
    Scenario s;
    s.packing.count = 1000;
    s.packing.radius_mean = 0.012;
    s.packing.radius_deviation = 0.0024;
    s.packing.radius_min = 0.008;
    s.packing.radius_max = 0.016;
    s.box.periodic = c.periodic;
    Settings settings(method().keys());
    settings.set("law", c.law);
    settings.set("geometry", c.geometry);
    settings.set("contact_damping", c.damping);
    settings.set("shape_damping", 0.5 * c.damping);
    s.method_settings.emplace("sdem", settings);
    return s;
}

/// What this process has allocated and not freed [bytes].
inline double allocated() {
    const auto use = mallinfo2();
    return static_cast<double>(use.uordblks + use.hblkhd);
}

/// A packing on its way.
class Run {
  public:
    static constexpr double slow = 1e-3, fast = 0.04;  ///< strain rates [1/s]

    Run(const Case& c, const Packing& packing) : box_(packing.box), size_(packing.size()) {
        const double before = allocated();
        solver_ = method().make(scenario_of(c), packing);
        advance(1, slow);
        memory_ = (allocated() - before) / static_cast<double>(size_);
        for (double R : packing.radius) area_ += std::numbers::pi * R * R;
    }
    void advance(int steps, double strain_rate) {
        for (int k = 0; k < steps; ++k) {
            const double v = 0.5 * strain_rate * box_.width(), w = 0.5 * strain_rate * box_.height();
            const WallMotion motion{box_, {v, -v, w, -w}};
            const double dt = solver_->stable_time_step();
            solver_->advance(motion, dt);
            box_ = motion.after(dt);
        }
    }
    void compress_to(double packing_fraction) {
        while (area_ / box_.area() < packing_fraction) advance(1, fast);
    }
    /// Holds the box until next to nothing moves.
    void come_to_rest() {
        constexpr double rest = 1e-6;  // kinetic / elastic energy
        for (int round = 0; round < 500; ++round) {
            advance(100, 0.0);
            const EnergyLedger e = solver_->view(Need::base).energy;
            if (e.kinetic < rest * e.elastic) return;
        }
        throw std::runtime_error("the cell does not come to rest");
    }
    /// Bytes per grain, with one step made.
    double memory() const { return memory_; }
    double contacts_per_grain() {
        double count = 0.0;
        for (const GrainContact& c : solver_->view(Need::contacts).contacts)
            count += c.with_wall() ? 0.0 : 1.0;
        return count / static_cast<double>(size_);
    }
    const Box& box() const { return box_; }
    std::size_t size() const { return size_; }
    Solver& solver() { return *solver_; }

  private:
    std::unique_ptr<Solver> solver_;
    Box box_;
    std::size_t size_;
    double area_ = 0.0, memory_ = 0.0;
};

/// Copies of a periodic cell side by side, `side` in each direction: a packing of the centres, and a way to
/// put its run into the state of the cell's grains.
class Tiles {
  public:
    Tiles(Run& cell, const Packing& packing, int side) : side_(side), box_(cell.box()) {
        cell.solver().save(state_);
        many_.box = box_;
        many_.box.position[1] = box_.position[0] + side * box_.width();
        many_.box.position[3] = box_.position[2] + side * box_.height();
        many_.center = centers();
        many_.radius = repeated(packing.radius);
    }
    const Packing& packing() const { return many_; }
    void put_into(Run& run) const {
        Checkpoint c;
        run.solver().save(c);
        c.put("sdem.position", centers());
        c.put("sdem.velocity", repeated(values<Vec2>("sdem.velocity")));
        c.put("sdem.F", repeated(values<Mat2>("sdem.F")));
        c.put("sdem.F_rate", repeated(values<Mat2>("sdem.F_rate")));
        c.put("sdem.time_step", state_.number("sdem.time_step"));
        run.solver().load(c);
    }

  private:
    template <class T>
    std::vector<T> values(std::string_view name) const {
        std::vector<T> read;
        state_.get(name, read);
        return read;
    }
    template <class T>
    std::vector<T> repeated(const std::vector<T>& one) const {
        std::vector<T> all;
        for (int tile = 0; tile < side_ * side_; ++tile) all.insert(all.end(), one.begin(), one.end());
        return all;
    }
    std::vector<Vec2> centers() const {
        std::vector<Vec2> all;
        for (int y = 0; y < side_; ++y)
            for (int x = 0; x < side_; ++x)
                for (const Vec2& c : values<Vec2>("sdem.position")) all.push_back(c + box_.image(x, y));
        return all;
    }

    int side_;
    Box box_;
    Checkpoint state_;
    Packing many_;
};

}  // namespace softgrain::sdem
