#include <gtest/gtest.h>
#include <unistd.h>

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

    Packing read(std::string_view text) {
        std::ofstream(path_, std::ios::binary) << text;
        return read_packing_csv(path_, box);
    }

    /// The message after the folder.
    std::string error_of(std::string_view text) {
        try {
            read(text);
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
}

}  // namespace
}  // namespace softgrain
