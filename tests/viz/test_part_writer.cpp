#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "hand_made_grains.hpp"
#include "poly_data.hpp"
#include "viz/render/run_reader.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

class PartWriterTest : public testing::Test {
  protected:
    TemporaryFolder folder;
    fs::path run = folder.path() / "run";
    HandMadeGrains grains{3, 0.1, 2.5};
    HandMadeParts parts{grains};

    GrainView view() const {
        GrainView all = grains.view();
        all.parts = parts.view();
        return all;
    }
    vtkSmartPointer<vtkPolyData> read(const std::string& name) const { return read_vtp(run / name); }
};

TEST_F(PartWriterTest, PartsComeBackAsTheyWere) {
    PartWriter writer(run, true);
    EXPECT_EQ(writer.need(frame_sample(0)), Need::parts);
    EXPECT_EQ(writer.need(Sample{}), Need::base);
    writer.observe(view(), frame_sample(0));
    const auto data = read("parts/parts_000000.vtp");
    ASSERT_EQ(data->GetNumberOfVerts(), static_cast<vtkIdType>(parts.position.size()));
    EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 2.5);
    vtkPointData& of = *data->GetPointData();
    for (std::size_t p = 0; p < parts.position.size(); ++p) {
        EXPECT_EQ(point(*data, static_cast<vtkIdType>(p)), parts.position[p]);
        EXPECT_EQ(value(of, "grain", p), parts.grain[p]);
        EXPECT_EQ(value(of, "radius", p), parts.radius[p]);
        const Vec2 moved = parts.position[p] - parts.reference[p];
        for (const int axis : {0, 1}) {
            EXPECT_EQ(value(of, "displacement", p, axis), moved[axis]);
            EXPECT_EQ(value(of, "velocity", p, axis), parts.velocity[2 * p + static_cast<std::size_t>(axis)]);
        }
        EXPECT_EQ(value(of, "velocity", p, 2), 0.0);
        EXPECT_EQ(value(of, "heat", p), parts.heat[p]);
    }
}

TEST_F(PartWriterTest, ContactsRunBetweenPartsAndToWalls) {
    PartWriter(run, true).observe(view(), frame_sample(0));
    const auto data = read("part_contacts/part_contacts_000000.vtp");
    ASSERT_EQ(data->GetNumberOfLines(), static_cast<vtkIdType>(parts.contacts.size()));
    vtkCellData& of = *data->GetCellData();
    int walls = 0;
    for (std::size_t k = 0; k < parts.contacts.size(); ++k) {
        const PartContact& c = parts.contacts[k];
        const auto i = static_cast<std::size_t>(c.i);
        vtkCell* line = data->GetCell(static_cast<vtkIdType>(k));
        ASSERT_EQ(line->GetNumberOfPoints(), 2);
        EXPECT_EQ(point(*data, line->GetPointId(0)), parts.position[i]);
        const Vec2 end = point(*data, line->GetPointId(1));
        if (c.with_wall()) {
            ++walls;
            const int axis = wall_axis(c.wall());
            EXPECT_EQ(end[axis], grains.box.position[static_cast<std::size_t>(c.wall())]);
            EXPECT_EQ(end[1 - axis], parts.position[i][1 - axis]);
            EXPECT_EQ(value(of, "grain_j", k), c.j);
        } else {
            EXPECT_EQ(end, parts.position[static_cast<std::size_t>(c.j)]);
            EXPECT_EQ(value(of, "grain_j", k), parts.grain[static_cast<std::size_t>(c.j)]);
        }
        EXPECT_EQ(value(of, "is_wall", k), c.with_wall() ? 1.0 : 0.0);
        EXPECT_EQ(value(of, "part_i", k), c.i);
        EXPECT_EQ(value(of, "part_j", k), c.j);
        EXPECT_EQ(value(of, "grain_i", k), parts.grain[i]);
        EXPECT_EQ(value(of, "normal_force", k), c.normal_force);
        EXPECT_EQ(value(of, "tangential_force", k), c.tangential_force);
    }
    EXPECT_GT(walls, 0);
    EXPECT_LT(walls, static_cast<int>(parts.contacts.size()));
}

TEST_F(PartWriterTest, PartsFollowTheirGrainIntoTheCell) {
    grains.box.periodic = true;
    grains.box.tilt = 0.2 * grains.box.width();
    std::erase_if(parts.contacts, [](const PartContact& c) { return c.with_wall(); });
    // The second grain and its parts one image to the right: the contacts with its neighbours cross the cell.
    const Vec2 away = grains.box.image(1, 0);
    grains.centroid[1] += away;
    std::vector<Vec2> inside = parts.position;
    for (std::size_t p = 0; p < inside.size(); ++p)
        if (parts.grain[p] == 1) parts.position[p] += away;
    // One contact across the edge: the first part and one of the grain at the other end of the row.
    const int first = 0, last = 2 * HandMadeParts::per_grain;
    ASSERT_EQ(parts.grain[static_cast<std::size_t>(last)], 2);
    parts.contacts = {{first, 1, 3.0, 0.0}, {first, last, 5.0, 0.5}};
    PartWriter(run, true).observe(view(), frame_sample(0));
    const auto data = read("parts/parts_000000.vtp");
    for (std::size_t p = 0; p < inside.size(); ++p)
        EXPECT_NEAR((point(*data, static_cast<vtkIdType>(p)) - inside[p]).norm(), 0.0, 1e-14) << p;
    const auto contacts = read("part_contacts/part_contacts_000000.vtp");
    ASSERT_EQ(contacts->GetNumberOfLines(), 3);
    const Vec2 from = inside[0], to = inside[static_cast<std::size_t>(last)];
    const Vec2 branch = to - grains.box.image(1, 0) - from;  // the nearest image lies to the left
    ASSERT_LT(branch.norm(), (to - from).norm());
    const auto end = [&](vtkIdType cell, int k) {
        return point(*contacts, contacts->GetCell(cell)->GetPointId(k));
    };
    EXPECT_EQ(end(1, 0), from);
    EXPECT_NEAR((end(1, 1) - from - 0.5 * branch).norm(), 0.0, 1e-14);
    EXPECT_EQ(end(2, 0), to);
    EXPECT_NEAR((end(2, 1) - to + 0.5 * branch).norm(), 0.0, 1e-14);
    EXPECT_EQ(value(*contacts->GetCellData(), "normal_force", 2), 5.0);
}

TEST_F(PartWriterTest, GrainsWithoutPartsGiveNoFiles) {
    PartWriter writer(run, true);
    writer.observe(grains.view(), frame_sample(0));
    EXPECT_FALSE(fs::exists(run / "parts.pvd"));
    EXPECT_TRUE(PartWriter(run, true).resume(std::vector<double>{0.0, 1.0}).empty());
}

TEST_F(PartWriterTest, ContactsOfPartsCanBeLeftOut) {
    PartWriter(run, false).observe(view(), frame_sample(0));
    EXPECT_TRUE(fs::exists(run / "parts.pvd"));
    EXPECT_FALSE(fs::exists(run / "part_contacts.pvd"));
}

TEST_F(PartWriterTest, ResumeGoesOnAfterTheFramesOfTheCheckpoint) {
    {
        PartWriter writer(run, true);
        for (int k = 0; k < 3; ++k) writer.observe(view(), frame_sample(k));
    }
    PartWriter again(run, true);
    again.resume(std::vector<double>{2.5});
    for (const char* name : {"parts/parts_000001.vtp", "part_contacts/part_contacts_000001.vtp"})
        EXPECT_FALSE(fs::exists(run / name)) << name;
    again.observe(view(), frame_sample(1));
    EXPECT_EQ(read_pvd(run / "parts.pvd").size(), 2U);
    EXPECT_EQ(read_pvd(run / "part_contacts.pvd").size(), 2U);
    fs::remove(run / "parts/parts_000000.vtp");
    EXPECT_EQ(PartWriter(run, true).resume(std::vector<double>{2.5}).size(), 1U);
}

TEST_F(PartWriterTest, NotANumberDoesNotGetOut) {
    const auto quantity_of_error = [&](const GrainView& bad) {
        try {
            PartWriter(run, true).observe(bad, frame_sample(0));
        } catch (const DivergedError& error) {
            return std::to_string(error.grain) + " " + error.quantity;
        }
        return std::string("no error");
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    parts.velocity[2 * 5 + 1] = nan;
    EXPECT_EQ(quantity_of_error(view()), "1 velocity of a part");  // four parts a grain
    parts.velocity[2 * 5 + 1] = 0.0;
    parts.contacts[0].normal_force = nan;
    EXPECT_EQ(quantity_of_error(view()), "0 contact force of a part");
    parts.position[0].y() = nan;
    EXPECT_EQ(quantity_of_error(view()), "0 position of a part");
}

}  // namespace
}  // namespace softgrain
