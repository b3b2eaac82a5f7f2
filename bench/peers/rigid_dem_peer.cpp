// Rigid DEM on the sample that its peers are given: makes it, runs it, says what it measured as one line of
// CSV.
#include <malloc.h>
#include <sys/resource.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstdio>
#include <fstream>

#include <fmt/ostream.h>

#include "bench/peers/packed_discs.hpp"
#include "common/observables/coordination.hpp"
#include "rigid_dem/method.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::peers {
namespace {

// The same as in the peers' input: pair stiffness 1e5, so that a grain at a wall has twice as much.
constexpr double pair_stiffness = 1e5, shear_ratio = 0.5, density = 1.0, dt = 1e-4;

struct Options {
    int grains = 10000, tiles = 1, steps = 1000, rounds = 1;
    double friction = 0.0, restitution = 1.0, speed = 1.0, shear_rate = 0.0;
    std::string lammps;
    bool memory = false;
};

Scenario scenario_of(const Options& o) {
    Scenario s;
    s.material.youngs_modulus = 2.0 * pair_stiffness;
    s.material.density = density;
    s.material.friction = o.friction;
    Settings table(rigid_dem::keys());
    table.set("shear_ratio", shear_ratio);
    table.set("restitution", o.restitution);
    table.set("overlap_limit", 1.0);
    s.method_settings["rigid_dem"] = table;
    return s;
}

/// For LAMMPS's read_data, atom style sphere.
void write_lammps(const std::string& path, const Packing& p, const std::vector<Vec2>& v) {
    std::ofstream file(path);
    fmt::print(
        file,
        "discs\n\n{} atoms\n1 atom types\n0 {} xlo xhi\n0 {} ylo yhi\n-0.5 0.5 zlo zhi\n0 0 0 xy xz yz\n",
        p.size(), p.box.width(), p.box.height());
    fmt::print(file, "\nAtoms # sphere\n\n");
    for (std::size_t i = 0; i < p.size(); ++i)
        fmt::print(file, "{} 1 {} {} {} {} 0\n", i + 1, 2.0 * p.radius[i], density, p.center[i].x(),
                   p.center[i].y());
    fmt::print(file, "\nVelocities\n\n");
    for (std::size_t i = 0; i < p.size(); ++i)
        fmt::print(file, "{} {} {} 0 0 0 0\n", i + 1, v[i].x(), v[i].y());
}

double peak_memory() {  // [bytes]
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

int run(const Options& o) {
    Packing packing = tiled(packed_cell(o.grains, 1), o.tiles);
    // LAMMPS finds the forces of a step before it moves its cell: one step behind.
    packing.box.tilt = -o.shear_rate * packing.box.height() * dt;
    std::vector<Vec2> velocity = agitation(packing.size(), o.speed, 2);
    if (!o.lammps.empty()) {
        for (std::size_t i = 0; i < packing.size(); ++i)  // we start with the flow of the cell by ourselves
            velocity[i].x() += o.shear_rate * packing.center[i].y();
        write_lammps(o.lammps, packing, velocity);
        return 0;
    }
    const double before = peak_memory();
    rigid_dem::RigidDem dem(scenario_of(o), packing);
    WallMotion motion{packing.box, {}, o.shear_rate * packing.box.height()};
    const auto advance = [&] {
        for (int k = 0; k < o.steps; ++k) {
            dem.advance(motion, dt);
            motion.box = motion.after(dt);
        }
    };
    if (o.memory) {
        advance();
        fmt::print("memory,{},{:.0f}\n", packing.size(),
                   (peak_memory() - before) / static_cast<double>(packing.size()));
        return 0;
    }
    // Leap-frog begins half a step back.
    const std::vector<double> at_rest(packing.size(), 0.0);
    dem.set_velocity(velocity, at_rest);
    const GrainView start = dem.view(Need::contacts);
    std::vector<Vec2> force(packing.size(), Vec2::Zero());
    for (const GrainContact& c : start.contacts) {
        force[static_cast<std::size_t>(c.i)] += c.force;
        force[static_cast<std::size_t>(c.j)] -= c.force;
    }
    for (std::size_t i = 0; i < packing.size(); ++i) velocity[i] -= force[i] * (0.5 * dt / start.mass[i]);
    dem.set_velocity(velocity, at_rest);

    for (int round = 0; round < o.rounds; ++round) {
        const auto began = std::chrono::steady_clock::now();
        const std::clock_t cpu = std::clock();
        advance();
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        const double cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
        const GrainView view = dem.view(Need::contacts);
        const Mat2 stress = dem.cell_stress();
        const double n = static_cast<double>(packing.size()), work = n * o.steps;
        fmt::print("softgrain,{},{},{:.4f},{:.4f},{:.4g},{:.10g},{:.10g},{:.10g},{:.10g},{:.8f},{}\n",
                   packing.size(), o.steps, seconds, cpu_seconds, work / seconds, view.energy.kinetic / n,
                   view.energy.elastic / n, stress(0, 0), stress(1, 1), coordination(view).all,
                   dem.listings());
    }
    return 0;
}

}  // namespace
}  // namespace softgrain::peers

int main(int argc, char** argv) {
    softgrain::peers::Options o;
    CLI::App app("Rigid DEM on the sample of the peers");
    app.add_option("--grains", o.grains, "of one tile");
    app.add_option("--tiles", o.tiles, "on a side");
    app.add_option("--steps", o.steps, "of 1e-4 s, a round");
    app.add_option("--rounds", o.rounds, "a line for each");
    app.add_option("--friction", o.friction);
    app.add_option("--restitution", o.restitution);
    app.add_option("--speed", o.speed, "root mean square at the start [m/s]");
    app.add_option("--shear-rate", o.shear_rate, "[1/s]");
    app.add_option("--lammps", o.lammps, "write the sample as LAMMPS data here, and do not run");
    app.add_flag("--memory", o.memory, "say what rigid DEM holds at most, in bytes a disc, and no more");
    CLI11_PARSE(app, argc, argv);
    return softgrain::peers::run(o);
}
