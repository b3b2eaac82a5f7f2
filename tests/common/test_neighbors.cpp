#include <gtest/gtest.h>

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/errors.hpp"
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

/// Sizes over a ratio of 100: many small grains, some large ones.
Cloud of_ratio_100(unsigned seed, int count, const Box& cell) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Cloud cloud;
    for (int k = 0; k < count; ++k) {
        const Vec2 inside{1.6 * unit(random) - 0.3, 1.6 * unit(random) - 0.3};  // some outside the cell
        cloud.x.push_back(cell.origin() + cell.lattice() * inside);
        cloud.reach.push_back(0.2 * std::pow(100.0, -std::sqrt(unit(random))));
    }
    return cloud;
}

TEST(Neighbors, SizeRatioOfAHundred) {
    const Box area{{0.0, 3.0, 0.0, 2.0}};
    for (unsigned seed = 0; seed < 4; ++seed) {
        const Cloud cloud = of_ratio_100(seed, 500, area);
        NeighborList list;
        list.build(cloud.x, cloud.reach, 0.003);
        EXPECT_TRUE(std::ranges::equal(list.pairs(), all_pairs(cloud, 0.003))) << "seed " << seed;
        EXPECT_TRUE(list.images().empty());
    }
}

struct PairWithImage {
    Pair pair;
    Image image;
    friend bool operator==(const PairWithImage&, const PairWithImage&) = default;
};

std::vector<PairWithImage> all_images(const Cloud& c, double skin, const Box& cell) {
    std::vector<PairWithImage> pairs;
    for (std::size_t i = 0; i < c.x.size(); ++i)
        for (std::size_t j = i + 1; j < c.x.size(); ++j)
            for (int ix = -2; ix <= 2; ++ix)
                for (int iy = -2; iy <= 2; ++iy) {
                    const double distance = (c.x[j] - c.x[i] + cell.image(ix, iy)).norm();
                    if (distance < c.reach[i] + c.reach[j] + skin)
                        pairs.push_back({{static_cast<int>(i), static_cast<int>(j)},
                                         {static_cast<std::int8_t>(ix), static_cast<std::int8_t>(iy)}});
                }
    return pairs;
}

TEST(Neighbors, PeriodicAndTiltedCells) {
    for (const double tilt : {0.0, 0.7, -1.5, 1.5}) {
        const Box cell{{-0.2, 2.8, 0.1, 2.4}, true, tilt};
        for (unsigned seed = 0; seed < 3; ++seed) {
            Cloud cloud = of_ratio_100(seed, 200, cell);
            if (seed == 2) std::fill(cloud.reach.begin(), cloud.reach.end(), 0.07);
            NeighborList list;
            list.build(cloud.x, cloud.reach, 0.004, cell);
            std::vector<PairWithImage> found;
            ASSERT_EQ(list.images().size(), list.pairs().size());
            for (std::size_t k = 0; k < list.pairs().size(); ++k)
                found.push_back({list.pairs()[k], list.images()[k]});
            EXPECT_EQ(found, all_images(cloud, 0.004, cell)) << "tilt " << tilt << ", seed " << seed;
        }
    }
}

/// A cell just large enough has two columns of cells, each the neighbour of the other on both sides.
TEST(Neighbors, TheSmallestCell) {
    const double reach = 0.25, skin = 0.01;
    const double least = 2.0 * (2.0 * reach + skin);
    Cloud cloud;
    for (int k = 0; k < 9; ++k) {
        cloud.x.emplace_back(0.37 * (k % 3), 0.34 * (k / 3));
        cloud.reach.push_back(reach);
    }
    NeighborList list;
    const Box enough{{0.0, 1.001 * least, 0.0, 1.2 * least}, true};
    list.build(cloud.x, cloud.reach, skin, enough);
    std::vector<PairWithImage> found;
    for (std::size_t k = 0; k < list.pairs().size(); ++k)
        found.push_back({list.pairs()[k], list.images()[k]});
    EXPECT_EQ(found, all_images(cloud, skin, enough));
    EXPECT_GT(found.size(), 9U);
    const Box narrow{{0.0, 0.999 * least, 0.0, 2.0 * least}, true};
    try {
        list.build(cloud.x, cloud.reach, skin, narrow);
        FAIL() << "a pair could meet twice";
    } catch (const InputError& error) {
        EXPECT_STREQ(
            error.what(),
            "the periodic cell is too small for its grains: 1.019 m across, at least 1.02 m are needed "
            "for a largest grain of 0.5 m; take more grains, or smaller ones");
    }
    // Tilt brings opposite faces nearer.
    const Box tilted{{0.0, 1.05 * least, 0.0, 1.2 * least}, true, 0.5 * least};
    EXPECT_THROW(list.build(cloud.x, cloud.reach, skin, tilted), InputError);
}

TEST(Neighbors, ThreadsDoNotChangeTheList) {
    const Box cell{{0.0, 30.0, 0.0, 30.0}, true, 4.0};
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Cloud cloud;
    for (int k = 0; k < 25000; ++k) {
        cloud.x.emplace_back(30.0 * unit(random), 30.0 * unit(random));
        cloud.reach.push_back(0.3 / (1.0 + 9.0 * unit(random)));
    }
    NeighborList list[2];
    for (const int threads : {1, 2}) {
        omp_set_num_threads(threads);
        list[threads - 1].build(cloud.x, cloud.reach, 0.01, cell);
    }
    ASSERT_GT(list[0].pairs().size(), 25000U);
    EXPECT_TRUE(std::ranges::equal(list[0].pairs(), list[1].pairs()));
    EXPECT_TRUE(std::ranges::equal(list[0].images(), list[1].images()));
}

/// Random motion, growth and deformation of the cell: as long as the list is not stale it holds every pair
/// that touches. Motion along with the cell alone uses up little of the skin.
TEST(Neighbors, StaleInADeformingCell) {
    const Box cell{{0.0, 3.0, 0.0, 2.4}, true, 0.5};
    int fresh = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        Cloud cloud = of_ratio_100(seed, 150, cell);
        NeighborList list;
        list.build(cloud.x, cloud.reach, 0.05, cell);
        Box moved = cell;
        const double size = 0.02 * (seed % 8) / 8.0;
        for (double& p : moved.position) p += 3.0 * size * unit(random);
        moved.tilt += 3.0 * size * unit(random);
        for (std::size_t k = 0; k < cloud.x.size(); ++k) {
            const Vec2 inside = cell.lattice().inverse() * (cloud.x[k] - cell.origin());
            cloud.x[k] = moved.origin() + moved.lattice() * inside + size * Vec2{unit(random), unit(random)};
            cloud.reach[k] *= 1.0 + size * unit(random);
        }
        if (list.stale(cloud.x, cloud.reach, moved)) continue;
        ++fresh;
        const auto pairs = list.pairs();
        for (const PairWithImage& touching : all_images(cloud, 0.0, moved)) {
            const auto at = std::lower_bound(pairs.begin(), pairs.end(), touching.pair);
            ASSERT_TRUE(at != pairs.end() && *at == touching.pair) << "seed " << seed;
            EXPECT_EQ(list.images()[static_cast<std::size_t>(at - pairs.begin())], touching.image);
        }
    }
    EXPECT_GT(fresh, 6);
    EXPECT_LT(fresh, 24);

    // 2 % compression of a cell 60 skins wide moves its edges by more than the skin.
    Cloud cloud = of_ratio_100(1, 300, cell);
    for (double& r : cloud.reach) r = std::min(r, 0.05);
    NeighborList list;
    list.build(cloud.x, cloud.reach, 0.05, cell);
    const Box smaller{{0.03, 2.97, 0.024, 2.376}, true, 0.49};
    for (Vec2& x : cloud.x)
        x = smaller.origin() + smaller.lattice() * (cell.lattice().inverse() * (x - cell.origin()));
    EXPECT_FALSE(list.stale(cloud.x, cloud.reach, smaller));
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
