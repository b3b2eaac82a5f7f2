#include "app/bench/stability/small_scene.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/methods.hpp"
#include "common/packing/make_packing.hpp"

namespace softgrain::bench {
namespace {

std::string text_of(const SceneSpec& spec) {
    std::string text = fmt::format(
        "[material]\npoisson_ratio = {}\n[packing]\ncount = {}\nsize_law = \"uniform_volume\"\n"
        "radius_min = {}\nradius_max = 1.0\n[box]\nperiodic = {}\n[[loading]]\nkind = \"hold\"\nduration = "
        "1.0\n",
        spec.poisson_ratio, spec.grains, 1.0 / spec.size_ratio, spec.periodic);
    if (spec.stiffness_ratio != 1.0)
        text += fmt::format("[[grain_class]]\nyoungs_modulus = 1.0\n[[grain_class]]\nyoungs_modulus = {}\n",
                            spec.stiffness_ratio);
    return text;
}

}  // namespace

Scenario with_keys(const SceneSpec& spec, const std::vector<std::string>& set) {
    std::vector<std::string> all = spec.set;
    all.insert(all.end(), set.begin(), set.end());
    return scenario_for(parse_scenario(text_of(spec), "scene", all, method_keys()), find_method(spec.method));
}

Scene make_scene(const SceneSpec& spec) {
    Scene scene{with_keys(spec, {}), {}};
    scene.packing = make_packing(scene.scenario);
    return scene;
}

void Motion::squeeze(double strain, double time) {
    const double vx = 0.5 * strain * box_.width() / time, vy = 0.5 * strain * box_.height() / time;
    for (double done = 0.0; done < time * (1.0 - 1e-12);) {
        const double left = time - done;
        const double dt = left / std::max(1.0, std::ceil(left / solver_->stable_time_step()));
        const WallMotion motion{box_, {vx, -vx, vy, -vy}, 0.0};
        solver_->advance(motion, dt);
        box_ = motion.after(dt);
        done += dt;
    }
}

void Motion::step(double factor) {
    solver_->advance(WallMotion{box_, {}, 0.0}, factor * solver_->stable_time_step());
}

void Motion::load(const Checkpoint& state, const Box& box) {
    solver_->load(state);
    box_ = box;
}

double crossing_time(const Scene& scene, const Solver& solver) {
    double radii = 0.0;
    for (const double r : scene.packing.radius) radii += r;
    return radii / static_cast<double>(scene.packing.size()) *
           std::sqrt(scene.scenario.material.density / solver.stress_scale());
}

}  // namespace softgrain::bench
