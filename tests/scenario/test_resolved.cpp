// Defaults, the resolved scenario, and the list of keys.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/scenario/support.hpp"

namespace softgrain::test {
namespace {

void expect_same(const LoadingStage& a, const LoadingStage& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.wall, b.wall);
    EXPECT_EQ(a.until_strain, b.until_strain);
    EXPECT_EQ(a.until_packing_fraction, b.until_packing_fraction);
    EXPECT_EQ(a.until_packing_fraction_undeformed, b.until_packing_fraction_undeformed);
    EXPECT_EQ(a.until_stress, b.until_stress);
    EXPECT_EQ(a.duration, b.duration);
    EXPECT_EQ(a.strain_rate, b.strain_rate);
    EXPECT_EQ(a.inertial_number, b.inertial_number);
    EXPECT_EQ(a.until_shear, b.until_shear);
    EXPECT_EQ(a.reverse, b.reverse);
    EXPECT_EQ(a.axis, b.axis);
    for (const auto member :
         {&LoadingStage::lateral_stress, &LoadingStage::normal_stress, &LoadingStage::stress_xx,
          &LoadingStage::stress_yy, &LoadingStage::stress_amplitude, &LoadingStage::strain_amplitude,
          &LoadingStage::until_stress_xx, &LoadingStage::until_stress_yy, &LoadingStage::until_stress_ratio,
          &LoadingStage::until_unbalanced})
        EXPECT_EQ(a.*member, b.*member);
    EXPECT_EQ(a.tolerance, b.tolerance);
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_EQ(a.stages, b.stages);
    EXPECT_EQ(a.times, b.times);
    EXPECT_EQ(a.gradient_xx, b.gradient_xx);
    EXPECT_EQ(a.gradient_xy, b.gradient_xy);
    EXPECT_EQ(a.gradient_yy, b.gradient_yy);
}

void expect_same(const Material& a, const Material& b) {
    EXPECT_EQ(a.youngs_modulus, b.youngs_modulus);
    EXPECT_EQ(a.poisson_ratio, b.poisson_ratio);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.friction, b.friction);
    EXPECT_EQ(a.wall_friction, b.wall_friction);
    EXPECT_EQ(a.cohesion, b.cohesion);
    EXPECT_EQ(a.yield_stress, b.yield_stress);
}

void expect_same(const PackingSpec& a, const PackingSpec& b) {
    EXPECT_EQ(a.path, b.path);
    EXPECT_EQ(a.generator, b.generator);
    EXPECT_EQ(a.size_law, b.size_law);
    EXPECT_EQ(a.count, b.count);
    EXPECT_EQ(a.radius_mean, b.radius_mean);
    EXPECT_EQ(a.radius_deviation, b.radius_deviation);
    EXPECT_EQ(a.radius_min, b.radius_min);
    EXPECT_EQ(a.radius_max, b.radius_max);
    EXPECT_EQ(a.fractal_dimension, b.fractal_dimension);
    EXPECT_EQ(a.small_share, b.small_share);
    EXPECT_EQ(a.packing_fraction, b.packing_fraction);
    ASSERT_EQ(a.region.has_value(), b.region.has_value());
    if (!a.region) return;
    EXPECT_EQ(a.region->center, b.region->center);
    EXPECT_EQ(a.region->radius, b.region->radius);
    EXPECT_EQ(a.region->size, b.region->size);
}

void expect_same(const DrivenGrains& a, const DrivenGrains& b) {
    EXPECT_EQ(a.ring, b.ring);
    for (const auto member :
         {&DrivenGrains::disc_radius, &DrivenGrains::spacing, &DrivenGrains::radius, &DrivenGrains::spin})
        EXPECT_EQ(a.*member, b.*member);
    for (const auto member :
         {&DrivenGrains::center, &DrivenGrains::from, &DrivenGrains::to, &DrivenGrains::velocity})
        EXPECT_EQ(a.*member, b.*member);
}

void expect_same(const Scenario& a, const Scenario& b) {
    EXPECT_EQ(a.title, b.title);
    EXPECT_EQ(a.seed, b.seed);
    expect_same(a.material, b.material);
    ASSERT_EQ(a.classes.size(), b.classes.size());
    for (std::size_t c = 0; c < a.classes.size(); ++c) {
        EXPECT_EQ(a.classes[c].name, b.classes[c].name);
        EXPECT_EQ(a.classes[c].share, b.classes[c].share);
        EXPECT_EQ(a.classes[c].aspect_ratio, b.classes[c].aspect_ratio);
        expect_same(a.classes[c].material, b.classes[c].material);
    }
    expect_same(a.packing, b.packing);
    EXPECT_EQ(a.box.width, b.box.width);
    EXPECT_EQ(a.box.height, b.box.height);
    EXPECT_EQ(a.box.periodic, b.box.periodic);
    EXPECT_EQ(a.box.gravity, b.box.gravity);
    ASSERT_EQ(a.loading.size(), b.loading.size());
    for (std::size_t k = 0; k < a.loading.size(); ++k) expect_same(a.loading[k], b.loading[k]);
    EXPECT_EQ(a.sampling.strain_interval, b.sampling.strain_interval);
    EXPECT_EQ(a.sampling.average_window, b.sampling.average_window);
    EXPECT_EQ(a.sampling.frame_every, b.sampling.frame_every);
    EXPECT_EQ(a.sampling.outlines, b.sampling.outlines);
    EXPECT_EQ(a.sampling.contacts, b.sampling.contacts);
    EXPECT_EQ(a.sampling.parts, b.sampling.parts);
    EXPECT_EQ(a.sampling.measures, b.sampling.measures);
    EXPECT_EQ(a.sampling.time_interval, b.sampling.time_interval);
    ASSERT_EQ(a.driven.size(), b.driven.size());
    for (std::size_t k = 0; k < a.driven.size(); ++k) expect_same(a.driven[k], b.driven[k]);
    ASSERT_EQ(a.method_settings.size(), b.method_settings.size());
    for (const auto& [name, settings] : a.method_settings)
        EXPECT_EQ(settings.values(), b.method_settings.at(name).values()) << name;
}

TEST(Resolved, EveryDefaultIsThatOfThePlainData) {
    Scenario expected;
    expected.loading.resize(1);
    expected.loading[0].until_strain = 0.1;
    expected.loading[0].strain_rate = 1e-3;
    for (const MethodKeys& method : methods())
        expected.method_settings.emplace(method.name, Settings(method.keys));
    expect_same(parse(stage), expected);
}

TEST(Resolved, IntegersAreReadWhereNumbersAreExpected) {
    EXPECT_EQ(parse("[material]\nyoungs_modulus = 3\n" + std::string(stage)).material.youngs_modulus, 3.0);
}

TEST(Resolved, ReadingTheWrittenScenarioGivesTheSame) {
    const std::string text = R"(title = "\"quoted\" \\ tab\t caf\u00e9"
random.seed = 9223372036854775807
[material]
youngs_modulus = 1.2345678901234567e9
poisson_ratio = 0.1
density = 1e-300
friction = 0.3
[packing]
generator = "random_sequential"
size_law = "fractal"
count = 77
radius_mean = 0.012
radius_deviation = 0.0024
radius_min = 0.004
radius_max = 0.038
fractal_dimension = 1.7
small_share = 0.25
packing_fraction = 0.6
[box]
width = 2
height = 0.30000000000000004
gravity_x = 0.1
gravity_y = -9.81
[[loading]]
until_packing_fraction = 0.95
until_stress = 1e20
inertial_number = 3e-4
[[loading]]
kind = "hold"
duration = 12.5
[[loading]]
kind = "oedometric"
wall = "top"
until_strain = 0.2
until_packing_fraction_undeformed = 1.2
strain_rate = 0.001
[sampling]
strain_interval = 0.01
average_window = 0.0
frame_every = 3
outlines = false
contacts = false
parts = true
measures = "chains,  tessellation"
[spring]
law = "hertz"
damping = 0
iterations = 7
rolling = false
cutoff = 0.1
)";
    const Scenario first = parse(text);
    EXPECT_EQ(first.title, "\"quoted\" \\ tab\t caf\u00e9");
    EXPECT_EQ(first.loading.at(2).wall, Wall::top);
    const std::string written = write_scenario(first, methods());
    expect_same(parse(written), first);
    EXPECT_EQ(write_scenario(parse(written), methods()), written);
}

TEST(Resolved, RegionsAndDrivenGrainsAreWrittenBack) {
    const std::string box = "[box]\nwidth = 12\nheight = 10\n";
    const std::string disc =
        "[packing]\ngenerator = \"random_sequential\"\nregion = \"disc\"\nregion_y = 4\n"
        "region_radius = 3\n";
    const std::string rectangle =
        "[packing]\ngenerator = \"random_sequential\"\nregion = \"rectangle\"\n"
        "region_width = 3\nregion_height = 2\n";
    const std::string driven =
        "[[driven]]\ncenter_x = 5\ncenter_y = 4\nradius = 3.5\ndisc_radius = 0.1\nspin = -0.2\n"
        "[[driven]]\nkind = \"row\"\nfrom_x = 0\nfrom_y = 1\nto_x = 2\nto_y = 3\nspacing = 0.5\n"
        "velocity_y = 0.25\n[sampling]\ntime_interval = 0.5\n";
    for (const std::string& packing : {disc, rectangle}) {
        const Scenario first = parse(box + packing + driven + std::string(stage));
        expect_same(parse(write_scenario(first, methods())), first);
        ASSERT_TRUE(first.packing.region.has_value());
        EXPECT_EQ(first.packing.region->center.x(), 6.0) << "the middle of the box";
        ASSERT_EQ(first.driven.size(), 2U);
        EXPECT_TRUE(first.driven[0].ring);
        EXPECT_EQ(first.driven[0].spin, -0.2);
        EXPECT_EQ(first.driven[1].to, Vec2(2.0, 3.0));
        EXPECT_EQ(first.driven[1].velocity, Vec2(0.0, 0.25));
    }
}

TEST(Resolved, ClassesTakeWhatTheyDoNotSayFromTheMaterial) {
    const std::string text = R"([material]
youngs_modulus = 5
poisson_ratio = 0.4
cohesion = 0.01
wall_friction = 0.2
yield_stress = 0.3
[box]
periodic = true
[[grain_class]]
name = "soft"
share = 3
youngs_modulus = 1
yield_stress = 0.1
[[grain_class]]
aspect_ratio = 2
density = 7
[[loading]]
kind = "gradient"
gradient_xy = -0.1
gradient_yy = 0.2
duration = 3
[[loading]]
kind = "shear"
until_shear = -0.1
reverse = true
inertial_number = 1e-3
[[loading]]
until_strain = -0.5
reverse = true
strain_rate = 1
)";
    const Scenario s = parse(text);
    ASSERT_EQ(s.class_count(), 2U);
    EXPECT_TRUE(s.has_ellipses());
    EXPECT_EQ(s.classes[0].name, "soft");
    EXPECT_EQ(s.material_of(0).youngs_modulus, 1.0);
    EXPECT_EQ(s.material_of(0).yield_stress, 0.1);
    EXPECT_EQ(s.material_of(0).poisson_ratio, 0.4);
    EXPECT_EQ(s.material_of(1).youngs_modulus, 5.0);
    EXPECT_EQ(s.material_of(1).yield_stress, 0.3);
    EXPECT_EQ(s.material_of(1).density, 7.0);
    EXPECT_EQ(s.material_of(1).cohesion, 0.01);
    EXPECT_EQ(s.loading[0].gradient_xx, 0.0);
    EXPECT_EQ(s.loading[0].gradient_xy, -0.1);
    EXPECT_TRUE(s.box.periodic);
    const std::string written = write_scenario(s, methods());
    expect_same(parse(written), s);
    EXPECT_EQ(write_scenario(parse(written), methods()), written);
    EXPECT_EQ(parse(stage).class_count(), 1U);
    EXPECT_EQ(parse(stage).material_of(0).youngs_modulus, 1.0);
}

TEST(Resolved, StagesByStressAreWrittenAndReadBack) {
    const std::string text = R"([box]
periodic = true
[[loading]]
kind = "stress"
pressure = 0.02
tolerance = 0.005
until_unbalanced = 1e-3
inertial_number = 1e-3
[[loading]]
kind = "stress"
stress_yy = 0.03
duration = 50
strain_rate = 1
[[loading]]
kind = "biaxial"
axis = "x"
lateral_stress = 0.02
until_stress_ratio = 0.3
until_stress_xx = 0.5
until_stress_yy = 0.6
until_strain = 0.1
strain_rate = 1
[[loading]]
kind = "uniaxial"
until_strain = 0.05
strain_rate = 1
[[loading]]
kind = "probe"
direction = -30
stress_amplitude = 1e-3
strain_rate = 1
[[loading]]
kind = "probe"
direction = 120
strain_amplitude = 1e-3
strain_rate = 1
[[loading]]
kind = "shear"
normal_stress = 0.02
until_shear = 0.1
strain_rate = 1
[[loading]]
kind = "shear"
reverse = true
until_shear = -0.1
strain_rate = 1
[[loading]]
kind = "repeat"
stages = 2
times = 7
)";
    const Scenario s = parse(text);
    EXPECT_EQ(s.loading[0].stress_xx, 0.02);
    EXPECT_EQ(s.loading[0].stress_yy, 0.02);
    EXPECT_FALSE(s.loading[1].stress_xx);
    EXPECT_EQ(s.loading[2].axis, 0);
    EXPECT_EQ(s.loading[3].axis, 1);
    EXPECT_EQ(s.loading[4].direction, -30.0);
    EXPECT_EQ(stage_order(s.loading).size(), 8U + 7U * 2U);
    const std::string written = write_scenario(s, methods());
    expect_same(parse(written), s);
    EXPECT_EQ(write_scenario(parse(written), methods()), written);
    const Scenario other = parse(text, {"loading.0.stress_xx=0.1", "loading.0.stress_yy=0.2"});
    EXPECT_EQ(other.loading[0].stress_xx, 0.1) << "an option takes the place of the pressure";
    EXPECT_EQ(other.loading[0].stress_yy, 0.2);
    EXPECT_EQ(parse(text, {"loading.1.pressure=0.4"}).loading[1].stress_xx, 0.4);
}

TEST(Resolved, ARepeatRunsWhatCameBeforeIt) {
    std::vector<LoadingStage> loading(4);
    loading[2].kind = LoadingKind::repeat;
    loading[2].stages = 2;
    loading[2].times = 2;
    EXPECT_EQ(stage_order(loading), (std::vector<std::size_t>{0, 1, 0, 1, 0, 1, 3}));
}

TEST(Resolved, APackingFileStaysTheSameFileFromAnotherFolder) {
    const auto file = std::filesystem::path(SOFTGRAIN_TEST_DATA) / "scenario" / "three.csv";
    const std::string text =
        "[packing]\npath = \"three.csv\"\n[box]\nwidth = 4.0\nheight = 4.0\n" + std::string(stage);
    const Scenario first = parse_scenario(text, file.parent_path() / "s.toml", {}, methods());
    const Scenario again =
        parse_scenario(write_scenario(first, methods()), "elsewhere/s.toml", {}, methods());
    expect_same(again, first);
    EXPECT_EQ(again.packing.path, file);
}

TEST(Resolved, ReadsFromAFile) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("softgrain_scenario_" + std::to_string(::getpid()) + ".toml");
    std::ofstream(path) << stage;
    const std::vector<std::string> overrides{"material.density=5"};
    const Scenario s = read_scenario(path, overrides, methods());
    std::filesystem::remove(path);
    EXPECT_EQ(s.material.density, 5.0);
    EXPECT_EQ(s.source, path);
}

TEST(Resolved, TheListOfKeysNamesEveryKey) {
    const std::string list = describe_keys(methods());
    for (const char* line :
         {"[material]", "[[loading]]", "[spring]", "youngs_modulus", "until_packing_fraction_undeformed",
          "fractal_dimension", "linear, hertz", ">= 0 and <= 0.5", "average_window", "cutoff"})
        EXPECT_NE(list.find(line), list.npos) << line;
}

/// A later version has other comments and more keys; a run of the earlier one can still go on.
TEST(Resolved, SaysTheSameWithOtherCommentsAndFewerKeys) {
    const std::string now =
        write_scenario(parse("[material]\nfriction = 0.25\n" + std::string(stage)), methods());
    const auto same = [&](const std::string& from, const std::string& to,
                          std::string_view method = "spring") {
        std::string text = now;
        const auto at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return says_the_same(text.replace(at, from.size(), to), now, methods(), method);
    };
    EXPECT_TRUE(same("[material]", "[material]"));
    EXPECT_TRUE(same("[material]", "# other\n[material]"));
    EXPECT_TRUE(same("wall_friction = 0", "# none = 0"));
    EXPECT_TRUE(same("strength = 1", "strength = 2")) << "of another method";
    EXPECT_FALSE(same("strength = 1", "strength = 2", "glue"));
    EXPECT_FALSE(same("\nfriction = 0.25", "\nfriction = 0.26"));
    EXPECT_FALSE(same("[material]", "[materiel]"));
}

}  // namespace
}  // namespace softgrain::test
