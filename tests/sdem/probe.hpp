#pragma once
// Looks at a solver's forces and energies in states set from outside.
#include <functional>
#include <numbers>

#include "harness.hpp"

namespace softgrain::sdem::test {

/// What drives the positions and the F of all grains: f [n] and the moments conjugate to F [n].
struct Drive {
    std::vector<Vec2> force;
    std::vector<Mat2> moment;

    double largest() const {
        double value = 0.0;
        for (const Vec2& f : force) value = std::max(value, f.lpNorm<Eigen::Infinity>());
        for (const Mat2& m : moment) value = std::max(value, m.lpNorm<Eigen::Infinity>());
        return value;
    }
};

/// Half axes of the undeformed grains, and their masses, as the solver has them.
struct Bodies {
    std::vector<Vec2> half_axes;
    std::vector<double> mass;

    Bodies(Solver& solver, const Packing& packing) {
        const GrainView v = solver.view(Need::base);
        for (std::size_t g = 0; g < packing.size(); ++g) {
            half_axes.push_back(packing.half_axes(g));
            mass.push_back(v.mass[g]);
        }
    }
    /// Inertia of each column of F.
    Vec2 inertia(std::size_t g) const { return 0.25 * mass[g] * half_axes[g].cwiseAbs2(); }
};

inline State at_rest(State s) {
    for (Vec2& v : s.velocity) v.setZero();
    for (Mat2& rate : s.F_rate) rate.setZero();
    return s;
}

/// The walls or the cell as they are, not moving.
inline WallMotion still(Solver& solver) {
    return WallMotion{solver.view(Need::base).box, {}};
}

/// Accelerations of a state at rest, from one tiny step.
inline Drive drive_at(Solver& solver, const Bodies& bodies, const State& state) {
    const double dt = 1e-7;
    set_state(solver, at_rest(state));
    solver.advance(still(solver), dt);  // whatever the step before was
    set_state(solver, at_rest(state));
    solver.advance(still(solver), dt);
    const State now = state_of(solver);
    Drive drive;
    for (std::size_t g = 0; g < now.velocity.size(); ++g) {
        drive.force.emplace_back(bodies.mass[g] / dt * now.velocity[g]);
        drive.moment.emplace_back(now.F_rate[g] * bodies.inertia(g).asDiagonal() / dt);
    }
    return drive;
}

inline double elastic_energy_at(Solver& solver, const State& state) {
    set_state(solver, state);
    return solver.view(Need::base).energy.elastic;
}

/// Moves walls or cell without a step.
inline void set_box(Solver& solver, const Box& box) {
    Checkpoint c;
    solver.save(c);
    c.put("sdem.box", std::span<const double>(box.position));
    c.put("sdem.tilt", std::vector<double>{box.tilt, 0.0});
    solver.load(c);
}

/// Order of convergence between the first error and the last.
inline double order_of(const std::vector<double>& error, const std::vector<double>& step) {
    return std::log(error.front() / error.back()) / std::log(step.front() / step.back());
}

/// f'(0) by central differences of fourth order.
inline double slope(const std::function<double(double)>& f, double h) {
    return (8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h);
}

/// Angular frequency of F_xx of the only grain about 1, from its zero crossings.
inline double free_frequency(Solver& solver, double dt, int steps) {
    const auto strain = [&] { return state_of(solver).F[0](0, 0) - 1.0; };
    double before = strain(), first = 0.0, last = 0.0;
    int crossings = 0;
    for (int k = 1; k < steps; ++k) {
        solver.advance(still(solver), dt);
        const double now = strain();
        if ((now < 0.0) != (before < 0.0)) {
            last = dt * (k - now / (now - before));
            if (crossings++ == 0) first = last;
        }
        before = now;
    }
    return std::numbers::pi * (crossings - 1) / (last - first);
}

/// Linear and angular momentum of all grains about the origin.
struct Momentum {
    Vec2 linear = Vec2::Zero();
    double angular = 0.0;
};
inline Momentum momentum_of(const Solver& solver, const Bodies& bodies) {
    const State s = state_of(solver);
    Momentum m;
    for (std::size_t g = 0; g < s.position.size(); ++g) {
        m.linear += bodies.mass[g] * s.velocity[g];
        m.angular += bodies.mass[g] * cross(s.position[g], s.velocity[g]);
        for (int column = 0; column < 2; ++column)
            m.angular +=
                bodies.inertia(g)[column] * cross(Vec2{s.F[g].col(column)}, Vec2{s.F_rate[g].col(column)});
    }
    return m;
}

}  // namespace softgrain::sdem::test
