// Plans: what is read, and that every error has its place.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/bench/plan.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

class Plans : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_plan_" + std::to_string(::getpid()));
        fs::create_directories(folder);
        std::ofstream(folder / "s.toml") << "title = \"s\"\n";
        std::ofstream(folder / "r.csv") << "# made up\ne,F\n0,0\n1,2\n";
    }
    void TearDown() override { fs::remove_all(folder); }

    Plan read(const std::string& text) const {
        std::ofstream(folder / "p.toml") << text;
        return read_plan(folder / "p.toml");
    }
    /// What is wrong with the text, without the folder.
    std::string errors(const std::string& text) const {
        try {
            read(text);
        } catch (const InputError& error) {
            std::string all = error.what();
            const std::string prefix = (folder / "").string();
            for (std::size_t at = 0; (at = all.find(prefix)) != std::string::npos;)
                all.erase(at, prefix.size());
            return all;
        }
        return "";
    }

    const std::string one_case =
        "[[case]]\nname = \"c\"\nscenario = \"s.toml\"\nreference = \"r.csv\"\nover = \"axial_strain = e\"\n"
        "stress = \"stress_yy * box_width = F\"\nstress_error = \"0.1 * F\"\nset = \"a.b=1, c.d=x\"\n";
    const std::string one_knob = "[[knob]]\nmethod = \"sdem\"\nname = \"defaults\"\n";
    fs::path folder;
};

TEST_F(Plans, CasesAndKnobs) {
    const Plan plan =
        read(one_case + one_knob +
             "[[knob]]\nmethod = \"mpm\"\nname = \"grid\"\nkey = \"mpm.points_across_radius\"\n"
             "values = \"4, 8\"\nset = \"mpm.driver=quasi_static\"\ncases = \"c\"\n"
             "[[headline]]\ncase = \"c\"\nmethod = \"sdem\"\nagainst = \"grid\"\nerror = 0.1\ntimes = 10\n");
    ASSERT_EQ(plan.cases.size(), 1U);
    const Case& one = plan.cases[0];
    EXPECT_EQ(one.title, "c");
    EXPECT_EQ(one.set, (std::vector<std::string>{"a.b=1", "c.d=x"}));
    ASSERT_TRUE(one.truth);
    EXPECT_EQ(one.quantities[stress]->reference.of(*one.truth), (std::vector<double>{0.0, 2.0}));
    EXPECT_EQ(one.quantities[stress]->error->of(*one.truth), (std::vector<double>{0.0, 0.2}));
    EXPECT_EQ(one.quantities[stress]->run.text(), "stress_yy * box_width");
    EXPECT_FALSE(one.quantities[1]);
    ASSERT_EQ(plan.settings.size(), 3U);
    EXPECT_EQ(plan.settings[0].label, "defaults");
    EXPECT_TRUE(plan.settings[0].set.empty());
    EXPECT_EQ(plan.settings[2].label, "points_across_radius = 8");
    EXPECT_EQ(plan.settings[2].set,
              (std::vector<std::string>{"mpm.driver=quasi_static", "mpm.points_across_radius=8"}));
    EXPECT_TRUE(plan.settings[2].is_for(one));
    EXPECT_EQ(plan.headlines[0].times, 10.0);
}

TEST_F(Plans, ACaseWithoutItsReferenceIsKeptWithoutTruth) {
    fs::remove(folder / "r.csv");
    EXPECT_FALSE(read(one_case + one_knob).cases[0].truth);
}

TEST_F(Plans, ErrorsNameLineAndCure) {
    struct Wrong {
        std::string text, said;
    };
    const std::string knob = one_case + "[[knob]]\nmethod = \"sdem\"\nname = \"k\"\n";
    for (const auto& [text, said] : std::vector<Wrong>{
             {"[[case]\n", "p.toml:1:"},
             {one_knob, "case is missing"},
             {one_case, "knob is missing"},
             {one_case + "nmae = \"x\"\n" + one_knob, "p.toml:9:1: unknown key 'nmae', did you mean 'name'?"},
             {"[[knobs]]\n" + one_case + one_knob, "p.toml:1:3: unknown key 'knobs', did you mean 'knob'?"},
             {"[[case]]\nname = \"c\"\n" + one_knob, "p.toml:1:1: case.0.scenario is missing"},
             {one_case + "area = 3\n" + one_knob,
              "p.toml:9:8: case.0.area must be a text, got the integer 3"},
             {one_case + "area = \"strain_xx = G\"\n" + one_knob,
              "p.toml:9:8: case.0.area of the reference: the history has no column 'G'"},
             {one_case + "area = \"stres = F\"\n" + one_knob,
              "p.toml:9:8: case.0.area the history has no column 'stres'"},
             {one_case + "area = \"strain_xx *\"\n" + one_knob,
              "p.toml:9:8: case.0.area \"strain_xx *\" ends"},
             {one_case + one_case + one_knob, "p.toml:10:8: case.1.name names another case already"},
             {one_case + "[[knob]]\nmethod = \"fem\"\nname = \"k\"\n",
              "p.toml:10:10: knob.0.method must be one of sdem, bpm, rigid_dem, mpm, got \"fem\""},
             {knob + "cases = \"d\"\n", "p.toml:12:9: knob.0.cases names no sound case: \"d\""},
             {knob + "key = \"sdem.law\"\n", "p.toml:12:7: knob.0.key and values are given together"},
             {knob + "key = \"sdem.law\"\nvalues = \" ,\"\n",
              "p.toml:13:10: knob.0.values must be at least one"},
             {one_case + one_knob + one_knob, "p.toml:12:1: knob.1 runs \"defaults\" again, as line 9 does"},
             {one_case + one_knob +
                  "[[headline]]\ncase = \"c\"\nmethod = \"sdem\"\nagainst = \"no\"\nerror = 0.1\ntimes = 2\n",
              "p.toml:15:11: headline.0.against names no knob"},
             {one_case + one_knob +
                  "[[headline]]\ncase = \"c\"\nmethod = \"sdem\"\nagainst = \"defaults\"\nerror = -1\ntimes "
                  "= 2\n",
              "p.toml:16:9: headline.0.error must be > 0"},
         }) {
        const std::string all = errors(text);
        EXPECT_NE(all.find(said), std::string::npos) << "expected: " << said << "\ngot: " << all;
    }
    EXPECT_THROW(read_plan(folder / "nowhere.toml"), InputError);
}

TEST_F(Plans, ThoseOfTheProjectAreSound) {
    for (const char* name : {"plan.toml", "quick.toml"})
        EXPECT_FALSE(read_plan(fs::path(SOFTGRAIN_SOURCE) / "bench/error" / name).cases.empty()) << name;
}

}  // namespace
}  // namespace softgrain::bench
