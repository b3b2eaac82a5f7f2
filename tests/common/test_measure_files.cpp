// Measures of frames as files.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numbers>

#include "common/io/history_csv.hpp"
#include "common/io/measure_files.hpp"
#include "common/packing/random.hpp"

namespace softgrain {
namespace {

namespace fs = std::filesystem;

class MeasureFiles : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_measures_" + std::to_string(::getpid()));
        fs::remove_all(folder);
        Random random(1);
        for (int k = 0; k < 60; ++k) {
            const double x = random.between(0.0, 4.0);
            place.emplace_back(x, random.between(0.0, 2.0));
        }
        area.assign(place.size(), 0.04);
    }
    void TearDown() override { fs::remove_all(folder); }

    GrainView view() const {
        GrainView v;
        v.box = box;
        v.centroid = place;
        v.reference_area = area;
        v.contacts = contacts;
        return v;
    }
    History file(const std::string& name) const { return read_history(folder / "measures" / name); }

    fs::path folder;
    Box box{{0.0, 4.0, 0.0, 2.0}, true, 0.3};
    std::vector<Vec2> place;
    std::vector<double> area;
    std::vector<GrainContact> contacts;
};

Sample frame(int number) {
    Sample sample;
    sample.index = 5 * number;
    sample.is_frame = true;
    sample.frame = number;
    return sample;
}

TEST_F(MeasureFiles, StrainsAreThoseSinceTheLastFrameEvenOfAnotherWriter) {
    MeasureWriter(folder, {"tessellation"}).observe(view(), frame(0));
    const Mat2 moved = (Mat2() << 0.9, 0.04, 0.0, 0.98).finished();
    for (Vec2& x : place) x = moved * x;
    const Mat2 lattice = moved * box.lattice();
    box = {{0.0, lattice(0, 0), 0.0, lattice(1, 1)}, true, lattice(0, 1)};
    MeasureWriter(folder, {"tessellation"}).observe(view(), frame(1));
    const History first = file("tessellation_000000.csv"), second = file("tessellation_000001.csv");
    EXPECT_EQ(first.rows(), 120U);
    ASSERT_EQ(second.rows(), 120U);
    double area_sum = 0.0, grains = 0.0;
    for (std::size_t t = 0; t < 120; ++t) {
        EXPECT_NEAR(first.column("strain_xx")[t], 0.0, 1e-12);
        EXPECT_NEAR(second.column("strain_xx")[t], 0.1, 1e-9);
        EXPECT_NEAR(second.column("strain_yy")[t], 0.02, 1e-9);
        EXPECT_NEAR(second.column("strain_xy")[t], -0.02, 1e-9);
        const auto at = [&](const char* name) { return second.column(name)[t]; };
        const double triangle = 0.5 * ((at("x1") - at("x0")) * (at("y2") - at("y0")) -
                                       (at("x2") - at("x0")) * (at("y1") - at("y0")));
        area_sum += triangle;
        grains += triangle / (1.0 + at("void_ratio"));
    }
    EXPECT_NEAR(area_sum, box.area(), 1e-12);
    EXPECT_NEAR(grains, 60 * 0.04, 1e-12);
}

TEST_F(MeasureFiles, OnlyWhatWasAskedForAtFramesOnly) {
    contacts.push_back({0, 1, {0.0, 0.0}, {1.0, 0.0}, {-2.0, 0.0}, 0.0});
    MeasureWriter writer(folder, {"forces", "chains", "pair_correlation"});
    Sample between = frame(3);
    between.is_frame = false;
    EXPECT_EQ(writer.need(between), Need::base);
    writer.observe(view(), between);
    EXPECT_TRUE(fs::is_empty(folder / "measures"));
    EXPECT_EQ(writer.need(frame(3)), Need::contacts);
    EXPECT_EQ(MeasureWriter(folder, {"tessellation"}).need(frame(3)), Need::base);
    writer.observe(view(), frame(3));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "measures"), fs::directory_iterator()), 3);

    const History forces = file("forces_000003.csv");
    ASSERT_EQ(forces.rows(), 11U);  // one force, which is the mean
    EXPECT_DOUBLE_EQ(forces.column("probability_density")[10], 10.0);
    EXPECT_EQ(file("chains_000003.csv").rows(), 60U);
    EXPECT_EQ(file("chains_000003.csv").column("chain")[0], -1.0);
    // By a twentieth of the mean diameter, up to half of the cell.
    const History g = file("pair_correlation_000003.csv");
    const double diameter = 2.0 * std::sqrt(0.04 / std::numbers::pi);
    EXPECT_NEAR(g.column("distance")[1], 0.075 * diameter, 1e-12);
    EXPECT_EQ(g.rows(), static_cast<std::size_t>(0.5 * box.spacing() / (0.05 * diameter)));
}

TEST_F(MeasureFiles, GrainsAreWrittenAsTheyAreAndDrivenOnesMarked) {
    std::vector<Vec2> velocity(place.size(), Vec2{0.25, -0.5});
    GrainView v = view();
    v.velocity = velocity;
    v.driven = 2;
    MeasureWriter(folder, {"grains", "chains"}).observe(v, frame(0));
    const History grains = file("grains_000000.csv");
    ASSERT_EQ(grains.rows(), 60U);
    EXPECT_EQ(grains.column("y")[7], place[7].y());
    EXPECT_EQ(grains.column("vy")[7], -0.5);
    EXPECT_DOUBLE_EQ(grains.column("radius")[0], std::sqrt(0.04 / std::numbers::pi));
    EXPECT_EQ(grains.column("driven")[57], 0.0);
    EXPECT_EQ(grains.column("driven")[58], 1.0);
    EXPECT_EQ(file("chains_000000.csv").rows(), 58U);
}

TEST(Measures, AreNamedInALine) {
    EXPECT_TRUE(measures_in("").empty());
    EXPECT_EQ(measures_in(" forces ,chains"), (std::vector<std::string>{"forces", "chains"}));
    EXPECT_EQ(measures_in("a,,b"), (std::vector<std::string>{"a", "", "b"}));
}

}  // namespace
}  // namespace softgrain
