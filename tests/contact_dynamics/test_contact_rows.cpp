#include <gtest/gtest.h>

#include <numbers>
#include <set>

#include "common/contact_dynamics/contact_rows.hpp"
#include "disc_cloud.hpp"

namespace softgrain {
namespace {

NeighborList near(const DiscCloud& cloud, double skin) {
    NeighborList list;
    list.build(cloud.x, cloud.radius, skin);
    return list;
}

TEST(ContactRows, HoldEveryPairOnceWithGroupsFirst) {
    DiscCloud cloud = disc_cloud(1, 12, 9, 4);
    const NeighborList list = near(cloud, 0.3);
    const ContactRows rows = make_contact_rows(list.pairs(), cloud.discs(), 4);
    std::set<Pair> seen;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        seen.insert({rows.i[k], rows.j[k]});
        const int gi = cloud.group[static_cast<std::size_t>(rows.i[k])];
        const int gj = cloud.group[static_cast<std::size_t>(rows.j[k])];
        EXPECT_EQ(gi == gj, k < rows.within_groups());
        if (gi != gj) continue;
        EXPECT_GE(static_cast<int>(k), rows.block_start[static_cast<std::size_t>(gi)]);
        EXPECT_LT(static_cast<int>(k), rows.block_start[static_cast<std::size_t>(gi) + 1]);
    }
    EXPECT_EQ(seen.size(), rows.size());
    EXPECT_EQ(seen, std::set<Pair>(list.pairs().begin(), list.pairs().end()));
    EXPECT_GT(rows.within_groups(), 0U);
    EXPECT_LT(rows.within_groups(), rows.size());
}

TEST(ContactRows, AColourTouchesNoDiscTwice) {
    DiscCloud cloud = disc_cloud(2, 20, 20, 20);
    for (std::size_t d = 0; d < cloud.size(); ++d) cloud.group[d] = static_cast<int>(d);
    const NeighborList list = near(cloud, 0.3);
    const ContactRows rows = make_contact_rows(list.pairs(), cloud.discs(), static_cast<int>(cloud.size()));
    ASSERT_GT(rows.colour_start.size(), 2U);
    ASSERT_EQ(rows.colour_start.back(), static_cast<int>(rows.size()));
    for (std::size_t c = 0; c + 1 < rows.colour_start.size(); ++c) {
        std::set<int> touched;
        for (int k = rows.colour_start[c]; k < rows.colour_start[c + 1]; ++k) {
            EXPECT_TRUE(touched.insert(rows.i[static_cast<std::size_t>(k)]).second);
            EXPECT_TRUE(touched.insert(rows.j[static_cast<std::size_t>(k)]).second);
        }
    }
    EXPECT_LT(rows.colour_start.size(), 14U);  // at most 2 x 6 - 1 colours on a triangular lattice
}

TEST(ContactRows, AHugeDiscStillColours) {
    // One disc with 300 small neighbours: more than the colours of the table.
    DiscCloud cloud;
    const int count = 300;
    for (int k = 0; k <= count; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / count;
        cloud.x.emplace_back(k == count ? Vec2::Zero()
                                        : Vec2(10.0 * std::cos(angle), 10.0 * std::sin(angle)));
        cloud.radius.push_back(k == count ? 9.95 : 0.05);
        cloud.mass.push_back(1.0);
        cloud.group.push_back(k);
    }
    const NeighborList list = near(cloud, 0.01);
    const ContactRows rows = make_contact_rows(list.pairs(), cloud.discs(), count + 1);
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.colour_start.size(), static_cast<std::size_t>(count) + 1);
}

TEST(WallRows, HoldTheDiscsNearAWall) {
    DiscCloud cloud = disc_cloud(3, 8, 8, 2);
    const Box box{{-0.6, 8.2, -0.6, 6.8}};
    const WallRows rows = make_wall_rows(cloud.discs(), box, 0.4, 2);
    std::set<std::pair<int, int>> expected, seen;
    for (std::size_t d = 0; d < cloud.size(); ++d)
        for (int wall = 0; wall < 4; ++wall)
            if (box.distance(wall, cloud.x[d]) < cloud.radius[d] + 0.4)
                expected.insert({static_cast<int>(d), wall});
    for (std::size_t k = 0; k < rows.size(); ++k) seen.insert({rows.disc[k], rows.wall[k]});
    EXPECT_EQ(seen, expected);
    EXPECT_GT(seen.size(), 20U);
    EXPECT_EQ(rows.block_start.back(), static_cast<int>(rows.size()));
}

TEST(ContactRows, CarriesImpulsesOfPairsThatStay) {
    DiscCloud cloud = disc_cloud(4, 10, 10, 3);
    const ContactRows old_rows = [&] {
        ContactRows rows = make_contact_rows(near(cloud, 0.15).pairs(), cloud.discs(), 3);
        for (std::size_t k = 0; k < rows.size(); ++k) rows.normal[k] = 1000.0 * rows.i[k] + rows.j[k];
        return rows;
    }();
    ContactRows rows = make_contact_rows(near(cloud, 1.2).pairs(), cloud.discs(), 3);
    carry_impulses(old_rows, rows);
    std::size_t carried = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        if (rows.normal[k] == 0.0) continue;
        EXPECT_EQ(rows.normal[k], 1000.0 * rows.i[k] + rows.j[k]);
        ++carried;
    }
    EXPECT_EQ(carried, old_rows.size());
    EXPECT_LT(carried, rows.size());
}

}  // namespace
}  // namespace softgrain
