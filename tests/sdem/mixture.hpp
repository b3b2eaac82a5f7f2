#pragma once
// A small sample with everything in it: unequal sizes, ellipses, two materials, deformed grains, four walls.
#include "probe.hpp"
#include "random_ellipses.hpp"

namespace softgrain::sdem::test {

inline void add_classes(Scenario& s, double E_ratio, double second_nu) {
    s.classes.resize(2);
    s.classes[0].material = s.classes[1].material = s.material;
    s.classes[1].material.youngs_modulus = E_ratio * s.material.youngs_modulus;
    s.classes[1].material.poisson_ratio = second_nu;
    s.classes[1].material.density = 1.5 * s.material.density;
}

/// Five grains that press on each other and on all walls.
inline Packing mixture_packing() {
    Packing p;
    p.box.position = {0.0, 3.5, 0.0, 3.35};
    p.center = {{0.97, 0.95}, {2.62, 0.87}, {1.0, 2.55}, {2.65, 2.5}, {1.83, 1.72}};
    p.radius = {1.0, 0.9, 0.85, 0.88, 0.4};
    p.grain_class = {0, 1, 1, 0, 1};
    p.aspect_ratio = {1.0, 1.15, 1.2, 1.0, 1.5};
    p.angle = {0.0, 0.4, 1.3, 0.0, 2.2};
    return p;
}

/// The same grains, each strained and turned a little.
inline State mixture_state(const Solver& solver) {
    State s = at_rest(state_of(solver));
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> part(-0.05, 0.05);
    for (Mat2& F : s.F) {
        Mat2 change;
        change << part(random), part(random), part(random), part(random);
        F = F * (Mat2::Identity() + change);
    }
    return s;
}

}  // namespace softgrain::sdem::test
