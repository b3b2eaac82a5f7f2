#include "tests/contract/scenes.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain::testing {

const std::vector<Bands>& all_bands() {
    static const std::vector<Bands> table{
        // Elastic discs: rounding only, but for the damped approach to rest; edges of a cell drawn elsewhere
        // round otherwise (5e-13 seen in the stress). The ledger is good to the leap-frog (9e-5 seen).
        {"sdem", 0.0, 0.0, 1e-9, 1e-8, 0.02, 5e-4, 1e-12, 400.0, 5e-3, 1e-3, 350.0, 0.5, 1e-10, 1e-6, 1e-6,
         1e-11},
        // Aggregates: the rough rim finds its place at the start; rearranging discs amplify rounding (1e-9
        // seen between images); stick-slip never quite comes to rest; pores between the bumps of two grains
        // that touch count as covered. A weight moves a disc in a step by less than the contact solver's
        // tolerance: it is carried in the mean (3e-3 seen in the stress), not in every step.
        {"bpm", 0.15, 1e-3, 1e-5, 1e-3, 0.15, 0.15, 0.05, 60.0, 0.07, 2e-3, 25.0, 1.0, 1e-10, 0.02, 1.0},
        {"rigid_dem", 0.0, 0.0, 1e-9, 1e-8, 0.02, 5e-3, 1e-12, 400.0, 1e-3, 5e-4, 700.0, 1.0, 1e-10, 1e-6,
         1e-6, 1e-8},
        // Resolved grains moved by leap-frog. Shape functions sum to one within rounding. Grains that bounce
        // deform little, and only that is damped: a column still trembles, its mean force is within 2.1 %.
        {"mpm", 1e-14, 1e-12, 1e-9, 1e-8, 0.02, 5e-3, 1e-12, 300.0, 8e-3, 1e-2, 0.0, 0.5, 1e-10, 0.03, 1.0},
    };
    return table;
}

void PrintTo(const Bands& bands, std::ostream* out) {
    *out << bands.method;
}

Scenario scenario_of(const std::string& method, const std::string& extra) {
    const std::string text =
        "title = \"contract\"\n[[loading]]\nkind = \"isotropic\"\nstrain_rate = 1e-3\nuntil_strain = 0.1\n"
        "[bpm]\ndiscs_per_grain = 40\n[mpm]\ndriver = \"explicit\"\npoints_across_radius = 4\n" +
        extra;
    return scenario_for(parse_scenario(text, "contract.toml", {}, method_keys()), find_method(method));
}

Packing nine_grains() {
    Packing p;
    p.box.position = {0.0, 6.3, 0.0, 6.3};
    const double jitter[] = {0.01, -0.02, 0.03, -0.01, 0.02, -0.03, 0.005, 0.015, -0.01};
    for (int k = 0; k < 9; ++k) {
        p.center.emplace_back(1.05 + 2.1 * (k % 3) + jitter[k], 1.05 + 2.1 * (k / 3) - jitter[(k + 4) % 9]);
        p.radius.push_back(k % 2 == 0 ? 1.0 : 0.95);
    }
    return p;
}

Packing four_grains() {
    Packing p;
    p.box.position = {0.0, 4.9, 0.0, 4.9};
    p.center = {{1.23, 1.21}, {3.66, 1.25}, {1.20, 3.69}, {3.70, 3.64}};
    p.radius = {1.0, 0.95, 0.98, 1.0};
    return p;
}

Packing square_lattice(int side) {
    Packing p;
    p.box.position = {0.0, 2.0 * side, 0.0, 2.0 * side};
    for (int k = 0; k < side * side; ++k) {
        p.center.emplace_back(1.0 + 2.0 * (k % side), 1.0 + 2.0 * (k / side));
        p.radius.push_back(1.0);
    }
    return p;
}

Packing image_of(const Packing& packing, const Mat2& image) {
    Packing turned = packing;
    const Vec2 middle{0.5 * (packing.box.position[0] + packing.box.position[1]),
                      0.5 * (packing.box.position[2] + packing.box.position[3])};
    turned.frame.clear();
    for (std::size_t g = 0; g < packing.size(); ++g) {
        turned.center[g] = middle + image * (packing.center[g] - middle);
        turned.frame.push_back(image * packing.frame_of(g));
    }
    return turned;
}

bool has_friction(const Bands& bands) {
    return std::ranges::none_of(find_method(bands.method).refusals,
                                [](const Refusal& refusal) { return refusal.feature == Feature::friction; });
}

LoadingStage to_pressure(double pressure, double inertial_number) {
    LoadingStage stage;
    stage.kind = LoadingKind::stress;
    stage.stress_xx = stage.stress_yy = pressure;
    stage.inertial_number = inertial_number;
    return stage;
}

Scenario served(const Bands& bands, std::vector<LoadingStage> stages) {
    Scenario s = scenario_of(bands.method, has_friction(bands) ? "[material]\nfriction = 0.3\n" : "");
    s.loading = std::move(stages);
    s.sampling.strain_interval = 0.01;
    return s;
}

std::unique_ptr<Solver> make(const Bands& bands, const Scenario& scenario, const Packing& packing) {
    return find_method(bands.method).make(scenario, packing);
}

namespace {

Box drive(Solver& solver, Box box, const std::array<double, 4>& velocity, double tilt_rate, double time,
          const std::function<void(const Box&, double)>& after_step) {
    for (double done = 0.0; done < time * (1.0 - 1e-12);) {
        const double left = time - done;
        const double dt = left / std::max(1.0, std::ceil(left / solver.stable_time_step()));
        const WallMotion motion{box, velocity, tilt_rate};
        solver.advance(motion, dt);
        box = motion.after(dt);
        done += dt;
        after_step(box, dt);
    }
    return box;
}

}  // namespace

Box squeeze(Solver& solver, Box box, double strain, double time,
            const std::function<void(const Box&, double)>& after_step) {
    const double vx = 0.5 * strain * box.width() / time;
    const double vy = 0.5 * strain * box.height() / time;
    return drive(solver, box, {vx, -vx, vy, -vy}, 0.0, time, after_step);
}

Box deform(Solver& solver, Box box, double strain, double shear, double time,
           const std::function<void(const Box&, double)>& after_step) {
    const double vx = 0.5 * strain * box.width() / time;
    const double vy = 0.5 * strain * box.height() / time;
    // The second lattice vector shrinks as a whole.
    const double tilt_rate = (shear * box.height() - strain * box.tilt) / time;
    return drive(solver, box, {vx, -vx, vy, -vy}, tilt_rate, time, after_step);
}

Box push(Solver& solver, Box box, Wall wall, double strain, double time,
         const std::function<void(const Box&, double)>& after_step) {
    const int w = static_cast<int>(wall);
    const double length = wall_axis(w) == 0 ? box.width() : box.height();
    std::array<double, 4> velocity{};
    velocity[static_cast<std::size_t>(w)] = wall_sign(w) * strain * length / time;
    return drive(solver, box, velocity, 0.0, time, after_step);
}

}  // namespace softgrain::testing
