#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>

#include "common/errors.hpp"
#include "common/observables/shape.hpp"
#include "hand_made_grains.hpp"
#include "poly_data.hpp"
#include "viz/writers/vtp_file.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

vtkSmartPointer<vtkPolyData> read_back(const fs::path& path) {
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(path.c_str());
    reader->Update();
    return reader->GetOutput();
}

std::string read_text(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

double value(vtkPolyData& data, const char* name, std::size_t cell, int component = 0) {
    return softgrain::value(*data.GetCellData(), name, cell, component);
}

std::string unit(vtkPolyData& data, const char* name) {
    const char* text = data.GetCellData()->GetArray(name)->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return text == nullptr ? "" : text;
}

class WritersTest : public testing::Test {
  protected:
    TemporaryFolder folder;
    fs::path run = folder.path() / "run";
    HandMadeGrains grains{4, 0.1, 2.5};
};

TEST_F(WritersTest, GrainsComeBackAsTheyWere) {
    GrainWriter writer(run, Need::all);
    writer.observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "grains/grains_000000.vtp");
    const GrainView view = grains.view();
    ASSERT_EQ(data->GetNumberOfPolys(), 16);
    ASSERT_EQ(data->GetNumberOfPoints(), static_cast<vtkIdType>(view.outline_point.size()));
    EXPECT_EQ(data->GetFieldData()->GetArray("TimeValue")->GetTuple1(0), 2.5);
    for (std::size_t g = 0; g < view.size(); ++g) {
        const Mat2& s = view.stress[g];
        EXPECT_EQ(value(*data, "grain", g), static_cast<double>(g));
        EXPECT_EQ(value(*data, "mass", g), view.mass[g]);
        EXPECT_EQ(value(*data, "area", g), view.area[g]);
        EXPECT_EQ(value(*data, "reference_area", g), view.reference_area[g]);
        EXPECT_EQ(value(*data, "velocity", g, 0), view.velocity[g].x());
        EXPECT_EQ(value(*data, "velocity", g, 1), view.velocity[g].y());
        EXPECT_EQ(value(*data, "mean_stress", g), (s(0, 0) + s(1, 1)) / 2.0);
        EXPECT_EQ(value(*data, "stress", g, 0), s(0, 0));
        EXPECT_EQ(value(*data, "stress", g, 1), s(0, 1));
        EXPECT_EQ(value(*data, "stress", g, 3), s(0, 1));
        EXPECT_EQ(value(*data, "stress", g, 4), s(1, 1));
        EXPECT_EQ(value(*data, "stress", g, 8), 0.0);
        EXPECT_EQ(value(*data, "temperature", g), static_cast<double>(g));
        const Shape shape = grain_shapes(view)[g];
        EXPECT_EQ(value(*data, "aspect_ratio", g), shape.aspect_ratio);
        EXPECT_EQ(value(*data, "orientation", g), shape.orientation);
        EXPECT_EQ(value(*data, "asphericity", g), shape.asphericity);
        EXPECT_EQ(value(*data, "circularity", g), shape.circularity);
        for (const int component : {0, 1}) {
            EXPECT_EQ(value(*data, "stretch", g, component), grains.stretch[4 * g + component]);
            EXPECT_EQ(value(*data, "stretch", g, 3 + component), grains.stretch[4 * g + 2 + component]);
        }
        const auto first = static_cast<std::size_t>(view.outline_offset[g]);
        vtkCell* cell = data->GetCell(static_cast<vtkIdType>(g));
        ASSERT_EQ(cell->GetNumberOfPoints(), view.outline_offset[g + 1] - view.outline_offset[g]);
        for (vtkIdType k = 0; k < cell->GetNumberOfPoints(); ++k)
            EXPECT_EQ(point(*data, cell->GetPointId(static_cast<int>(k))),
                      view.outline_point[first + static_cast<std::size_t>(k)]);
    }
    EXPECT_STREQ(data->GetCellData()->GetTensors()->GetName(), "stress");
    EXPECT_STREQ(data->GetCellData()->GetScalars()->GetName(), "mean_stress");
    EXPECT_EQ(unit(*data, "mean_stress"), "N/m");
    EXPECT_EQ(unit(*data, "temperature"), "K");
}

// Principal stresses 3 and 1 turned by 30 degrees: half their difference is 1 whatever the angle.
TEST_F(WritersTest, DeviatoricStressIsHalfThePrincipalDifference) {
    const double c = std::cos(0.5236), s = std::sin(0.5236);
    const Mat2 turn = (Mat2() << c, -s, s, c).finished();
    grains.stress[3] = turn * Vec2(3.0, 1.0).asDiagonal() * turn.transpose();
    GrainWriter writer(run, Need::stress);
    writer.observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "grains/grains_000000.vtp");
    EXPECT_NEAR(value(*data, "deviatoric_stress", 3), 1.0, 1e-14);  // rounding
    EXPECT_NEAR(value(*data, "mean_stress", 3), 2.0, 1e-14);
}

TEST_F(WritersTest, WithoutOutlinesGrainsArePoints) {
    GrainWriter writer(run, Need::area);
    EXPECT_EQ(writer.need(frame_sample(0)), Need::area);
    EXPECT_EQ(writer.need(Sample{}), Need::base);
    writer.observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "grains/grains_000000.vtp");
    EXPECT_EQ(data->GetNumberOfPolys(), 0);
    ASSERT_EQ(data->GetNumberOfVerts(), 16);
    EXPECT_EQ(point(*data, 5), grains.centroid[5]);
    EXPECT_EQ(data->GetCellData()->GetArray("stress"), nullptr);
    EXPECT_EQ(data->GetCellData()->GetArray("aspect_ratio"), nullptr);
    EXPECT_EQ(value(*data, "area", 5), grains.area[5]);
    const double radius = softgrain::value(*data->GetPointData(), "radius", 5);
    EXPECT_NEAR(std::numbers::pi * radius * radius, grains.area[5], 1e-15);  // rounding
    const char* unit_of_radius =
        data->GetPointData()->GetArray("radius")->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    EXPECT_STREQ(unit_of_radius, "m");
}

TEST_F(WritersTest, VeryManyGrainsAreWrittenWithoutOutlines) {
    EXPECT_TRUE(wants(grain_data(most_outlined_grains, true), Need::outlines));
    EXPECT_FALSE(wants(grain_data(most_outlined_grains + 1, true), Need::outlines));
    EXPECT_FALSE(wants(grain_data(4, false), Need::outlines));
    EXPECT_TRUE(wants(grain_data(most_outlined_grains + 1, true), Need::stress));
}

TEST_F(WritersTest, PointsHaveTheirStressAsPointDataToo) {
    GrainWriter writer(run, Need::stress);
    writer.observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "grains/grains_000000.vtp");
    for (const int component : {0, 1, 3, 4})
        EXPECT_EQ(softgrain::value(*data->GetPointData(), "stress", 5, component),
                  value(*data, "stress", 5, component));
    EXPECT_EQ(softgrain::value(*data->GetPointData(), "mean_stress", 5), value(*data, "mean_stress", 5));
    ASSERT_NE(data->GetPointData()->GetTensors(), nullptr);
    EXPECT_STREQ(data->GetPointData()->GetTensors()->GetName(), "stress");
    // Without the area of now, that of the start.
    EXPECT_NEAR(softgrain::value(*data->GetPointData(), "radius", 5),
                std::sqrt(grains.reference_area[5] / std::numbers::pi), 1e-15);
}

TEST_F(WritersTest, ContactsComeBackAsTheyWere) {
    ContactWriter writer(run);
    writer.observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "contacts/contacts_000000.vtp");
    ASSERT_EQ(data->GetNumberOfLines(), 2 * 4 * 3 + 4 * 4);
    int walls = 0;
    for (std::size_t k = 0; k < grains.contacts.size(); ++k) {
        const GrainContact& c = grains.contacts[k];
        vtkCell* line = data->GetCell(static_cast<vtkIdType>(k));
        ASSERT_EQ(line->GetNumberOfPoints(), c.with_wall() ? 2 : 3);
        EXPECT_EQ(point(*data, line->GetPointId(0)), grains.centroid[static_cast<std::size_t>(c.i)]);
        const Vec2 end = point(*data, line->GetPointId(c.with_wall() ? 1 : 2));
        if (c.with_wall()) {
            ++walls;
            const int axis = wall_axis(c.wall());
            EXPECT_EQ(end[axis], grains.box.position[static_cast<std::size_t>(c.wall())]);
            EXPECT_EQ(end[1 - axis], c.point[1 - axis]);
        } else {
            EXPECT_EQ(point(*data, line->GetPointId(1)), c.point);
            EXPECT_EQ(end, grains.centroid[static_cast<std::size_t>(c.j)]);
        }
        EXPECT_EQ(value(*data, "is_wall", k), c.with_wall() ? 1.0 : 0.0);
        EXPECT_EQ(value(*data, "grain_i", k), c.i);
        EXPECT_EQ(value(*data, "grain_j", k), c.j);
        EXPECT_EQ(value(*data, "contact_length", k), c.length);
        EXPECT_GT(value(*data, "normal_force", k), 0.0);
        // The hand-made tangential force is 5 % of the normal one; 1e-12: rounding.
        EXPECT_NEAR(value(*data, "tangential_force", k) / value(*data, "normal_force", k), 0.05, 1e-12);
        EXPECT_NEAR(std::hypot(value(*data, "force", k, 0), value(*data, "force", k, 1)),
                    std::hypot(1.0, 0.05) * value(*data, "normal_force", k), 1e-15);
    }
    EXPECT_EQ(walls, 16);
    EXPECT_EQ(unit(*data, "normal_force"), "N");
}

TEST_F(WritersTest, WallsCarryForceAndStress) {
    WallWriter writer(run);
    writer.observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "walls/walls_000000.vtp");
    ASSERT_EQ(data->GetNumberOfLines(), 4);
    for (int wall = 0; wall < 4; ++wall) {
        const auto w = static_cast<std::size_t>(wall);
        double bounds[6];
        data->GetCellBounds(wall, bounds);
        const int axis = wall_axis(wall);
        EXPECT_EQ(bounds[2 * axis], grains.box.position[w]);
        EXPECT_EQ(bounds[2 * axis + 1], grains.box.position[w]);
        EXPECT_NEAR(bounds[3 - 2 * axis] - bounds[2 - 2 * axis], 0.9, 1e-15);
        EXPECT_EQ(value(*data, "wall_force", w, axis), grains.wall_force[w][axis]);
        const double pushed_outward = grains.wall_force[w].norm();
        EXPECT_DOUBLE_EQ(value(*data, "normal_force", w), pushed_outward);
        EXPECT_DOUBLE_EQ(value(*data, "wall_stress", w), pushed_outward / 0.9);
    }
}

/// Grains of a sheared cell whose tilt is more than its width, two of them moved by whole images.
class CellWritersTest : public WritersTest {
  protected:
    CellWritersTest() {
        grains.box.periodic = true;
        grains.box.tilt = 1.2 * grains.box.width();
        for (std::size_t g : {0U, 7U}) {
            const Vec2 away = grains.box.image(g == 0 ? 1 : -1, 1);
            grains.centroid[g] += away;
            for (int k = grains.outline_offset[g]; k < grains.outline_offset[g + 1]; ++k)
                grains.outline_point[static_cast<std::size_t>(k)] += away;
        }
        std::erase_if(grains.contacts, [](const GrainContact& c) { return c.with_wall(); });
        reduced = grains.box.reduced();
    }
    Box reduced;
};

TEST_F(CellWritersTest, GrainsAreDrawnInTheCell) {
    std::vector<std::uint8_t> classes(grains.centroid.size(), 0);
    classes[5] = 3;
    GrainWriter(run, Need::all, classes).observe(grains.view(), frame_sample(0));
    GrainWriter(run / "points", Need::area).observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "grains/grains_000000.vtp");
    const auto points = read_back(run / "points/grains/grains_000000.vtp");
    EXPECT_NEAR(reduced.tilt, 0.2 * grains.box.width(), 1e-15);
    for (std::size_t g = 0; g < grains.centroid.size(); ++g) {
        const Vec2 centre = point(*points, static_cast<vtkIdType>(g));
        const Vec2 inside = reduced.lattice().inverse() * (centre - reduced.origin());
        EXPECT_GE(inside.minCoeff(), 0.0);
        EXPECT_LT(inside.maxCoeff(), 1.0);
        // Moved by a whole image, and the outline with it.
        EXPECT_NEAR(reduced.nearest(centre - grains.centroid[g]).norm(), 0.0, 1e-14);
        const auto first = static_cast<std::size_t>(grains.outline_offset[g]);
        const Vec2 corner = point(*data, data->GetCell(static_cast<vtkIdType>(g))->GetPointId(0));
        EXPECT_NEAR((corner - centre - (grains.outline_point[first] - grains.centroid[g])).norm(), 0.0,
                    1e-14);
        EXPECT_EQ(value(*data, "grain_class", g), g == 5 ? 3.0 : 0.0);
    }
    EXPECT_EQ(points->GetCellData()->GetArray("grain_class"), nullptr);
}

TEST_F(CellWritersTest, ContactsAcrossTheEdgesAreDrawnAsHalves) {
    ContactWriter(run).observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "contacts/contacts_000000.vtp");
    vtkIdType cell = 0;
    int halves = 0;
    for (const GrainContact& c : grains.contacts) {
        const Vec2 from = reduced.wrapped(grains.centroid[static_cast<std::size_t>(c.i)]);
        const Vec2 to = reduced.wrapped(grains.centroid[static_cast<std::size_t>(c.j)]);
        const Vec2 to_point = c.point - grains.centroid[static_cast<std::size_t>(c.i)];
        const Vec2 to_j = reduced.nearest(grains.centroid[static_cast<std::size_t>(c.j)] -
                                          grains.centroid[static_cast<std::size_t>(c.i)]);
        const bool across = (from + to_j - to).norm() > 1e-9;
        vtkCell* line = data->GetCell(cell);
        ASSERT_EQ(line->GetNumberOfPoints(), across ? 2 : 3);
        EXPECT_NEAR((point(*data, line->GetPointId(0)) - from).norm(), 0.0, 1e-14);
        EXPECT_NEAR((point(*data, line->GetPointId(1)) - from - to_point).norm(), 0.0, 1e-14);
        EXPECT_EQ(value(*data, "grain_j", static_cast<std::size_t>(cell)), c.j);
        if (across) {
            ++halves;
            ++cell;
            vtkCell* other = data->GetCell(cell);
            ASSERT_EQ(other->GetNumberOfPoints(), 2);
            EXPECT_NEAR((point(*data, other->GetPointId(0)) - to).norm(), 0.0, 1e-14);
            EXPECT_NEAR((point(*data, other->GetPointId(1)) - to - (to_point - to_j)).norm(), 0.0, 1e-14);
            EXPECT_EQ(value(*data, "normal_force", static_cast<std::size_t>(cell)),
                      value(*data, "normal_force", static_cast<std::size_t>(cell) - 1));
        }
        ++cell;
    }
    EXPECT_EQ(cell, data->GetNumberOfLines());
    EXPECT_GT(halves, 0);
    EXPECT_LT(halves, static_cast<int>(grains.contacts.size()));
}

TEST_F(CellWritersTest, TheCellIsAParallelogram) {
    WallWriter(run).observe(grains.view(), frame_sample(0));
    const auto data = read_back(run / "walls/walls_000000.vtp");
    ASSERT_EQ(data->GetNumberOfPoints(), 4);
    const Vec2 o = reduced.origin();
    EXPECT_EQ(point(*data, 0), o);
    EXPECT_NEAR((point(*data, 1) - o - reduced.image(1, 0)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((point(*data, 2) - o - reduced.image(1, 1)).norm(), 0.0, 1e-15);
    EXPECT_NEAR((point(*data, 3) - o - reduced.image(0, 1)).norm(), 0.0, 1e-15);
    ASSERT_NE(data->GetFieldData()->GetArray("periodic"), nullptr);
    grains.box = Box{grains.box.position};
    WallWriter(run / "walls_only").observe(grains.view(), frame_sample(0));
    EXPECT_EQ(read_back(run / "walls_only/walls/walls_000000.vtp")->GetFieldData()->GetArray("periodic"),
              nullptr);
}

TEST_F(WritersTest, CollectionListsEveryFrame) {
    WallWriter writer(run);
    for (int k = 0; k < 3; ++k) {
        writer.observe(HandMadeGrains(2, 0.05 * k, 0.1 * k).view(), frame_sample(k));
        Sample between = frame_sample(k);
        between.is_frame = false;
        writer.observe(grains.view(), between);
    }
    EXPECT_EQ(read_text(run / "walls.pvd"),
              "<?xml version=\"1.0\"?>\n"
              "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
              "  <Collection>\n"
              "    <DataSet timestep=\"0\" group=\"\" part=\"0\" file=\"walls/walls_000000.vtp\"/>\n"
              "    <DataSet timestep=\"0.1\" group=\"\" part=\"0\" file=\"walls/walls_000001.vtp\"/>\n"
              "    <DataSet timestep=\"0.2\" group=\"\" part=\"0\" file=\"walls/walls_000002.vtp\"/>\n"
              "  </Collection>\n</VTKFile>\n");
}

TEST_F(WritersTest, ResumeKeepsTheFramesOfTheCheckpoint) {
    {
        ContactWriter writer(run);
        for (int k = 0; k < 4; ++k)
            writer.observe(HandMadeGrains(2, 0.05 * k, 1.0 * k).view(), frame_sample(k));
    }
    ContactWriter again(run);
    EXPECT_TRUE(again.resume(std::vector<double>{0.0, 1.0}).empty());
    EXPECT_FALSE(fs::exists(run / "contacts/contacts_000002.vtp"));
    EXPECT_EQ(read_text(run / "contacts.pvd").find("000002"), std::string::npos);
    again.observe(HandMadeGrains(2, 0.15, 7.0).view(), frame_sample(2));
    const std::string index = read_text(run / "contacts.pvd");
    EXPECT_NE(index.find("timestep=\"1\" group=\"\" part=\"0\" file=\"contacts/contacts_000001.vtp\""),
              std::string::npos);
    EXPECT_NE(index.find("timestep=\"7\" group=\"\" part=\"0\" file=\"contacts/contacts_000002.vtp\""),
              std::string::npos);
    EXPECT_EQ(index.find("000003"), std::string::npos);
}

TEST_F(WritersTest, ResumeSaysWhichFramesAreLostAndGoesOn) {
    {
        ContactWriter writer(run);
        for (int k = 0; k < 4; ++k)
            writer.observe(HandMadeGrains(2, 0.05 * k, 1.0 * k).view(), frame_sample(k));
    }
    fs::remove(run / "contacts/contacts_000001.vtp");
    fs::resize_file(run / "contacts/contacts_000002.vtp", 700);
    ContactWriter again(run);
    const std::vector<std::string> lost = again.resume(std::vector<double>{0.0, 1.0, 2.0});
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(
        lost[0].find((run / "contacts/contacts_000001.vtp").string() + ": missing (and 1 more of its kind)"),
        0U)
        << lost[0];
    again.observe(HandMadeGrains(2, 0.15, 7.0).view(), frame_sample(3));
    EXPECT_TRUE(fs::exists(run / "contacts/contacts_000003.vtp"));
    EXPECT_NE(read_text(run / "contacts.pvd").find("000001"), std::string::npos)
        << "frames keep their number";
}

TEST_F(WritersTest, AFreshRunRemovesOlderFrames) {
    for (int frames : {3, 1}) {
        WallWriter writer(run);
        for (int k = 0; k < frames; ++k) writer.observe(grains.view(), frame_sample(k));
    }
    EXPECT_TRUE(fs::exists(run / "walls/walls_000000.vtp"));
    EXPECT_FALSE(fs::exists(run / "walls/walls_000001.vtp"));
    EXPECT_EQ(read_text(run / "walls.pvd").find("000001"), std::string::npos);
}

TEST_F(WritersTest, ZeroHasNoSign) {
    // VTK would write -0 or 0 as the range, by which of its threads is first.
    vtkNew<vtkPoints> points;
    const vtkIdType origin = points->InsertNextPoint(0.0, 0.0, 0.0);
    vtkNew<vtkCellArray> vertices;
    vertices->InsertNextCell(1, &origin);
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(vertices);
    add_numbers(*data->GetCellData(), "zero", "", 1, 1)->SetValue(0, -0.0);
    const fs::path file = folder.path() / "zero.vtp";
    write_vtp(file, *data);
    EXPECT_EQ(read_text(file).find("\"-0\""), std::string::npos);
    EXPECT_FALSE(std::signbit(value(*read_back(file), "zero", 0)));
}

TEST_F(WritersTest, NotANumberDoesNotGetOut) {
    grains.stress[2](0, 1) = std::numeric_limits<double>::quiet_NaN();
    GrainWriter writer(run, Need::all);
    try {
        writer.observe(grains.view(), frame_sample(0));
        FAIL() << "no error";
    } catch (const DivergedError& error) {
        EXPECT_EQ(error.grain, 2);
        EXPECT_EQ(error.quantity, "stress");
        EXPECT_EQ(error.time, 2.5);
    }
    grains.contacts[1].force.x() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(ContactWriter(run).observe(grains.view(), frame_sample(0)), DivergedError);
    grains.wall_force[0].x() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(WallWriter(run).observe(grains.view(), frame_sample(0)), DivergedError);
}

}  // namespace
}  // namespace softgrain
