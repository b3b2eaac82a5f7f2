#include <gtest/gtest.h>
#include <omp.h>

#include "common/contact_dynamics/contact_dynamics.hpp"
#include "common/errors.hpp"
#include "disc_cloud.hpp"

namespace softgrain {
namespace {

constexpr double h = 0.1;
const WallMotion far_walls{{{-1e3, 1e3, -1e3, 1e3}}, {}};

ContactSettings exact() {
    return {.tolerance = 1e-14, .skin = 1.0, .max_iterations = 2000000, .over_relaxation = 1.6};
}

TEST(ContactDynamics, TwoDiscsMeetInelastically) {
    DiscCloud cloud{{{0, 0}, {1, 0}}, {{1, 0.5}, {-2, 0}}, {0.5, 0.5}, {1, 3}, {0, 0}, {0, 1}};
    ContactDynamics contacts(exact());
    contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_NEAR(cloud.v[0].x(), -1.25, 1e-12);  // common velocity (1 - 6) / 4
    EXPECT_NEAR(cloud.v[1].x(), -1.25, 1e-12);
    EXPECT_DOUBLE_EQ(cloud.v[0].y(), 0.5);
    EXPECT_NEAR(contacts.rows().normal[0] * contacts.reduced_mass(0, cloud.mass), 2.25, 1e-12);
}

TEST(ContactDynamics, GapIsClosedButNotMore) {
    DiscCloud cloud{{{0, 0}, {1.05, 0}}, {{1, 0}, {-1, 0}}, {0.5, 0.5}, {1, 1}, {0, 0}, {0, 1}};
    ContactDynamics contacts(exact());
    contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_NEAR(1.05 + h * (cloud.v[1].x() - cloud.v[0].x()), 1.0, 1e-12);
}

TEST(ContactDynamics, DiscsThatSeparateAreLeftAlone) {
    DiscCloud cloud{{{0, 0}, {1, 0}}, {{-1, 0}, {1, 0}}, {0.5, 0.5}, {1, 1}, {0, 0}, {0, 0}};
    ContactDynamics contacts(exact());
    contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_EQ(cloud.v[0], Vec2(-1, 0));
    EXPECT_EQ(cloud.v[1], Vec2(1, 0));
}

TEST(ContactDynamics, MovingWallPushesADisc) {
    DiscCloud cloud{{{0, 0}}, {{0, 0}}, {0.5}, {2}, {0}, {0}};
    const WallMotion walls{{{-0.5, 10, -10, 10}}, {0.3, 0, 0, 0}};
    ContactDynamics contacts(exact());
    contacts.solve(cloud.discs(), walls, h);
    EXPECT_NEAR(cloud.v[0].x(), 0.3, 1e-13);
    EXPECT_EQ(cloud.v[0].y(), 0.0);
}

TEST(ContactDynamics, DeepOverlapIsRemovedBySteps) {
    DiscCloud cloud{{{0, 0}, {0.7, 0}}, {{0, 0}, {0, 0}}, {0.5, 0.5}, {1, 1}, {0, 0}, {0, 1}};
    ContactSettings settings = exact();
    settings.largest_push = 0.1;
    ContactDynamics contacts(settings);
    contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_NEAR(h * (cloud.v[1].x() - cloud.v[0].x()), 0.1, 1e-12);
}

TEST(ContactDynamics, KeepsMomentum) {
    DiscCloud cloud = disc_cloud(7, 12, 12, 4);
    const auto momentum = [&] {
        Vec2 sum = Vec2::Zero();
        double angular = 0.0;
        for (std::size_t d = 0; d < cloud.size(); ++d) {
            sum += cloud.mass[d] * cloud.v[d];
            angular +=
                cloud.mass[d] * (cross(cloud.x[d], cloud.v[d]) + 0.5 * cloud.radius[d] * cloud.rim_speed[d]);
        }
        return Eigen::Vector3d(sum.x(), sum.y(), angular);
    };
    const Eigen::Vector3d before = momentum();
    ContactSettings settings = exact();
    settings.tolerance = 1e-6;  // each single impulse conserves momentum, converged or not
    ContactDynamics contacts(settings);
    contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_LT((momentum() - before).norm(), 1e-11);
}

TEST(ContactDynamics, WarmStartNeedsFewSweeps) {
    DiscCloud cloud = disc_cloud(3, 10, 10, 2);
    const std::vector<Vec2> v = cloud.v;
    ContactSettings settings = exact();
    settings.tolerance = 1e-9;
    ContactDynamics contacts(settings);
    const ContactResult cold = contacts.solve(cloud.discs(), far_walls, h);
    cloud.v = v;
    const ContactResult warm = contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_GT(cold.iterations, 20);
    EXPECT_LE(warm.iterations, 2);
}

TEST(ContactDynamics, ImpulsesSurviveARebuild) {
    DiscCloud cloud = disc_cloud(3, 10, 10, 2);
    const std::vector<Vec2> v = cloud.v;
    ContactSettings settings = exact();
    settings.tolerance = 1e-9;
    settings.skin = 0.2;
    ContactDynamics contacts(settings);
    contacts.solve(cloud.discs(), far_walls, h);
    const Vec2 shift{7.0, 3.0};  // more than the skin: all lists are made again
    for (Vec2& x : cloud.x) x += shift;
    cloud.v = v;
    const ContactResult warm = contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_EQ(contacts.rebuilds(), 2);
    EXPECT_LE(warm.iterations, 3);
}

TEST(ContactDynamics, AnotherStepScalesTheImpulses) {
    // A disc pressed on the floor by a steady force: the warm start is right for every h.
    DiscCloud cloud{{{0, 0.5}}, {{0, -0.1}}, {0.5}, {1}, {0}, {0}};
    const WallMotion floor{{{-10, 10, 0, 10}}, {}};
    ContactDynamics contacts({.tolerance = 1e-12, .skin = 0.3});
    contacts.solve(cloud.discs(), floor, 0.1);
    cloud.v[0] = {0, -0.05};
    EXPECT_EQ(contacts.solve(cloud.discs(), floor, 0.05).iterations, 1);
}

TEST(ContactDynamics, SaysWhenItDidNotConverge) {
    DiscCloud cloud = disc_cloud(3, 10, 10, 2);
    ContactSettings settings = exact();
    settings.max_iterations = 2;
    ContactDynamics contacts(settings);
    const ContactResult result = contacts.solve(cloud.discs(), far_walls, h);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.iterations, 2);
    EXPECT_GT(result.residual, settings.tolerance);
}

TEST(ContactDynamics, SameBitsForOneAndTwoThreads) {
    // Large enough that groups and colours are both shared between threads; groups = columns, or all discs
    // alone.
    for (const bool alone : {false, true}) {
        std::vector<DiscCloud> results;
        for (int threads : {1, 2}) {
            omp_set_num_threads(threads);
            DiscCloud cloud = disc_cloud(11, 60, 60, 6);
            if (alone)
                for (std::size_t d = 0; d < cloud.size(); ++d) cloud.group[d] = static_cast<int>(d);
            ContactDynamics contacts(
                {.tolerance = 1e-5,
                 .skin = 0.3,
                 .between = {.friction = alone ? 0.4 : 0.0, .rolling = alone ? 0.2 : 0.0},
                 .block_discs = 100});
            for (int step = 0; step < 3; ++step) {
                contacts.solve(cloud.discs(), {{{-0.5, 60.5, -0.5, 52.2}}, {0.1, 0, 0, -0.1}}, 0.01, true);
                for (std::size_t d = 0; d < cloud.size(); ++d) cloud.x[d] += 0.01 * cloud.v[d];
            }
            ASSERT_GT(contacts.rows().size(), 10000U);
            results.push_back(cloud);
        }
        omp_set_num_threads(1);
        EXPECT_EQ(results[0].v, results[1].v);
        EXPECT_EQ(results[0].rim_speed, results[1].rim_speed);
    }
}

TEST(ContactDynamics, RestartGivesTheSameBits) {
    DiscCloud cloud = disc_cloud(5, 10, 10, 3);
    const ContactSettings settings{
        .tolerance = 1e-6, .skin = 0.3, .between = {.friction = 0.3, .rolling = 0.1}};
    ContactDynamics contacts(settings);
    const auto steps = [&](DiscCloud& c, ContactDynamics& s, int count) {
        for (int k = 0; k < count; ++k) {
            s.solve(c.discs(), far_walls, 0.02);
            for (std::size_t d = 0; d < c.size(); ++d) {
                c.x[d] += 0.02 * c.v[d];
                c.v[d] -= 0.02 * (c.x[d] - Vec2(5, 4));
            }
        }
    };
    steps(cloud, contacts, 7);
    Checkpoint checkpoint;
    contacts.save(checkpoint, "c.");
    DiscCloud again = cloud;
    ContactDynamics other(settings);
    other.load(checkpoint, "c.", again.discs());
    steps(cloud, contacts, 20);
    steps(again, other, 20);
    EXPECT_EQ(cloud.x, again.x);
    EXPECT_EQ(cloud.v, again.v);
    DiscCloud fewer = disc_cloud(5, 9, 10, 3);
    EXPECT_THROW(other.load(checkpoint, "c.", fewer.discs()), InputError);
}

TEST(ContactDynamics, RefusesImpossibleSettings) {
    EXPECT_THROW(ContactDynamics({.tolerance = 0.0, .skin = 1.0}), InputError);
    EXPECT_THROW(ContactDynamics({.tolerance = 1.0, .skin = 0.0}), InputError);
    EXPECT_THROW(ContactDynamics({.tolerance = 1.0, .skin = 1.0, .over_relaxation = 2.0}), InputError);
}

TEST(ContactDynamics, NoDiscsIsNoWork) {
    DiscCloud none;
    ContactDynamics contacts(exact());
    EXPECT_TRUE(contacts.solve(none.discs(), far_walls, h).converged);
}

}  // namespace
}  // namespace softgrain
