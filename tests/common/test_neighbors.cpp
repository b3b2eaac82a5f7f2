#include <gtest/gtest.h>

#include <random>

#include "common/gather.hpp"
#include "common/neighbors.hpp"

namespace softgrain {
namespace {

struct Cloud {
    std::vector<Vec2> x;
    std::vector<double> reach;
};

Cloud random_cloud(unsigned seed, int count, double ratio) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Cloud cloud;
    for (int k = 0; k < count; ++k) {
        cloud.x.emplace_back(unit(random), 2.0 * unit(random));
        cloud.reach.push_back(0.02 * (1.0 + (ratio - 1.0) * unit(random)));
    }
    return cloud;
}

std::vector<Pair> all_pairs(const Cloud& c, double skin) {
    std::vector<Pair> pairs;
    for (std::size_t i = 0; i < c.x.size(); ++i)
        for (std::size_t j = i + 1; j < c.x.size(); ++j)
            if ((c.x[i] - c.x[j]).norm() < c.reach[i] + c.reach[j] + skin)
                pairs.push_back({static_cast<int>(i), static_cast<int>(j)});
    return pairs;
}

TEST(Neighbors, EqualsAllPairsCheckedOneByOne) {
    for (unsigned seed = 0; seed < 6; ++seed) {
        const Cloud cloud = random_cloud(seed, 300, seed % 2 == 0 ? 1.0 : 8.0);
        NeighborList list;
        list.build(cloud.x, cloud.reach, 0.01);
        const auto expected = all_pairs(cloud, 0.01);
        EXPECT_TRUE(std::ranges::equal(list.pairs(), expected)) << "seed " << seed;
    }
}

TEST(Neighbors, StaleBeforeAnUnlistedPairCanTouch) {
    Cloud cloud{{{0.0, 0.0}, {1.0, 0.0}}, {0.4, 0.4}};
    NeighborList list;
    list.build(cloud.x, cloud.reach, 0.1);
    EXPECT_TRUE(list.pairs().empty());
    cloud.x[0].x() += 0.04;
    EXPECT_FALSE(list.stale(cloud.x, cloud.reach));
    cloud.reach[0] += 0.02;
    EXPECT_TRUE(list.stale(cloud.x, cloud.reach));
}

TEST(Neighbors, EmptyAndSingle) {
    NeighborList list;
    list.build({}, {}, 0.1);
    EXPECT_TRUE(list.pairs().empty());
    const std::vector<Vec2> x{{1.0, 1.0}};
    const std::vector<double> reach{0.5};
    list.build(x, reach, 0.1);
    EXPECT_TRUE(list.pairs().empty());
    EXPECT_FALSE(list.stale(x, reach));
}

TEST(PairsOfGrain, ListsEveryPairTwiceInOrder) {
    const std::vector<Pair> pairs{{0, 1}, {0, 2}, {1, 2}};
    PairsOfGrain of;
    of.build(pairs, 4);
    ASSERT_EQ(of.of(0).size(), 2U);
    ASSERT_EQ(of.of(2).size(), 2U);
    EXPECT_EQ(of.of(3).size(), 0U);
    EXPECT_EQ(of.of(2)[0].pair, 1);
    EXPECT_TRUE(of.of(2)[0].second);
    EXPECT_FALSE(of.of(1)[1].second);
}

}  // namespace
}  // namespace softgrain
