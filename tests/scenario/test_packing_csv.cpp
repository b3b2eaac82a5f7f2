#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "common/errors.hpp"
#include "common/packing/packing_csv.hpp"

namespace softgrain {
namespace {

const Box box{{0.0, 4.0, 0.0, 3.0}};

class PackingCsv : public ::testing::Test {
  protected:
    void TearDown() override { std::filesystem::remove(path_); }

    Packing read(std::string_view text, const Box& in = box, std::size_t classes = 1) {
        std::ofstream(path_, std::ios::binary) << text;
        return read_packing_csv(path_, in, classes);
    }

    /// The message after the folder.
    std::string error_of(std::string_view text, const Box& in = box, std::size_t classes = 1) {
        try {
            read(text, in, classes);
        } catch (const InputError& error) {
            return std::string(error.what()).substr(path_.string().size());
        }
        return {};
    }

    std::filesystem::path path_ =
        std::filesystem::temp_directory_path() / ("softgrain_packing_" + std::to_string(::getpid()) + ".csv");
};

TEST_F(PackingCsv, ReadsCommentsBlanksAndEveryLineEnd) {
    const Packing p = read("# a note\r\n\r\n x , y,r\r\n1,1, 1\r\n#,\r\n+3e0,1.0,1\r\n 2,2.5,.5");
    ASSERT_EQ(p.size(), 3U);
    EXPECT_EQ(p.center[1], Vec2(3.0, 1.0));
    EXPECT_EQ(p.center[2], Vec2(2.0, 2.5));
    EXPECT_EQ(p.radius[2], 0.5);
    EXPECT_EQ(p.box.width(), 4.0);
}

TEST_F(PackingCsv, WrongFiles) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"", ":0: there is no disc: expected a header x,y,r and a line for each disc"},
        {"x,y,r\n", ":1: there is no disc: expected a header x,y,r and a line for each disc"},
        {"1,1,1\n", ":1: expected the header x,y,r"},
        {"# c\nr,x,y\n", ":2: expected the header x,y,r"},
        {"x,y,r\n1,1\n", ":2: expected 3 values x,y,r, got 2"},
        {"x,y,r\n1,1,1,\n", ":2: expected 3 values x,y,r, got 4"},
        {"x,y,r\n1,,1\n", ":2: '' is not a finite number"},
        {"x,y,r\n1,+-1,1\n", ":2: '+-1' is not a finite number"},
        {"x,y,r\n1,1,1,4\n", ":2: expected 3 values x,y,r, got 4"},
        {"x,y,r\n1,1,one\n", ":2: 'one' is not a finite number"},
        {"x,y,r\n1,1,1.0m\n", ":2: '1.0m' is not a finite number"},
        {"x,y,r\n1,nan,1\n", ":2: 'nan' is not a finite number"},
        {"x,y,r\n1,inf,1\n", ":2: 'inf' is not a finite number"},
        {"x,y,r\n1,1e999,1\n", ":2: '1e999' is not a finite number"},
        {"x,y,r\n1,1,0\n", ":2: r must be > 0, got 0"},
        {"x,y,r\n1,1,-1\n", ":2: r must be > 0, got -1"},
        {"x,y,r\n1,1,1\n3.25,1,1\n",
         ":3: the disc reaches 0.25 m beyond the right wall of the box 0 <= x <= 4, 0 <= y <= 3: check "
         "box.width "
         "and box.height"},
        {"x,y,r\n1,0.5,1\n",
         ":2: the disc reaches 0.5 m beyond the bottom wall of the box 0 <= x <= 4, 0 <= y <= 3: check "
         "box.width "
         "and box.height"},
        {"x,y,r\n1,1,1\n\n2.9,1,1\n",
         ":4: the disc overlaps the one of line 2 by 5 % of their radii, at most 1 % is accepted"},
        {"x,y,r\n1.5,1.5,1.5\n2.5,1.5,1.5\n",
         ":3: the discs have 1.178 times the area of the box: check box.width and box.height"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(error_of(text), message) << text;
}

TEST_F(PackingCsv, ColumnsOfClassesAndEllipses) {
    const Packing p = read("x,y,r, angle ,class,aspect_ratio\n1,1,.5,0.25,1,2\n3,2,.5,0,0,1\n", box, 2);
    ASSERT_EQ(p.size(), 2U);
    EXPECT_EQ(p.class_of(0), 1U);
    EXPECT_EQ(p.class_of(1), 0U);
    EXPECT_EQ(p.aspect_ratio[0], 2.0);
    EXPECT_EQ(p.angle[0], 0.25);
    EXPECT_NEAR(p.half_axes(0).x() * p.half_axes(0).y(), 0.25, 1e-15);
    EXPECT_NEAR(p.half_axes(0).x() / p.half_axes(0).y(), 2.0, 1e-15);
    EXPECT_EQ(p.reach(1), 0.5);
    EXPECT_NEAR(p.shape_of(0).determinant(), 0.25, 1e-15);
    // The long axis points along the angle.
    const Vec2 along{std::cos(0.25), std::sin(0.25)};
    EXPECT_NEAR((p.shape_of(0) * along - p.half_axes(0).x() * along).norm(), 0.0, 1e-15);

    const std::vector<std::pair<std::string, std::string>> cases{
        {"x,y,r,colour\n", ":1: unknown column 'colour', known after x,y,r are class, aspect_ratio, angle"},
        {"x,y,r,class,class\n", ":1: column 'class' stands twice"},
        {"x,y,r,r\n", ":1: unknown column 'r', known after x,y,r are class, aspect_ratio, angle"},
        {"x,y,r,angle\n", ":1: columns aspect_ratio and angle need each other"},
        {"x,y,r,class\n1,1,1\n", ":2: expected 4 values x,y,r,class, got 3"},
        {"x,y,r,class\n1,1,1,2\n",
         ":2: class must be a whole number from 0 to 1, the last [[grain_class]], got 2"},
        {"x,y,r,class\n1,1,1,0.5\n",
         ":2: class must be a whole number from 0 to 1, the last [[grain_class]], got 0.5"},
        {"x,y,r,aspect_ratio,angle\n1,1,.5,0.9,0\n", ":2: aspect_ratio must be >= 1 and <= 3, got 0.9"},
        // half axes 0.8 and 0.2: upright it fits beside the wall, lying it does not
        {"x,y,r,aspect_ratio,angle\n0.21,1,.4,3,1.5707963267948966\n1,1,.4,3,1.5707963267948966\n",
         ":2: the ellipse reaches 0.0209401 m beyond the left wall of the box 0 <= x <= 4, 0 <= y <= 3: "
         "check "
         "box.width and box.height"},
    };
    for (const auto& [text, message] : cases) EXPECT_EQ(error_of(text, box, 2), message) << text;
}

/// Two ellipses end to end and side by side: the gap closes where their half axes meet.
TEST_F(PackingCsv, EllipsesOverlapByTheirOutlines) {
    const auto two = [](double distance, double angle) {
        // r = 0.4 sqrt(2) / ... half axes 0.8 and 0.4
        return fmt::format("x,y,r,aspect_ratio,angle\n1,1.5,{0},2,{1}\n{2},1.5,{0},2,{1}\n",
                           0.4 * std::sqrt(2.0), angle, 1.0 + distance);
    };
    const double upright = std::acos(0.0);
    EXPECT_EQ(error_of(two(1.6 * 0.9901, 0.0)), "");
    EXPECT_EQ(error_of(two(1.6 * 0.98, 0.0)),
              ":3: the ellipse overlaps the one of line 2 by 2 % of their radii, at most 1 % is accepted");
    EXPECT_EQ(error_of(two(0.8 * 0.9901, upright)), "");
    EXPECT_NE(error_of(two(0.8 * 0.98, upright)), "");
}

TEST_F(PackingCsv, APeriodicCellHasNoWallsAndWrapsCentres) {
    const Box cell{{0.0, 4.0, 0.0, 4.0}, true};
    const Packing p = read("x,y,r\n-0.5,1,0.4\n4.25,3,.4\n", cell);
    EXPECT_TRUE(p.box.periodic);
    EXPECT_EQ(p.center[0], Vec2(3.5, 1.0));
    EXPECT_EQ(p.center[1], Vec2(0.25, 3.0));
    EXPECT_EQ(error_of("x,y,r\n0.1,1,0.4\n3.9,1,.4\n", cell),
              ":3: the disc overlaps the one of line 2 by 75 % of their radii, at most 1 % is accepted");
    EXPECT_EQ(
        error_of("x,y,r\n9,1,0.4\n", cell),
        ":2: the centre lies more than a cell away from the periodic cell 0 <= x <= 4, 0 <= y <= 4: check "
        "box.width and box.height");
}

TEST_F(PackingCsv, SmallOverlapsPass) {
    EXPECT_EQ(error_of("x,y,r\n1,1,1\n2.9801,1,1\n"), "");
    EXPECT_NE(error_of("x,y,r\n1,1,1\n2.9799,1,1\n"), "");
    EXPECT_EQ(error_of("x,y,r\n0.9901,1,1\n"), "");
    EXPECT_NE(error_of("x,y,r\n0.9899,1,1\n"), "");
}

TEST_F(PackingCsv, AFolderOrNothingIsRefused) {
    EXPECT_THROW(read_packing_csv("/nowhere.csv", box), InputError);
    EXPECT_THROW(read_packing_csv("/tmp", box), InputError);
}

TEST_F(PackingCsv, WrittenBitsAreReadBack) {
    Packing p;
    p.box = box;
    p.center = {{0.1 + 0.2, 1.0 / 3.0}, {3.0, 2.0 - 1e-15}};
    p.radius = {0.1, 0.70710678118654752};
    write_packing_csv(path_, p);
    const Packing again = read_packing_csv(path_, box);
    EXPECT_EQ(again.center, p.center);
    EXPECT_EQ(again.radius, p.radius);
    EXPECT_THROW(write_packing_csv("/nowhere/p.csv", p), OutputError);
    p.grain_class = {1, 0};
    p.aspect_ratio = {1.0 / 0.7, 1.0};
    p.angle = {-1.0 / 3.0, 0.0};
    write_packing_csv(path_, p);
    const Packing more = read_packing_csv(path_, box, 2);
    EXPECT_EQ(more.grain_class, p.grain_class);
    EXPECT_EQ(more.aspect_ratio, p.aspect_ratio);
    EXPECT_EQ(more.angle, p.angle);
}

}  // namespace
}  // namespace softgrain
