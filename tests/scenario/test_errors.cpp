// Wrong scenarios and the exact message, with line and column, that each must give.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/scenario/support.hpp"

namespace softgrain::test {
namespace {

struct Case {
    std::string text;
    std::string message;
};

/// A case whose text is followed by a good stage, so that it has one error only.
Case in(std::string_view text, std::string_view message) {
    return {std::string(text) + "\n" + std::string(stage), std::string(message)};
}

const std::vector<Case> values{
    in("[material]\nyoungs_modulus = -1", "s.toml:2:18: material.youngs_modulus must be > 0, got -1"),
    in("[material]\nyoungs_modulus = 0", "s.toml:2:18: material.youngs_modulus must be > 0, got 0"),
    in("\n[material]\n  poisson_ratio = 0.51",
       "s.toml:3:19: material.poisson_ratio must be >= 0 and <= 0.5, got 0.51"),
    in("[material]\ndensity = nan", "s.toml:2:11: material.density must be a finite number, got nan"),
    in("[material]\ndensity = inf", "s.toml:2:11: material.density must be a finite number, got inf"),
    in("[material]\nfriction = -1e-9", "s.toml:2:12: material.friction must be >= 0, got -1e-09"),
    in("[material]\ndensity = \"1\"", "s.toml:2:11: material.density must be a number, got the text \"1\""),
    in("[material]\ndensity = true", "s.toml:2:11: material.density must be a number, got true"),
    in("[material]\ndensity = [1]", "s.toml:2:11: material.density must be a number, got an array"),
    in("[material]\ndensity = {a = 1}", "s.toml:2:11: material.density must be a number, got a table"),
    in("[material]\ndensity = 1979-05-27", "s.toml:2:11: material.density must be a number, got a date"),
    in("[packing]\ncount = 10.5", "s.toml:2:9: packing.count must be an integer, got the number 10.5"),
    in("[packing]\ncount = 0", "s.toml:2:9: packing.count must be >= 1 and <= 1000000, got 0"),
    in("[packing]\ncount = 1000001", "s.toml:2:9: packing.count must be >= 1 and <= 1000000, got 1000001"),
    in("[packing]\nsize_law = \"gausian\"",
       "s.toml:2:12: packing.size_law must be one of gaussian, fractal, uniform_volume, single, uniform, "
       "two_sizes, got "
       "\"gausian\" "
       "(did you mean 'gaussian'?)"),
    in("[packing]\nsize_law = \"q\"",
       "s.toml:2:12: packing.size_law must be one of gaussian, fractal, uniform_volume, single, uniform, "
       "two_sizes, got \"q\""),
    in("[random]\nseed = -1", "s.toml:2:8: random.seed must be >= 0, got -1"),
    in("title = 3", "s.toml:1:9: title must be a text, got the integer 3"),
    in("[sampling]\noutlines = 1", "s.toml:2:12: sampling.outlines must be true or false, got the integer 1"),
    in("[sampling]\nframe_every = 0",
       "s.toml:2:15: sampling.frame_every must be >= 1 and <= 1000000000, got 0"),
    in("[sampling]\nstrain_interval = 0",
       "s.toml:2:19: sampling.strain_interval must be > 0 and <= 1, got 0"),
    in("[spring]\nlaw = \"herz\"",
       "s.toml:2:7: spring.law must be one of linear, hertz, got \"herz\" (did you mean 'hertz'?)"),
    in("[spring]\niterations = 1e3",
       "s.toml:2:14: spring.iterations must be an integer, got the number 1000"),
    in("[spring]\nlaw = \"linear\"\ncutoff = 0.1",
       "s.toml:3:10: spring.cutoff is for law = \"hertz\"; leave it out"),
    in("title = \"caf\u00e9\" \n[material]\ndensity = 0", "s.toml:3:11: material.density must be > 0, got 0"),
};

const std::vector<Case> names{
    in("[material]\nyoungs_modulu = 1",
       "s.toml:2:1: unknown key 'material.youngs_modulu', did you mean 'youngs_modulus'?"),
    in("[material]\nseed = 1", "s.toml:2:1: unknown key 'material.seed', it belongs to [random]"),
    in("[material]\ncolour_of_grains = 1",
       "s.toml:2:1: unknown key 'material.colour_of_grains', known are youngs_modulus, poisson_ratio, "
       "density, "
       "friction, wall_friction, cohesion, yield_stress"),
    in("poisson_ratio = 0.3", "s.toml:1:1: unknown key 'poisson_ratio', it belongs to [material]"),
    in("[materials]\ndensity = 1", "s.toml:1:2: unknown table 'materials', did you mean 'material'?"),
    in("[sprnig]", "s.toml:1:2: unknown table 'sprnig', did you mean 'spring'?"),
    in("[glue]\nstrenght = 1", "s.toml:2:1: unknown key 'glue.strenght', did you mean 'strength'?"),
    in("[[material]]\ndensity = 1", "s.toml:1:1: material must be one table, write [material], got an array"),
    in("material = 1", "s.toml:1:12: material must be one table, write [material], got the integer 1"),
    {"[loading]\nuntil_strain = 0.1\n",
     "s.toml:1:1: loading must be an array of tables, write [[loading]], got a table"},
    {"loading = [1]\n", "s.toml:1:12: loading.0 must be a table, got the integer 1"},
    {"loading = []\n", "s.toml:1:11: loading has no stage: write at least one [[loading]] table"},
    {"title = \"a\"\n", "s.toml:1:1: loading has no stage: write at least one [[loading]] table"},
    {"", "s.toml:1:1: loading has no stage: write at least one [[loading]] table"},
};

const std::vector<Case> stages{
    {"[[loading]]\nstrain_rate = 1\n",
     "s.toml:1:1: loading.0 has no end: give until_strain, until_packing_fraction, until_stress, duration or "
     "another until_... key"},
    {"[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\ninertial_number = 1e-3\n",
     "s.toml:4:19: loading.0 has both strain_rate and inertial_number: remove one"},
    {"[[loading]]\nuntil_strain = 1.0\nstrain_rate = 1\n",
     "s.toml:2:16: loading.0.until_strain must be >= -1 and < 1, got 1"},
    {"[[loading]]\nkind = \"oedometric\"\nuntil_strain = 0.5\nstrain_rate = 1\n",
     "s.toml:1:1: loading.0.wall must be given for an oedometric stage: left, right, bottom or top"},
    {"[[loading]]\nkind = \"oedometric\"\nwall = \"topp\"\nuntil_strain = 0.5\nstrain_rate = 1\n",
     "s.toml:3:8: loading.0.wall must be one of left, right, bottom, top, got \"topp\" (did you mean "
     "'top'?)"},
    {"[[loading]]\nwall = \"top\"\nuntil_strain = 0.5\nstrain_rate = 1\n",
     "s.toml:2:8: loading.0.wall is for kind oedometric only, not isotropic: remove it"},
    {"[[loading]]\nkind = \"hold\"\n",
     "s.toml:1:1: loading.0.duration must be given for a hold, which ends after it"},
    {"[[loading]]\nkind = \"hold\"\nduration = 1\nstrain_rate = 1\n",
     "s.toml:4:15: loading.0.strain_rate is for kind isotropic, oedometric, shear, uniaxial, biaxial, "
     "stress, "
     "probe only, not hold: remove it"},
    {"[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\nduration = 1\n", ""},
    {"[[loading]]\nduration = 1\nstrain_rate = 1\n", ""},
    {"[[loading]]\nkind = \"hold\"\nduration = 1\nuntil_unbalanced = 1e-3\n", ""},
    {"[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\n[[loading]]\nuntil_stress = 0\nstrain_rate = 1\n",
     "s.toml:5:16: loading.1.until_stress must be > 0, got 0"},
};

constexpr std::string_view cell = "[box]\nperiodic = true\n";

/// Text after a periodic box, which takes two lines.
Case in_cell(std::string_view text, std::string_view message) {
    return {std::string(cell) + std::string(text), std::string(message)};
}

const std::vector<Case> cell_stages{
    {"[[loading]]\nkind = \"shear\"\nuntil_shear = 0.1\nstrain_rate = 1\n",
     "s.toml:2:8: loading.0.kind = \"shear\" needs a periodic cell: set box.periodic = true"},
    {"[[loading]]\nkind = \"gradient\"\ngradient_xy = 0.1\nduration = 1\n",
     "s.toml:2:8: loading.0.kind = \"gradient\" needs a periodic cell: set box.periodic = true"},
    in_cell("[[loading]]\nkind = \"shear\"\nstrain_rate = 1\n",
            "s.toml:3:1: loading.0 has no end: give until_shear, until_packing_fraction, until_stress, "
            "duration or "
            "another until_... key"),
    in_cell(
        "[[loading]]\nkind = \"shear\"\nuntil_strain = 0.1\nstrain_rate = 1\n",
        "s.toml:5:16: loading.0.until_strain is for kind isotropic, oedometric, uniaxial, biaxial only, not "
        "shear: use until_shear for a shear, or remove it"),
    in_cell("[[loading]]\nkind = \"shear\"\nuntil_shear = 0.1\nwall = \"top\"\nstrain_rate = 1\n",
            "s.toml:6:8: loading.0.wall is for kind oedometric only, not shear: remove it"),
    in_cell("[[loading]]\nkind = \"shear\"\nuntil_packing_fraction_undeformed = 1.0\nstrain_rate = 1\n",
            "s.toml:5:37: loading.0.until_packing_fraction_undeformed is not for a shear without "
            "normal_stress, which keeps the area: remove it"),
    in_cell("[[loading]]\nuntil_shear = 0.1\nuntil_strain = 0.1\nstrain_rate = 1\n",
            "s.toml:4:15: loading.0.until_shear is for kind shear only, not isotropic: use until_strain"),
    in_cell("[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\ngradient_xx = 1\n",
            "s.toml:6:15: loading.0.gradient_xx is for kind gradient only, not isotropic: remove it"),
    in_cell("[[loading]]\nkind = \"gradient\"\ngradient_xy = 0.1\n",
            "s.toml:3:1: loading.0.duration must be given for a gradient, which ends after it"),
    in_cell("[[loading]]\nkind = \"gradient\"\nduration = 1\ngradient_xy = 0\n",
            "s.toml:3:1: loading.0 has no velocity gradient: give gradient_xx, gradient_xy or gradient_yy"),
    in_cell(
        "[[loading]]\nkind = \"gradient\"\nduration = 1\ngradient_xy = 1\nuntil_strain = 0.1\n",
        "s.toml:7:16: loading.0.until_strain is for kind isotropic, oedometric, uniaxial, biaxial only, not "
        "gradient: use until_shear for a shear, or remove it"),
};

const std::vector<Case> stress_stages{
    {"[[loading]]\nkind = \"biaxial\"\nuntil_strain = 0.1\nstrain_rate = 1\n",
     "s.toml:1:1: loading.0.lateral_stress must be given for a biaxial stage"},
    {"[[loading]]\nkind = \"biaxial\"\nlateral_stress = 0\nuntil_strain = 0.1\nstrain_rate = 1\n",
     "s.toml:3:18: loading.0.lateral_stress must be > 0, got 0"},
    {"[[loading]]\nkind = \"uniaxial\"\naxis = \"z\"\nuntil_strain = 0.1\nstrain_rate = 1\n",
     "s.toml:3:8: loading.0.axis must be one of x, y, got \"z\""},
    {"[[loading]]\nkind = \"uniaxial\"\nlateral_stress = 1\nuntil_stress_ratio = 0.3\nstrain_rate = 1\n",
     "s.toml:3:18: loading.0.lateral_stress is for kind biaxial only, not uniaxial: remove it"},
    {"[[loading]]\nkind = \"stress\"\nstrain_rate = 1\n",
     "s.toml:1:1: loading.0 has no stress to go to: give pressure, or stress_xx, stress_yy or both"},
    {"[[loading]]\nkind = \"stress\"\npressure = 1\nstress_xx = 2\nstrain_rate = 1\n",
     "s.toml:4:13: loading.0 has both pressure and stress_xx: remove one"},
    {"[[loading]]\nkind = \"stress\"\npressure = 1\nuntil_stress = 2\nstrain_rate = 1\n",
     "s.toml:4:16: loading.0.until_stress is for kind isotropic, oedometric, shear, uniaxial, biaxial only, "
     "not "
     "stress: use pressure for a stress, or remove it"},
    {"[[loading]]\nkind = \"probe\"\nstress_amplitude = 1\nstrain_rate = 1\n",
     "s.toml:1:1: loading.0.direction must be given for a probe: 0 is +xx, 90 is +yy"},
    {"[[loading]]\nkind = \"probe\"\ndirection = 30\nstrain_rate = 1\n",
     "s.toml:1:1: loading.0 has no amplitude: give stress_amplitude or strain_amplitude"},
    {"[[loading]]\nkind = \"probe\"\ndirection = 30\nstress_amplitude = 0\nstrain_rate = 1\n",
     "s.toml:4:20: loading.0.stress_amplitude must be > 0, got 0"},
    {"[[loading]]\nkind = \"probe\"\ndirection = 30\nstress_amplitude = 1\nstrain_amplitude = "
     "0.1\nstrain_rate = "
     "1\n",
     "s.toml:5:20: loading.0 has both stress_amplitude and strain_amplitude: remove one"},
    {"[[loading]]\nkind = \"probe\"\ndirection = 30\nstrain_amplitude = 0.1\ntolerance = 0.1\nstrain_rate = "
     "1\n",
     "s.toml:5:13: loading.0 has both strain_amplitude and tolerance: remove one"},
    {"[[loading]]\nkind = \"repeat\"\n",
     "s.toml:1:1: loading.0.stages must be given for a repeat: how many stages before it"},
    in("[[loading]]\nkind = \"repeat\"\nstages = 1",
       "s.toml:3:10: loading.0.stages must be at most 0, the stages before it, got 1"),
    {std::string(stage) + "[[loading]]\nkind = \"repeat\"\nstages = 1\nstrain_rate = 1\n",
     "s.toml:6:10: loading.1.stages repeats a stage that would have to go back: end the last of them where "
     "the "
     "first began\n"
     "s.toml:7:15: loading.1.strain_rate is for kind isotropic, oedometric, shear, uniaxial, biaxial, "
     "stress, "
     "probe only, not repeat: remove it"},
    in_cell("[[loading]]\nkind = \"shear\"\nuntil_shear = 0.1\nnormal_stress = -1\nstrain_rate = 1\n",
            "s.toml:6:17: loading.0.normal_stress must be > 0, got -1"),
};

const std::vector<Case> courses{
    // Cycles end where they began, or not.
    {"[[loading]]\nkind = \"uniaxial\"\nuntil_strain = 0.1\nstrain_rate = 1\n[[loading]]\nkind = "
     "\"uniaxial\"\n"
     "until_strain = 0.05\nstrain_rate = 1\nreverse = true\n[[loading]]\nkind = \"repeat\"\nstages = "
     "2\ntimes = 9\n",
     ""},
    {"[[loading]]\nkind = \"uniaxial\"\nuntil_strain = 0.1\nstrain_rate = 1\n[[loading]]\nkind = "
     "\"uniaxial\"\n"
     "until_strain = 0.2\nstrain_rate = 1\n[[loading]]\nkind = \"repeat\"\nstages = 2\ntimes = 9\n",
     "s.toml:11:10: loading.2.stages repeats a stage that would have to go back: end the last of them where "
     "the "
     "first began"},
    {"[[loading]]\nkind = \"uniaxial\"\nuntil_strain = 0.1\nstrain_rate = 1\n[[loading]]\nkind = \"repeat\"\n"
     "stages = 1\n[[loading]]\nkind = \"repeat\"\nstages = 2\n",
     "s.toml:7:10: loading.1.stages repeats a stage that would have to go back: end the last of them where "
     "the "
     "first began\n"
     "s.toml:10:10: loading.2.stages reaches back to another repeat: write out what it repeats"},
    // A probe by strain along y, then uniaxial along y from there.
    {"[[loading]]\nkind = \"probe\"\ndirection = 90\nstrain_amplitude = 0.1\nstrain_rate = "
     "1\n[[loading]]\nkind = "
     "\"uniaxial\"\nuntil_strain = 0.05\nstrain_rate = 1\n",
     "s.toml:8:16: loading.1.until_strain must be above 0.1, where the stage begins, got 0.05; set reverse = "
     "true "
     "to go back"},
    // Lateral stress leaves the other axis unknown, and a time the end.
    {"[[loading]]\nkind = \"biaxial\"\nlateral_stress = 1\nuntil_strain = 0.1\nstrain_rate = "
     "1\n[[loading]]\nkind = "
     "\"uniaxial\"\naxis = \"x\"\nuntil_strain = -0.1\nstrain_rate = 1\n",
     ""},
    {"[[loading]]\nuntil_strain = 0.2\nduration = 5\nstrain_rate = 1\n[[loading]]\nuntil_strain = 0.1\n"
     "strain_rate = 1\n",
     ""},
    {"[[loading]]\nuntil_strain = 0.0\nstrain_rate = 1\n",
     "s.toml:2:16: loading.0.until_strain must be above 0, where the stage begins, got 0; set reverse = true "
     "to go back"},
    {"[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\nreverse = true\n",
     "s.toml:2:16: loading.0.until_strain must be below 0, where the stage begins, to be reached in reverse, "
     "got 0.1"},
    {"[[loading]]\nuntil_strain = 0.2\nstrain_rate = 1\n[[loading]]\nkind = \"hold\"\nduration = 1\n"
     "[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\n",
     "s.toml:8:16: loading.2.until_strain must be above 0.2, where the stage begins, got 0.1; set reverse = "
     "true to go back"},
    // An isotropic stage moves the height by as much as the width.
    {"[[loading]]\nuntil_strain = 0.2\nstrain_rate = 1\n[[loading]]\nkind = \"oedometric\"\nwall = \"top\"\n"
     "until_strain = 0.15\nstrain_rate = 1\n",
     "s.toml:7:16: loading.1.until_strain must be above 0.2, where the stage begins, got 0.15; set reverse = "
     "true to go back"},
    in_cell("[[loading]]\nkind = \"shear\"\nuntil_shear = 0.2\nstrain_rate = 1\n"
            "[[loading]]\nkind = \"shear\"\nuntil_shear = 0.3\nstrain_rate = 1\nreverse = true\n",
            "s.toml:9:15: loading.1.until_shear must be below 0.2, where the stage begins, to be reached in "
            "reverse, got 0.3"),
    // Where the grains decide, or another direction moved, nothing is known and nothing is said.
    {"[[loading]]\nuntil_strain = 0.2\nuntil_stress = 1\nstrain_rate = 1\n[[loading]]\nuntil_strain = 0.1\n"
     "strain_rate = 1\n",
     ""},
    {"[[loading]]\nuntil_strain = 0.2\nstrain_rate = 1\n[[loading]]\nuntil_strain = 0.0\nstrain_rate = 1\n"
     "reverse = true\n",
     ""},
    {"[[loading]]\nkind = \"oedometric\"\nwall = \"left\"\nuntil_strain = 0.2\nstrain_rate = 1\n[[loading]]\n"
     "kind = \"oedometric\"\nwall = \"top\"\nuntil_strain = 0.1\nstrain_rate = 1\n",
     ""},
};

const std::vector<Case> classes{
    in("[[grain_class]]\nshare = 0", "s.toml:2:9: grain_class.0.share must be > 0, got 0"),
    in("[[grain_class]]\naspect_ratio = 3.5",
       "s.toml:2:16: grain_class.0.aspect_ratio must be >= 1 and <= 3, got 3.5"),
    in("[[grain_class]]\n[[grain_class]]\npoisson_ratio = 0.6",
       "s.toml:3:17: grain_class.1.poisson_ratio must be >= 0 and <= 0.5, got 0.6"),
    in("[[grain_class]]\nfriction = 0.1",
       "s.toml:2:1: unknown key 'grain_class.0.friction', it belongs to [material]"),
    in("[grain_class]\nshare = 1",
       "s.toml:1:1: grain_class must be an array of tables, write [[grain_class]], got a table"),
    in("[material]\ncohesion = -1", "s.toml:2:12: material.cohesion must be >= 0, got -1"),
    in("[material]\nyield_stress = 0", "s.toml:2:16: material.yield_stress must be > 0, got 0"),
    in("[box]\nperiodic = 1", "s.toml:2:12: box.periodic must be true or false, got the integer 1"),
    in("[box]\nperiodic = true\ngravity_y = -9.81",
       "s.toml:3:13: box.gravity_y needs walls that carry the weight: set box.periodic = false, or leave it "
       "out"),
};

const std::vector<Case> packings{
    in("[packing]\nregion = \"disc\"",
       "s.toml:2:10: packing.region is filled at random places: set packing.generator = "
       "\"random_sequential\""),
    in("[packing]\nregion_radius = 1", "s.toml:2:17: packing.region_radius needs packing.region"),
    in("[packing]\ngenerator = \"random_sequential\"\nregion = \"disc\"",
       "s.toml:3:10: packing.region needs the size of its box: give box.width and box.height"),
    in("[box]\nwidth = 1\nheight = 1\n[packing]\ngenerator = \"random_sequential\"\nregion = \"disc\"",
       "s.toml:6:10: packing.region = \"disc\" needs region_radius"),
    in("[box]\nwidth = 1\nheight = 1\n[packing]\ngenerator = \"random_sequential\"\nregion = \"disc\"\n"
       "region_radius = 0.6",
       "s.toml:6:10: packing.region must lie inside the box"),
    in("[[driven]]\ncenter_x = 1\ncenter_y = 1", "s.toml:1:1: driven.0.kind = \"ring\" needs radius"),
    in("[[driven]]\nkind = \"row\"\nfrom_x = 1\nfrom_y = 1\nto_x = 1\nto_y = 2\nspin = 1",
       "s.toml:7:8: driven.0.spin is not for kind = \"row\": remove it"),
    in("[packing]\nradius_min = 1.1",
       "s.toml:2:14: packing.radius_min must be at most radius_mean = 1, got 1.1"),
    in("[packing]\nradius_mean = 2",
       "s.toml:2:15: packing.radius_mean must be at most radius_max = 1.333, got 2"),
    in("[packing]\nradius_max = 0.9",
       "s.toml:2:14: packing.radius_max must be at least radius_mean = 1, got 0.9"),
    in("[sampling]\nmeasures = \"forces, fabric\"",
       "s.toml:2:12: sampling.measures names 'fabric', known are forces, chains, grains, pair_correlation, "
       "tessellation"),
    in("[sampling]\nmeasures = \"chains, forces,chains\"",
       "s.toml:2:12: sampling.measures names 'chains' twice"),
    in("[packing]\ngenerator = \"random_sequential\"",
       "s.toml:2:13: packing.generator = \"random_sequential\" has no end of its own: give "
       "packing.packing_fraction"),
    in("[packing]\nsize_law = \"fractal\"\nradius_min = 2.0\nradius_max = 1.0",
       "s.toml:4:14: packing.radius_max must be at least radius_min = 2, got 1"),
    in("[packing]\nsize_law = \"fractal\"\nradius_min = 1e-6\nradius_max = 1.0",
       "s.toml:4:14: packing.radius_max must be at most 1000 times radius_min"),
    in("[packing]\npacking_fraction = 1.0",
       "s.toml:2:20: packing.packing_fraction must be > 0 and < 1, got 1"),
    in("[box]\nwidth = 1.0", "s.toml:2:9: box.width needs box.height too"),
    in("[box]\nwidth = 1.0\nheight = 101",
       "s.toml:3:10: box.height must be within a factor of 100 of box.width"),
    in("[packing]\npath = \"\"\n[box]\nwidth = 1\nheight = 1", "s.toml:2:8: packing.path must not be empty"),
    in("[packing]\npath = \"/nowhere/p.csv\"\n[box]\nwidth = 1\nheight = 1",
       "s.toml:2:8: packing.path names a file that is not there: '/nowhere/p.csv'"),
};

void expect_messages(const std::vector<Case>& cases) {
    for (const Case& c : cases) EXPECT_EQ(error_of(c.text), c.message) << "in:\n" << c.text;
}

TEST(ScenarioErrors, Values) {
    expect_messages(values);
}
TEST(ScenarioErrors, Names) {
    expect_messages(names);
}
TEST(ScenarioErrors, Stages) {
    expect_messages(stages);
}
TEST(ScenarioErrors, StagesOfAPeriodicCell) {
    expect_messages(cell_stages);
}
TEST(ScenarioErrors, StagesByStress) {
    expect_messages(stress_stages);
}
TEST(ScenarioErrors, StagesThatWouldHaveToGoBack) {
    expect_messages(courses);
}
TEST(ScenarioErrors, GrainClasses) {
    expect_messages(classes);
}
TEST(ScenarioErrors, TooManyGrainClasses) {
    std::string text;
    for (int k = 0; k < 256; ++k) text += "[[grain_class]]\n";
    EXPECT_EQ(error_of(text + std::string(stage)),
              "s.toml:256:1: grain_class.255 is one too many, at most 255 are accepted");
}
TEST(ScenarioErrors, Packings) {
    expect_messages(packings);
}

TEST(ScenarioErrors, PackingFileExcludesTheGeneratorAndNeedsABox) {
    const std::string file = std::string(SOFTGRAIN_TEST_DATA) + "/scenario/three.csv";
    EXPECT_EQ(error_of("[packing]\ncount = 3\npath = \"" + file + "\"\n" + std::string(stage)),
              "s.toml:2:9: packing.count has no effect on a packing read from packing.path: remove one\n"
              "s.toml:3:8: packing.path needs the size of its box: give box.width and box.height");
}

TEST(ScenarioErrors, AllOfAFileInOrderOfPosition) {
    EXPECT_EQ(error_of("[sampling]\nframe_every = 0\n[material]\nfriction = -1\ndensty = 2\n[[loading]]\n"
                       "strain_rate = 0\nuntil_strain = 2\n"),
              "s.toml:2:15: sampling.frame_every must be >= 1 and <= 1000000000, got 0\n"
              "s.toml:4:12: material.friction must be >= 0, got -1\n"
              "s.toml:5:1: unknown key 'material.densty', did you mean 'density'?\n"
              "s.toml:7:15: loading.0.strain_rate must be > 0, got 0\n"
              "s.toml:8:16: loading.0.until_strain must be >= -1 and < 1, got 2");
}

TEST(ScenarioErrors, ManyAreCounted) {
    std::string text;
    for (int k = 0; k < 60; ++k) text += "zzzzzzzzzz" + std::to_string(k) + " = 1\n";
    const std::string message = error_of(text + std::string(stage));
    EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 50);
    EXPECT_TRUE(message.ends_with("\nand 10 more errors"));
}

TEST(ScenarioErrors, AWrongValueDoesNotCauseASecondError) {
    // radius_mean = "a" stays at its default 1 < radius_min, which must not be reported.
    EXPECT_EQ(
        error_of("[packing]\nradius_mean = \"a\"\nradius_min = 4.0\nradius_max = 5.0\n" + std::string(stage)),
        "s.toml:2:15: packing.radius_mean must be a number, got the text \"a\"");
}

TEST(ScenarioErrors, LongAndBrokenTextIsShownShortAndOnOneLine) {
    const std::string message = error_of("[material]\ndensity = \"\"\"a\nb" + std::string(1000, 'x') +
                                         "\"\"\"\n" + std::string(stage));
    EXPECT_EQ(message.find('\n'), message.npos);
    EXPECT_LT(message.size(), 200U);
    EXPECT_NE(message.find("a bxxx"), message.npos) << message;
}

TEST(ScenarioErrors, FileThatIsNotThereOrNoFile) {
    const auto message = [](const std::filesystem::path& path) {
        try {
            read_scenario(path, {}, methods());
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(message("/nowhere/s.toml"), "/nowhere/s.toml: there is no such scenario file");
    EXPECT_EQ(message("/tmp"), "/tmp: cannot be read as a scenario file");
    EXPECT_EQ(message("/dev/zero"), "/dev/zero: a scenario has at most 1048576 bytes");
}

}  // namespace
}  // namespace softgrain::test
