#pragma once
// Small scenarios and state changes for the solver's tests.
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "common/errors.hpp"
#include "sdem/method.hpp"

namespace softgrain::sdem::test {

inline Settings& settings(Scenario& s) {
    return s.method_settings.at("sdem");
}
/// The law that runs use if nothing else is said.
inline Scenario default_scenario(double nu) {
    Scenario s;
    s.material.poisson_ratio = nu;
    s.method_settings.emplace("sdem", Settings(method().keys()));
    return s;
}
/// The law as printed.
inline Scenario scenario_with(double nu) {
    Scenario s = default_scenario(nu);
    settings(s).set("law", std::string("mollon2022"));
    return s;
}
inline void switch_off_damping(Scenario& s) {
    settings(s).set("contact_damping", 0.0);
    settings(s).set("shape_damping", 0.0);
}
/// Equilibria instead of dynamics; forces balance to this share of the mean contact force.
inline void set_quasi_static(Scenario& s, double tolerance) {
    settings(s).set("driver", std::string("quasi_static"));
    settings(s).set("tolerance", tolerance);
}

inline Scenario undamped_scenario(double nu = 0.3) {
    Scenario s = default_scenario(nu);
    switch_off_damping(s);
    return s;
}

inline Packing packing_of(Box box, std::vector<Vec2> center, std::vector<double> radius) {
    return Packing{box, std::move(center), std::move(radius), {}};
}
/// One grain of radius 0.5 in its bounding square.
inline Packing single_grain() {
    return packing_of(Box{}, {Vec2{0.5, 0.5}}, {0.5});
}
inline Box far_away() {
    return Box{{-100.0, 100.0, -100.0, 100.0}};
}
/// side x side unequal discs that touch, in their box: at 29 x 29 threads are used.
inline Packing touching_lattice(int side) {
    Packing p;
    for (int k = 0; k < side * side; ++k) {
        p.center.emplace_back(0.5 + k % side, 0.5 + static_cast<double>(k / side));
        p.radius.push_back(0.5 - 0.04 * std::abs(std::sin(1.7 * k)));
    }
    p.box.position = {0.0, static_cast<double>(side), 0.0, static_cast<double>(side)};
    return p;
}
/// The reference packing of 24 discs at its rigid jamming point.
inline Packing packing24() {
    std::ifstream file(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/packing24_initial_xyr.csv");
    Packing p;
    p.box.position = {0.0, 9.7252281033, 0.0, 9.7252281033};
    for (std::string line; std::getline(file, line);) {
        double x, y, r;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &x, &y, &r) != 3) continue;
        p.center.emplace_back(x, y);
        p.radius.push_back(r);
    }
    if (p.size() != 24) throw OutputError("packing24_initial_xyr.csv is missing or cut short");
    return p;
}

inline std::unique_ptr<Solver> solver_for(const Scenario& s, const Packing& p) {
    return method().make(s, p);
}

/// Puts the grains into any state: [n] positions, velocities, F and F'.
struct State {
    std::vector<Vec2> position, velocity;
    std::vector<Mat2> F, F_rate;
};
inline State state_of(const Solver& solver) {
    Checkpoint c;
    solver.save(c);
    State s;
    c.get("sdem.position", s.position);
    c.get("sdem.velocity", s.velocity);
    c.get("sdem.F", s.F);
    c.get("sdem.F_rate", s.F_rate);
    return s;
}
inline void set_state(Solver& solver, const State& s) {
    Checkpoint c;
    solver.save(c);
    c.put("sdem.position", std::span<const Vec2>(s.position));
    c.put("sdem.velocity", std::span<const Vec2>(s.velocity));
    c.put("sdem.F", std::span<const Mat2>(s.F));
    c.put("sdem.F_rate", std::span<const Mat2>(s.F_rate));
    solver.load(c);
}

/// All walls inwards (or outwards, negative) at one speed.
inline WallMotion closing(const Box& box, double speed) {
    return WallMotion{box, {speed, -speed, speed, -speed}};
}
/// Advances by `steps` of the stable step (times factor) with walls closing at `speed`.
inline void run(Solver& solver, int steps, double speed = 0.0, double factor = 1.0) {
    for (int k = 0; k < steps; ++k)
        solver.advance(closing(solver.view(Need::base).box, speed), factor * solver.stable_time_step());
}
/// Closes the walls until the box has this width.
inline void close_to(Solver& solver, double width, double speed) {
    for (;;) {
        const Box box = solver.view(Need::base).box;
        const double left = 0.5 * (box.width() - width);
        if (left <= 1e-12) return;
        const double dt = std::min(solver.stable_time_step(), left / speed);
        solver.advance(closing(box, speed), dt);
    }
}

inline double residual(const EnergyLedger& e, double initial = 0.0) {
    return initial + e.external_work - e.kinetic - e.elastic - e.dissipated();
}
/// Closes the walls to the widths `from`, `from - step` ... above `to`; largest residual of the ledger there.
inline double residual_while_closing(Solver& solver, double from, double to, double step, double speed) {
    double largest = 0.0;
    for (double width = from; width > to; width -= step) {
        close_to(solver, width, speed);
        largest = std::max(largest, std::abs(residual(solver.view(Need::base).energy)));
    }
    return largest;
}

}  // namespace softgrain::sdem::test
