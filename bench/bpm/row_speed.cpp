// Time of a contact row and sweep without friction: one by one, and for each number of rows in a vector, over
// the rows of 30 grains of 250 discs. Usage: bpm_row_speed [sweeps]
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "bpm/aggregate.hpp"
#include "common/contact_dynamics/contact_rows.hpp"
#include "common/contact_dynamics/row_batches.hpp"
#include "common/contact_dynamics/sweep.hpp"
#include "common/neighbors.hpp"

namespace softgrain {
namespace {

constexpr int grains = 30, discs_per_grain = 250, repeats = 15;
constexpr double skin = 0.25;  // that of bpm [mean disc diameters]
constexpr double omega = 1.8;

struct Scene {
    std::vector<Vec2> x, v;
    std::vector<double> radius, mass, rim_speed;
    std::vector<int> group;
    ContactRows rows;
    int blocks = 0;

    Scene() {
        for (int g = 0; g < grains; ++g) {
            const bpm::Aggregate grain = bpm::prepare_aggregate({.discs = discs_per_grain, .grain = g});
            for (std::size_t d = 0; d < grain.x.size(); ++d) {
                x.push_back(grain.x[d] + Vec2{3.0 * g, 0.0});
                radius.push_back(grain.radius[d]);
                mass.push_back(grain.radius[d] * grain.radius[d]);
                group.push_back(g);
                v.push_back(-0.1 * grain.x[d]);
            }
        }
        rim_speed.assign(x.size(), 0.0);
        double diameter = 0.0;
        for (const double r : radius) diameter += 2.0 * r / static_cast<double>(radius.size());
        NeighborList near;
        near.build(x, radius, skin * diameter);
        const ContactBlocks in_blocks(discs(), 512);
        blocks = in_blocks.size();
        rows = make_contact_rows(near.pairs(), discs(), in_blocks, {});
        contact_sweep::set_geometry(rows, discs(), 0.1, 1.0, 0, static_cast<int>(rows.size()));
    }
    Discs discs() { return {x, radius, mass, group, v, rim_speed}; }
    int in_batches() const {
        int sum = 0;
        for (int b = 0; b < blocks; ++b)
            sum += rows.first_single[static_cast<std::size_t>(b)] -
                   rows.block_start[static_cast<std::size_t>(b)];
        return sum;
    }
    template <class Relax>
    void sweep(Relax relax) {
        for (int b = 0; b < blocks; ++b)
            relax(rows.block_start[static_cast<std::size_t>(b)],
                  rows.first_single[static_cast<std::size_t>(b)]);
    }
};

}  // namespace
}  // namespace softgrain

int main(int argc, char** argv) {
    using namespace softgrain;
    const int sweeps = argc > 1 ? std::atoi(argv[1]) : 200;
    Scene scene;
    struct Way {
        std::string name;
        std::function<void(int, int)> relax;
        std::vector<double> times = {};
    };
    std::vector<Way> ways;
    ways.push_back({"one by one", [&](int first, int last) {
                        contact_sweep::relax(scene.rows, scene.discs(), {}, omega, first, last);
                    }});
    for (int length = 1; length <= contact_sweep::rows_in_a_vector(); length *= 2)
        ways.push_back({fmt::format("{} in a vector", length), [&scene, length](int first, int last) {
                            const contact_sweep::FrictionlessRows batches{scene.rows.i.data(),
                                                                          scene.rows.j.data(),
                                                                          scene.rows.direction.data()->data(),
                                                                          scene.rows.gap_speed.data(),
                                                                          scene.rows.share.data(),
                                                                          scene.rows.normal.data(),
                                                                          scene.v.data()->data()};
                            contact_sweep::relax_batches_by(length, batches, omega, first, last);
                        }});
    for (int repeat = 0; repeat < repeats; ++repeat)
        for (Way& way : ways) {
            const auto start = std::chrono::steady_clock::now();
            for (int k = 0; k < sweeps; ++k) scene.sweep(way.relax);
            const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
            way.times.push_back(time.count() / sweeps / scene.in_batches());
        }
    fmt::print("{} rows in batches, {} in all\n", scene.in_batches(), scene.rows.size());
    for (Way& way : ways) {
        std::ranges::sort(way.times);
        fmt::print("{:14} {:.2f} ns a row and sweep\n", way.name, 1e9 * way.times[way.times.size() / 2]);
    }
}
