// Options `--set KEY=VALUE`.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/scenario/support.hpp"

namespace softgrain::test {
namespace {

const std::string base = std::string("title = \"a\"\n[material]\ndensity = 2\n") + std::string(stage);
const std::filesystem::path data = std::filesystem::path(SOFTGRAIN_TEST_DATA) / "scenario";

TEST(Overrides, ReplaceAndAddValues) {
    const Scenario s =
        parse(base, {"material.poisson_ratio=0.45", "material.density=3", "loading.0.until_strain=0.2",
                     "box.width=2", "box.height=3", "random.seed=7", "spring.law=hertz",
                     "spring.rolling=false", "title=two words"});
    EXPECT_EQ(s.material.poisson_ratio, 0.45);
    EXPECT_EQ(s.material.density, 3.0);
    EXPECT_EQ(s.loading.at(0).until_strain, 0.2);
    EXPECT_EQ(s.box.width, 2.0);
    EXPECT_EQ(s.box.height, 3.0);
    EXPECT_EQ(s.seed, 7U);
    EXPECT_EQ(s.method_settings.at("spring").text("law"), "hertz");
    EXPECT_FALSE(s.method_settings.at("spring").boolean("rolling"));
    EXPECT_EQ(s.title, "two words");
}

TEST(Overrides, TextKeysTakeAnyWord) {
    for (const std::string word : {"2024", "true", "1979-05-27", "a=b", "x # y", "0.5"})
        EXPECT_EQ(parse(base, {"title=" + word}).title, word);
    EXPECT_EQ(parse(base, {"title=\"quoted # text\""}).title, "quoted # text");
}

TEST(Overrides, TheLastOfTwoCounts) {
    EXPECT_EQ(parse(base, {"material.density=3", "material.density=4"}).material.density, 4.0);
}

TEST(Overrides, AnEndTakesThePlaceOfTheFilesEnds) {
    const std::string text = base + "until_stress = 0.5\n";
    const LoadingStage stage = parse(text, {"loading.0.until_packing_fraction_undeformed=1.1"}).loading.at(0);
    EXPECT_EQ(stage.until_packing_fraction_undeformed, 1.1);
    EXPECT_FALSE(stage.until_strain);
    EXPECT_FALSE(stage.until_stress);
    EXPECT_EQ(stage.strain_rate, 1e-3);
    // Two options are both meant.
    const LoadingStage both =
        parse(text, {"loading.0.until_strain=0.3", "loading.0.until_stress=2"}).loading.at(0);
    EXPECT_EQ(both.until_strain, 0.3);
    EXPECT_EQ(both.until_stress, 2.0);
}

TEST(Overrides, ARateTakesThePlaceOfTheOther) {
    const LoadingStage stage = parse(base, {"loading.0.inertial_number=1e-4"}).loading.at(0);
    EXPECT_EQ(stage.inertial_number, 1e-4);
    EXPECT_FALSE(stage.strain_rate);
}

TEST(Overrides, OnlyTheNamedStageChanges) {
    const Scenario s = parse(base + std::string(stage), {"loading.1.until_stress=2"});
    EXPECT_EQ(s.loading.at(0).until_strain, 0.1);
    EXPECT_FALSE(s.loading.at(0).until_stress);
    EXPECT_EQ(s.loading.at(1).until_stress, 2.0);
}

TEST(Overrides, APackingFileTakesThePlaceOfTheGenerator) {
    const std::string text = base + "[packing]\ncount = 30\nradius_mean = 0.9\n";
    const Scenario s =
        parse(text, {"packing.path=" + (data / "three.csv").string(), "box.width=4", "box.height=4"});
    EXPECT_EQ(s.packing.path, data / "three.csv");
    EXPECT_NE(error_of(text, {"packing.path=" + (data / "three.csv").string(), "packing.count=3",
                              "box.width=4", "box.height=4"}),
              "");
}

TEST(Overrides, PathsStartFromTheCurrentFolderThoseOfTheFileFromItsOwn) {
    const std::string text = base + "[packing]\npath = \"three.csv\"\n[box]\nwidth = 4\nheight = 4\n";
    const Scenario s = parse_scenario(text, data / "s.toml", {}, methods());
    EXPECT_EQ(s.packing.path, data / "three.csv");
    const std::vector<std::string> overrides{"packing.path=three.csv"};
    try {
        parse_scenario(text, data / "s.toml", overrides, methods());
        FAIL() << "the current folder has no three.csv";
    } catch (const InputError& error) {
        const auto here = std::filesystem::current_path() / "three.csv";
        EXPECT_EQ(std::string(error.what()),
                  "--set packing.path: names a file that is not there: '" + here.string() + "'");
    }
}

TEST(Overrides, ErrorsNameTheOption) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"material.poisson_ratio=0.6", "--set material.poisson_ratio: must be >= 0 and <= 0.5, got 0.6"},
        {"material.density=heavy", "--set material.density: must be a number, got the text \"heavy\""},
        {"material.density=nan", "--set material.density: must be a finite number, got nan"},
        {"material.density=", "--set material.density: must be a number, got the text \"\""},
        {"material.densty=1",
         "--set material.densty: unknown key 'material.densty', did you mean 'density'?"},
        {"sprin.law=hertz", "--set sprin.law: unknown table 'sprin', did you mean 'spring'?"},
        {"spring.law=herz",
         "--set spring.law: must be one of linear, hertz, got \"herz\" (did you mean 'hertz'?)"},
        {"loading.1.until_strain=0.1", "--set loading.1.until_strain: there is no loading 1, the last is 0"},
        {"loading.until_strain=0.1",
         "--set loading.until_strain: 'loading' has several stages, write loading.0.until_strain"},
        {"loading.x.until_strain=0.1",
         "--set loading.x.until_strain: 'x' must be the number of a [[loading]], from 0"},
        {"loading.0.until_strain=1", "--set loading.0.until_strain: must be >= -1 and < 1, got 1"},
        {"title.x=1", "--set title.x: 'title' is not a table"},
        {"material=1", "--set material: must be one table, write [material], got the integer 1"},
        {"material.density", "--set material.density: expected KEY=VALUE, as material.density=2"},
        {"material..density=1",
         "--set material..density: a key is words joined by points, as material.density"},
        {"material.a.b.c=1",
         "--set material.a.b.c: a key has at most three parts, as loading.0.until_strain"},
        {"material.density.x=1", "--set material.density.x: 'material.density' is not a table"},
        {"=1", "--set =1: a key is words joined by points, as material.density"},
        {"title=a\nb", "--set ...: must be one line of UTF-8 text"},
        {"title=\xFF", "--set ...: must be one line of UTF-8 text"},
    };
    for (const auto& [option, message] : cases) EXPECT_EQ(error_of(base, {option}), message);
}

TEST(Overrides, ErrorsComeAfterThoseOfTheFileInTheirOwnOrder) {
    EXPECT_EQ(error_of("[material]\nfriction = -1\n" + std::string(stage),
                       {"random.seed=-2", "material.density=0"}),
              "s.toml:2:12: material.friction must be >= 0, got -1\n"
              "--set random.seed: must be >= 0, got -2\n"
              "--set material.density: must be > 0, got 0");
}

}  // namespace
}  // namespace softgrain::test
