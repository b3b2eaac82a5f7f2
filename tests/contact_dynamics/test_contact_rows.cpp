#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <set>

#include "common/contact_dynamics/contact_rows.hpp"
#include "common/contact_dynamics/row_batches.hpp"
#include "common/contact_dynamics/sweep.hpp"
#include "disc_cloud.hpp"

namespace softgrain {
namespace {

NeighborList near(const DiscCloud& cloud, double skin) {
    NeighborList list;
    list.build(cloud.x, cloud.radius, skin);
    return list;
}

/// Every disc a block of its own.
ContactBlocks alone(const DiscCloud& cloud) {
    ContactBlocks blocks;
    for (std::size_t d = 0; d < cloud.size(); ++d) {
        blocks.of_disc.push_back(static_cast<int>(d));
        blocks.group_of_block.push_back(cloud.group[d]);
    }
    return blocks;
}

TEST(ContactBlocks, HoldNeighboursOfOneGroup) {
    DiscCloud cloud = disc_cloud(1, 40, 40, 2);
    const ContactBlocks blocks(cloud.discs(), 100);
    ASSERT_EQ(blocks.of_disc.size(), cloud.size());
    std::vector<int> count(static_cast<std::size_t>(blocks.size()), 0);
    std::vector<Eigen::AlignedBox2d> extent(count.size());
    for (std::size_t d = 0; d < cloud.size(); ++d) {
        const auto b = static_cast<std::size_t>(blocks.of_disc[d]);
        ++count[b];
        extent[b].extend(cloud.x[d]);
        EXPECT_EQ(blocks.group_of_block[b], cloud.group[d]);
    }
    EXPECT_EQ(blocks.size(), 16);  // 800 discs a group, halved to 100
    for (std::size_t b = 0; b < count.size(); ++b) {
        EXPECT_EQ(count[b], 100);
        EXPECT_LT(extent[b].sizes().maxCoeff(), 12.0);  // 10 x 8.7 discs, one more for the jitter
    }
}

TEST(ContactRows, HoldEveryPairOnceInItsBlockOrSeam) {
    DiscCloud cloud = disc_cloud(1, 12, 9, 4);
    const NeighborList list = near(cloud, 0.3);
    const ContactBlocks blocks(cloud.discs(), 1000);
    const ContactRows rows = make_contact_rows(list.pairs(), cloud.discs(), blocks, {});
    std::set<Pair> seen;
    const auto block_of = [&](int disc) { return blocks.of_disc[static_cast<std::size_t>(disc)]; };
    for (int b = 0; b < blocks.size(); ++b)
        for (int k = rows.block_start[static_cast<std::size_t>(b)];
             k < rows.block_start[static_cast<std::size_t>(b) + 1]; ++k) {
            const auto row = static_cast<std::size_t>(k);
            seen.insert({rows.i[row], rows.j[row]});
            EXPECT_EQ(block_of(rows.i[row]), b);
            EXPECT_EQ(block_of(rows.j[row]), b);
        }
    const std::size_t inside = seen.size();
    for (const Seam& seam : rows.seams)
        for (int k = seam.first; k < seam.last; ++k) {
            const auto row = static_cast<std::size_t>(k);
            seen.insert({rows.i[row], rows.j[row]});
            const std::pair<int, int> blocks_met =
                std::minmax({block_of(rows.i[row]), block_of(rows.j[row])});
            EXPECT_EQ(blocks_met, std::pair(seam.a, seam.b));
        }
    EXPECT_EQ(seen, std::set<Pair>(list.pairs().begin(), list.pairs().end()));
    EXPECT_EQ(seen.size(), rows.size());
    EXPECT_GT(inside, 0U);
    EXPECT_LT(inside, rows.size());
}

TEST(ContactRows, ABatchTouchesNoDiscTwice) {
    DiscCloud cloud = disc_cloud(2, 30, 30, 2);
    const ContactBlocks blocks(cloud.discs(), 250);
    const ContactRows rows = make_contact_rows(near(cloud, 0.3).pairs(), cloud.discs(), blocks, {});
    int singles = 0, batches = 0;
    for (std::size_t b = 0; b < rows.first_single.size(); ++b) {
        ASSERT_LE(rows.first_single[b], rows.block_start[b + 1]);
        ASSERT_EQ((rows.first_single[b] - rows.block_start[b]) % contact_sweep::batch_rows, 0);
        singles += rows.block_start[b + 1] - rows.first_single[b];
        for (int first = rows.block_start[b]; first < rows.first_single[b];
             first += contact_sweep::batch_rows, ++batches) {
            std::set<int> touched;
            for (int k = first; k < first + contact_sweep::batch_rows; ++k) {
                EXPECT_TRUE(touched.insert(rows.i[static_cast<std::size_t>(k)]).second);
                EXPECT_TRUE(touched.insert(rows.j[static_cast<std::size_t>(k)]).second);
            }
        }
    }
    EXPECT_GT(batches, 300);
    EXPECT_LT(singles, 12 * 4 * blocks.size());  // less than a batch for each colour
}

TEST(ContactRows, EveryVectorLengthGivesTheSameBits) {
    DiscCloud cloud = disc_cloud(5, 20, 20, 1);
    const ContactBlocks blocks(cloud.discs(), 1000);
    ContactRows rows = make_contact_rows(near(cloud, 0.3).pairs(), cloud.discs(), blocks, {});
    contact_sweep::set_geometry(rows, cloud.discs(), 0.1, 1.0, 0, static_cast<int>(rows.size()));
    // The plain loop over single rows is the reference.
    DiscCloud plain = cloud;
    ContactRows plain_rows = rows;
    for (int sweep = 0; sweep < 20; ++sweep)
        contact_sweep::relax(plain_rows, plain.discs(), {}, 1.7, 0, rows.first_single[0]);
    EXPECT_NE(plain.v, cloud.v);
    for (int length = 1; length <= contact_sweep::rows_in_a_vector(); length *= 2) {
        DiscCloud now = cloud;
        ContactRows now_rows = rows;
        const contact_sweep::FrictionlessRows batches{
            now_rows.i.data(),         now_rows.j.data(),     now_rows.direction.data()->data(),
            now_rows.gap_speed.data(), now_rows.share.data(), now_rows.normal.data(),
            now.v.data()->data()};
        for (int sweep = 0; sweep < 20; ++sweep)
            contact_sweep::relax_batches_by(length, batches, 1.7, 0, rows.first_single[0]);
        EXPECT_EQ(now.v, plain.v) << length << " rows in a vector";
        EXPECT_EQ(now_rows.normal, plain_rows.normal) << length << " rows in a vector";
    }
}

TEST(ContactRows, AColourTouchesNoBlockTwice) {
    DiscCloud cloud = disc_cloud(2, 20, 20, 20);
    const NeighborList list = near(cloud, 0.3);
    const ContactRows rows = make_contact_rows(list.pairs(), cloud.discs(), alone(cloud), {});
    ASSERT_GT(rows.colour_start.size(), 2U);
    ASSERT_EQ(rows.colour_start.back(), static_cast<int>(rows.seams.size()));
    for (std::size_t c = 0; c + 1 < rows.colour_start.size(); ++c) {
        std::set<int> touched;
        for (int s = rows.colour_start[c]; s < rows.colour_start[c + 1]; ++s) {
            EXPECT_TRUE(touched.insert(rows.seams[static_cast<std::size_t>(s)].a).second);
            EXPECT_TRUE(touched.insert(rows.seams[static_cast<std::size_t>(s)].b).second);
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
    const ContactRows rows = make_contact_rows(list.pairs(), cloud.discs(), alone(cloud), {});
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(rows.colour_start.size(), static_cast<std::size_t>(count) + 1);
}

TEST(WallRows, HoldTheDiscsNearAWall) {
    DiscCloud cloud = disc_cloud(3, 8, 8, 2);
    const Box box{{-0.6, 8.2, -0.6, 6.8}};
    const WallRows rows = make_wall_rows(cloud.discs(), box, 0.4, ContactBlocks(cloud.discs(), 1000));
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
    const ContactBlocks blocks(cloud.discs(), 40);
    const ContactRows old_rows = [&] {
        ContactRows rows = make_contact_rows(near(cloud, 0.15).pairs(), cloud.discs(), blocks, {});
        for (std::size_t k = 0; k < rows.size(); ++k) rows.normal[k] = 1000.0 * rows.i[k] + rows.j[k];
        return rows;
    }();
    ContactRows rows = make_contact_rows(near(cloud, 1.2).pairs(), cloud.discs(), blocks, {});
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
