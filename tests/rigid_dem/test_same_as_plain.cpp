// The fast solver against the plain one: blocks, copies, lists and vectors must not change what is computed.
#include <gtest/gtest.h>
#include <omp.h>

#include "common/packing/random.hpp"
#include "rigid_dem/method.hpp"
#include "rigid_dem/solver.hpp"
#include "tests/rigid_dem/plain_dem.hpp"

namespace softgrain::rigid_dem {
namespace {

struct Law {
    const char* name = nullptr;
    bool hertz = false;
    double friction = 0.0, rolling = 0.0, cohesion = 0.0, restitution = 1.0, nonviscous = 0.0;
    bool two_classes = false, start_only = false;
};

std::ostream& operator<<(std::ostream& out, const Law& law) {
    return out << law.name;
}

Scenario scenario_of(const Law& law) {
    Scenario s;
    s.material.friction = law.friction;
    s.material.wall_friction = 0.5 * law.friction;
    s.material.cohesion = law.cohesion;
    Settings table(keys());
    table.set("normal_law", std::string(law.hertz ? "hertz" : "linear"));
    table.set("restitution", law.restitution);
    table.set("rolling_friction", law.rolling);
    table.set("bonds", std::string(law.start_only ? "start" : "always"));
    table.set("nonviscous_damping", law.nonviscous);
    table.set("overlap_limit", 10.0);
    table.set("skin", 0.03);  // many lists
    s.method_settings["rigid_dem"] = table;
    if (law.two_classes) {
        GrainClass soft{.name = "soft", .share = 1.0, .material = s.material};
        GrainClass hard = soft;
        hard.material.youngs_modulus = 3.0;
        hard.material.density = 2.0;
        hard.material.poisson_ratio = 0.1;
        s.classes = {soft, hard};
    }
    return s;
}

/// A crowd of discs on a disturbed grid, some of them pressed together, in a cell with or without walls.
Packing crowd(int side, bool periodic, bool two_classes) {
    Random random(3);
    Packing p;
    const double step = 2.05;
    p.box = Box{{0.0, side * step, 0.0, side * step}, periodic, periodic ? 3.0 : 0.0};
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const double r = random.between(0.85, 1.05);
            const Vec2 jitter{random.between(-0.05, 0.05), random.between(-0.05, 0.05)};
            const Vec2 place{(x + 0.5) * step + (periodic ? 3.0 * (y + 0.5) / side : 0.0), (y + 0.5) * step};
            p.center.push_back(place + jitter);
            p.radius.push_back(r);
            if (two_classes) p.grain_class.push_back(static_cast<std::uint8_t>(p.center.size() % 2));
        }
    return p;
}

/// The same crowd of clumps a little longer than wide, of three and of two discs.
void make_clumps(Packing& packing) {
    Random random(7);
    for (std::size_t g = 0; g < packing.size(); ++g) packing.angle.push_back(random.between(0.0, 6.2));
    packing.clumps = {
        clump_shape(std::vector<Disc>{{{0.0, 0.0}, 1.0}, {{0.25, 0.1}, 0.85}, {{-0.1, -0.3}, 0.8}}),
        clump_shape(discs_in_line(2, 1.15))};
}

class SameAsPlain : public ::testing::TestWithParam<Law> {};

void expect_same(const Law& law, bool clumps) {
    const Scenario scenario = scenario_of(law);
    for (const bool periodic : {true, false}) {
        // In a cell grains at rest move against its flow by rounding; Cundall's damping asks for the sign.
        if (periodic && law.nonviscous > 0.0) continue;
        Packing packing = crowd(clumps ? 7 : 12, periodic, law.two_classes);
        if (clumps) make_clumps(packing);
        RigidDem fast(scenario, packing);
        testing::PlainDem plain(scenario, packing);
        WallMotion motion{packing.box, {0.01, -0.01, 0.005, -0.005}, periodic ? 0.1 : 0.0};
        const double dt = 0.2;
        int steps = 0;
        for (; steps < 300; ++steps) {
            if (steps == 200) motion.velocity = {-0.01, 0.01, 0.0, 0.0};
            fast.advance(motion, dt);
            plain.advance(motion, dt);
            motion.box = motion.after(dt);
        }
        EXPECT_GE(fast.listings(), 3) << "the list must have changed";
        const GrainView view = fast.view(Need::base);
        const std::span<const double> spin = fast.spin();
        double moving = 0.0, turning = 0.0, error = 0.0;
        for (std::size_t g = 0; g < packing.size(); ++g) {
            Vec2 apart = view.centroid[g] - plain.x[g], faster = view.velocity[g] - plain.v[g];
            if (periodic) {
                const Image image = motion.box.nearest_image(apart);
                apart += motion.box.image(image);
                faster += motion.image_velocity(image);
            }
            error = std::max({error, apart.norm(), faster.norm(), std::abs(spin[g] - plain.spin[g])});
            moving = std::max(moving, view.velocity[g].norm());
            turning = std::max(turning, std::abs(spin[g]));
        }
        // Sums in another order: rounding, which collisions amplify, but by less than 1e5 in this time.
        EXPECT_LT(error, 1e-11) << (periodic ? "in a cell" : "between walls");
        EXPECT_GT(moving, 0.01);
        EXPECT_EQ(turning > 0.0, clumps || law.friction > 0.0 || law.cohesion > 0.0 || law.rolling > 0.0);
    }
}

TEST_P(SameAsPlain, InAShearedCellAndBetweenMovingWalls) {
    expect_same(GetParam(), false);
}

TEST_P(SameAsPlain, AsClumps) {
    expect_same(GetParam(), true);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, SameAsPlain,
    ::testing::Values(
        Law{.name = "linear"}, Law{.name = "damped", .restitution = 0.5},
        Law{.name = "friction", .friction = 0.4},
        Law{.name = "damped_friction", .friction = 0.4, .restitution = 0.5},
        Law{.name = "rolling", .friction = 0.4, .rolling = 0.2},
        Law{.name = "damped_rolling", .friction = 0.4, .rolling = 0.2, .restitution = 0.5},
        Law{.name = "cohesion", .friction = 0.2, .cohesion = 0.01},
        Law{.name = "damped_cohesion", .friction = 0.2, .cohesion = 0.01, .restitution = 0.5},
        Law{.name = "cohesion_rolling", .friction = 0.2, .rolling = 0.2, .cohesion = 0.01},
        Law{.name = "damped_cohesion_rolling",
            .friction = 0.2,
            .rolling = 0.2,
            .cohesion = 0.01,
            .restitution = 0.5},
        Law{.name = "bonds_of_the_start", .cohesion = 0.02, .start_only = true},
        Law{.name = "hertz", .hertz = true}, Law{.name = "damped_hertz", .hertz = true, .restitution = 0.5},
        Law{.name = "mindlin", .hertz = true, .friction = 0.4},
        Law{.name = "damped_mindlin", .hertz = true, .friction = 0.4, .restitution = 0.5},
        Law{.name = "mindlin_rolling", .hertz = true, .friction = 0.4, .rolling = 0.2},
        Law{.name = "damped_mindlin_rolling",
            .hertz = true,
            .friction = 0.4,
            .rolling = 0.2,
            .restitution = 0.5},
        Law{.name = "nonviscous", .friction = 0.3, .nonviscous = 0.3},
        Law{.name = "two_classes", .friction = 0.4, .restitution = 0.5, .two_classes = true},
        Law{.name = "two_classes_mindlin", .hertz = true, .friction = 0.4, .two_classes = true}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(RigidDemBlocks, ManyBlocksGiveWhatThePlainSolverGives) {
    const Scenario scenario =
        scenario_of({.name = "all", .friction = 0.4, .rolling = 0.1, .restitution = 0.7});
    const Packing packing = crowd(47, true, false);
    ASSERT_GT(packing.size(), 2 * grains_per_block);
    RigidDem fast(scenario, packing);
    testing::PlainDem plain(scenario, packing);
    WallMotion motion{packing.box, {0.1, -0.1, 0.1, -0.1}, 0.5};
    for (int k = 0; k < 40; ++k) {
        fast.advance(motion, 0.2);
        plain.advance(motion, 0.2);
        motion.box = motion.after(0.2);
    }
    EXPECT_GE(fast.listings(), 1);
    const GrainView view = fast.view(Need::base);
    double error = 0.0;
    for (std::size_t g = 0; g < packing.size(); ++g)
        error = std::max(error, motion.box.nearest(view.centroid[g] - plain.x[g]).norm());
    EXPECT_LT(error, 1e-11);
}

/// Many blocks: a state after shear that is the same whatever the number of threads.
TEST(RigidDemBlocks, ManyBlocksGiveTheSameBitsOnAnyNumberOfThreads) {
    const Law law{.name = "all", .friction = 0.4, .restitution = 0.7};
    const Packing packing = crowd(72, true, false);
    ASSERT_GT(packing.size(), 5 * grains_per_block);
    const auto end = [&](int threads) {
        const int before = omp_get_max_threads();
        omp_set_num_threads(threads);
        const ThreadsInAnyCase always;
        RigidDem dem(scenario_of(law), packing);
        WallMotion motion{packing.box, {0.05, -0.05, 0.05, -0.05}, 2.0};
        for (int k = 0; k < 60; ++k) {
            dem.advance(motion, 0.1);
            motion.box = motion.after(0.1);
        }
        Checkpoint state;
        dem.save(state);
        omp_set_num_threads(before);
        EXPECT_GE(dem.listings(), 1);
        return state.numbers;
    };
    const auto one = end(1);
    EXPECT_EQ(one, end(2));
    EXPECT_EQ(one, end(3));
}

}  // namespace
}  // namespace softgrain::rigid_dem
