#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "bpm/aggregate_cache.hpp"
#include "bpm/prepare_grains.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

namespace fs = std::filesystem;

void set_variable(const char* name, const std::optional<std::string>& value) {
    if (value)
        ::setenv(name, value->c_str(), 1);
    else
        ::unsetenv(name);
}

/// Puts an environment variable back as it was.
class Variable {
  public:
    explicit Variable(const char* name) : name_(name) {
        if (const char* value = std::getenv(name)) before_ = value;
    }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;
    ~Variable() { set_variable(name_, before_); }
    void set(const std::optional<std::string>& value) const { set_variable(name_, value); }

  private:
    const char* name_;
    std::optional<std::string> before_;
};

class AggregateCacheTest : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) /
                 ("softgrain_cache_" + std::to_string(::getpid()) + "_" +
                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::remove_all(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// A soft crystal that needs no preparation: pairs of discs that touch.
    static std::vector<AggregateSpec> pair_specs() {
        std::vector<AggregateSpec> specs;
        for (int g = 0; g < AggregateCache::least_discs / 2; ++g) specs.push_back({.discs = 2, .grain = g});
        return specs;
    }
    static std::vector<Aggregate> pairs() {
        std::vector<Aggregate> grains;
        for (int g = 0; g < AggregateCache::least_discs / 2; ++g) {
            const double r = 0.5 + 1e-5 * g;
            grains.push_back({{{-r, 1.0 / 3.0}, {r, 1.0 / 3.0}}, {r, r}, 1e-4, 1e-5, 0.9, 100 + g});
        }
        return grains;
    }
    static bool same(const std::vector<Aggregate>& a, const std::vector<Aggregate>& b) {
        return std::ranges::equal(a, b, [](const Aggregate& p, const Aggregate& q) {
            return p.x == q.x && p.radius == q.radius && p.speed == q.speed && p.overlap == q.overlap &&
                   p.internal_packing_fraction == q.internal_packing_fraction && p.steps == q.steps;
        });
    }
    static std::string content(const fs::path& path) {
        std::ifstream file(path, std::ios::binary);
        std::stringstream text;
        text << file.rdbuf();
        return text.str();
    }

    fs::path folder;
};

TEST_F(AggregateCacheTest, GivesBackEveryBit) {
    const AggregateCache cache(folder);
    EXPECT_FALSE(cache.find(pair_specs()).has_value());
    cache.keep(pair_specs(), pairs());
    const auto found = cache.find(pair_specs());
    ASSERT_TRUE(found.has_value());
    EXPECT_TRUE(same(*found, pairs()));
}

TEST_F(AggregateCacheTest, EveryInputMakesAnotherFile) {
    const AggregateCache cache(folder);
    cache.keep(pair_specs(), pairs());
    const auto expect_other = [&](auto change) {
        std::vector<AggregateSpec> specs = pair_specs();
        change(specs[7]);
        EXPECT_NE(cache.file_of(specs), cache.file_of(pair_specs()));
        EXPECT_FALSE(cache.find(specs).has_value());
    };
    expect_other([](AggregateSpec& s) { s.discs = 3; });
    expect_other([](AggregateSpec& s) { s.sizes.law = DiscSizeLaw::single; });
    expect_other([](AggregateSpec& s) { s.sizes.ratio *= 1.0 + 1e-15; });
    expect_other([](AggregateSpec& s) { s.attraction_exponent = 6.0; });
    expect_other([](AggregateSpec& s) { s.attraction_range = 0.9; });
    expect_other([](AggregateSpec& s) { s.outline_rho = 0.31; });
    expect_other([](AggregateSpec& s) { s.seed = 2; });
    expect_other([](AggregateSpec& s) { s.grain = 8; });
}

TEST_F(AggregateCacheTest, DamageIsNoticed) {
    const AggregateCache cache(folder);
    cache.keep(pair_specs(), pairs());
    const fs::path path = *cache.file_of(pair_specs());
    const std::string good = content(path);
    const auto write = [&](const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; };
    for (std::size_t where : {std::size_t{0}, std::size_t{30}, good.size() / 2, good.size() - 1}) {
        std::string bad = good;
        bad[where] = static_cast<char>(bad[where] ^ 1);
        write(bad);
        EXPECT_FALSE(cache.find(pair_specs()).has_value()) << where;
    }
    for (std::size_t size : {std::size_t{0}, std::size_t{10}, good.size() / 2, good.size() - 8}) {
        write(good.substr(0, size));
        EXPECT_FALSE(cache.find(pair_specs()).has_value()) << size;
    }
    write(good + "more");
    EXPECT_FALSE(cache.find(pair_specs()).has_value());
    write(good);
    EXPECT_TRUE(cache.find(pair_specs()).has_value());
}

TEST_F(AggregateCacheTest, WhatIsNoPreparedGrainIsNotUsed) {
    // Well written, but not what a preparation ends with.
    const AggregateCache cache(folder);
    const auto expect_refused = [&](auto change) {
        std::vector<Aggregate> grains = pairs();
        change(grains[3]);
        cache.keep(pair_specs(), grains);
        EXPECT_FALSE(cache.find(pair_specs()).has_value());
    };
    expect_refused([](Aggregate& a) { a.x[0].x() += 1e-3; });
    expect_refused([](Aggregate& a) { a.x[0].x() = std::numeric_limits<double>::quiet_NaN(); });
    expect_refused([](Aggregate& a) { a.x[0].x() = -100.0; });
    expect_refused([](Aggregate& a) { a.radius[1] = -a.radius[1]; });
    expect_refused([](Aggregate& a) { a.speed = 0.1; });
    expect_refused([](Aggregate& a) { a.overlap = 0.1; });
    expect_refused([](Aggregate& a) { a.internal_packing_fraction = 0.0; });
    expect_refused([](Aggregate& a) { a.x.pop_back(), a.radius.pop_back(); });
}

TEST_F(AggregateCacheTest, WithoutAFolderItOnlyTakesTime) {
    std::ofstream(folder.string()) << "a file where the folder should be";
    for (const auto& nowhere :
         {std::optional<fs::path>(), std::optional(folder), std::optional(folder / "in")}) {
        const AggregateCache cache(nowhere);
        EXPECT_NO_THROW(cache.keep(pair_specs(), pairs()));
        EXPECT_FALSE(cache.find(pair_specs()).has_value());
    }
}

TEST_F(AggregateCacheTest, FewDiscsAreNotKept) {
    const AggregateCache cache(folder);
    std::vector<AggregateSpec> specs = pair_specs();
    std::vector<Aggregate> grains = pairs();
    specs.pop_back();
    grains.pop_back();
    cache.keep(specs, grains);
    EXPECT_FALSE(cache.file_of(specs).has_value());
    EXPECT_FALSE(fs::exists(folder));
}

TEST_F(AggregateCacheTest, TheOldestGoWhenThereIsTooMuch) {
    fs::create_directories(folder);
    const auto now = fs::file_time_type::clock::now();
    const auto place = [&](const char* name, std::uintmax_t size, int hours) {
        std::ofstream(folder / name) << "";
        fs::resize_file(folder / name, size);  // takes no space
        fs::last_write_time(folder / name, now - std::chrono::hours(hours));
    };
    place("aggregates-old.bin", 100'000'000, 3);
    place("aggregates-older.bin", 100'000'000, 30);
    place("aggregates-oldest.bin.123", 100'000'000, 300);
    place("of_another_kind", 300'000'000, 3000);
    const AggregateCache cache(folder);
    cache.keep(pair_specs(), pairs());
    EXPECT_TRUE(cache.find(pair_specs()).has_value());
    EXPECT_TRUE(fs::exists(folder / "aggregates-old.bin"));
    EXPECT_TRUE(fs::exists(folder / "aggregates-older.bin"));
    EXPECT_FALSE(fs::exists(folder / "aggregates-oldest.bin.123"));
    EXPECT_TRUE(fs::exists(folder / "of_another_kind"));
}

TEST_F(AggregateCacheTest, FolderFollowsTheEnvironment) {
    const Variable own("SOFTGRAIN_CACHE"), user("XDG_CACHE_HOME"), home("HOME");
    own.set("/somewhere");
    user.set("/user");
    home.set("/home/me");
    EXPECT_EQ(cache_folder(), fs::path("/somewhere"));
    own.set("off");
    EXPECT_FALSE(cache_folder().has_value());
    own.set("");
    EXPECT_EQ(cache_folder(), fs::path("/user/softgrain"));
    user.set(std::nullopt);
    EXPECT_EQ(cache_folder(), fs::path("/home/me/.cache/softgrain"));
    home.set(std::nullopt);
    EXPECT_FALSE(cache_folder().has_value());
}

TEST_F(AggregateCacheTest, APackingIsPreparedOnceAndAlwaysTheSame) {
    const Variable own("SOFTGRAIN_CACHE");
    const Scenario scenario = scenario_of(100);
    const BpmSettings settings = settings_of(scenario);
    Packing packing = square_packing(7, 3, 0.1);
    packing.radius[3] = 1.2;
    own.set("off");
    const std::vector<Aggregate> without = prepare_grains(scenario, packing, settings);
    own.set(folder.string());
    EXPECT_TRUE(same(prepare_grains(scenario, packing, settings), without));
    ASSERT_FALSE(fs::is_empty(folder));
    const fs::path file = *fs::directory_iterator(folder);
    const std::string kept = content(file);
    EXPECT_TRUE(same(prepare_grains(scenario, packing, settings), without));
    // All radii alike larger: the same grains, only larger.
    Packing large = packing;
    for (double& r : large.radius) r *= 3.0;
    const std::vector<Aggregate> larger = prepare_grains(scenario, large, settings);
    EXPECT_NEAR(larger[3].radius[5] / without[3].radius[5], 3.0, 1e-14);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
    // A damaged file is written anew.
    std::ofstream(file, std::ios::binary) << "damaged";
    EXPECT_TRUE(same(prepare_grains(scenario, packing, settings), without));
    EXPECT_EQ(content(file), kept);
}

}  // namespace
}  // namespace softgrain::bpm
