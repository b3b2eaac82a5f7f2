#pragma once
// A packing of a few grains in a solver, outside of the time loop: squeezed, held, watched.
#include <memory>
#include <string>
#include <vector>

#include "common/solver.hpp"

namespace softgrain::bench {

/// What a scene is made of; the rest is the method's defaults and `set`.
struct SceneSpec {
    std::string method;
    std::vector<std::string> set;  ///< KEY=VALUE
    int grains = 12;
    double poisson_ratio = 0.3;
    double size_ratio = 1.5;       ///< largest / smallest radius
    double stiffness_ratio = 1.0;  ///< of two classes of grains, if not 1
    bool periodic = false;
};

struct Scene {
    Scenario scenario;
    Packing packing;
};

/// By the growth generator, at its jamming point. Throws InputError.
Scene make_scene(const SceneSpec& spec);

/// The same scenario with other keys; the packing stays. Throws InputError.
Scenario with_keys(const SceneSpec& spec, const std::vector<std::string>& set);

/// A solver and the box it is in.
class Motion {
  public:
    Motion(std::unique_ptr<Solver> solver, const Box& box) : solver_(std::move(solver)), box_(box) {}

    Solver& solver() { return *solver_; }
    const Box& box() const { return box_; }

    /// Box sides shrink by `strain` of what they are, in `time`.
    void squeeze(double strain, double time);
    /// Still walls; `factor` times the step that the solver asks for.
    void step(double factor = 1.0);
    void hold(long long steps) {
        for (long long k = 0; k < steps; ++k) step();
    }
    void load(const Checkpoint& state, const Box& box);
    EnergyLedger energy() { return solver_->view(Need::base).energy; }

  private:
    std::unique_ptr<Solver> solver_;
    Box box_;
};

/// Of a wave through a mean grain [s].
double crossing_time(const Scene& scene, const Solver& solver);

}  // namespace softgrain::bench
