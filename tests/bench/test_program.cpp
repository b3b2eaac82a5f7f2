// `softgrain bench error` as its users run it.
#include <algorithm>
#include <sstream>

#include "tests/bench/program.hpp"

namespace softgrain {
namespace {

class BenchProgram : public BenchFolder {
  protected:
    static Outcome bench_error(const std::string& options) { return bench("error " + options); }
};

TEST_F(BenchProgram, AQuickBenchAndWhatIsKeptOfIt) {
    const std::string out = "--quick --repeats 2 --out " + (folder / "b").string();
    const Outcome first = bench_error(out);
    ASSERT_EQ(first.exit_code, 0) << first.said;
    EXPECT_NE(first.said.find("10/10 four_walls mpm, grid, points_across_radius = 8"), std::string::npos)
        << first.said;
    EXPECT_NE(first.said.find("times cheaper"), std::string::npos) << first.said;
    const std::string csv = content(folder / "b" / "error.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5) << csv;
    EXPECT_EQ(content(folder / "b" / "error.md").rfind("# Error against cost\n", 0), 0U);
    for (const char* name : {"four_walls_stress.svg", "four_walls_area.svg"})
        EXPECT_NE(content(folder / "b" / name).find("</svg>"), std::string::npos) << name;
    EXPECT_FALSE(fs::exists(folder / "b" / "four_walls_coordination.svg")) << "one grain has no Z";

    const Outcome again = bench_error(out);
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_NE(again.said.find("--resume"), std::string::npos) << again.said;

    fs::remove_all(folder / "b" / "runs" / "four_walls" / "rigid_dem_rigid_dem.stiffness=0.5" / "2");
    const Outcome resumed = bench_error(out + " --resume");
    EXPECT_EQ(resumed.exit_code, 0) << resumed.said;
    EXPECT_NE(resumed.said.find("8/10 four_walls rigid_dem"), std::string::npos) << "the missing one is run\n"
                                                                                 << resumed.said;
    EXPECT_EQ(resumed.said.find("10/10"), std::string::npos) << "the others are not\n" << resumed.said;
    const auto without_rigid = [](const std::string& text) {
        std::istringstream lines(text);
        std::string kept;
        for (std::string line; std::getline(lines, line);)
            if (line.find("rigid_dem") == std::string::npos) kept += line + "\n";
        return kept;
    };
    EXPECT_EQ(without_rigid(content(folder / "b" / "error.csv")), without_rigid(csv));
}

TEST_F(BenchProgram, AMethodThatRefusesIsARowWithItsReason) {
    const std::string scenarios = std::string(SOFTGRAIN_SOURCE) + "/scenarios/single_grain/";
    std::ofstream(folder / "plan.toml")
        << "[[case]]\nname = \"c\"\nscenario = \"" << scenarios << "four_walls.toml\"\nreference = \""
        << scenarios
        << "reference_four_walls_nu0.3.csv\"\nset = \"material.cohesion=0.1\"\nover = \"axial_strain = e\"\n"
           "stress = \"stress_yy * box_width = F\"\n[[case]]\nname = \"d\"\nscenario = \""
        << scenarios
        << "four_walls.toml\"\nreference = \"none.csv\"\nover = \"axial_strain\"\nstress = \"mean_stress\"\n"
           "[[knob]]\nmethod = \"bpm\"\nname = \"defaults\"\n[[knob]]\nmethod = \"sdem\"\nname = "
           "\"fast\"\nset = "
           "\"sdem.inertial_number=0.1\"\n";
    const Outcome o = bench_error("--repeats 1 --plan " + (folder / "plan.toml").string() + " --out " +
                                  (folder / "b").string());
    EXPECT_EQ(o.exit_code, 0) << o.said;
    EXPECT_NE(o.said.find("d: left out, its reference"), std::string::npos) << o.said;
    EXPECT_NE(content(folder / "b" / "error.csv").find("material.cohesion"), std::string::npos)
        << content(folder / "b" / "error.csv");
    EXPECT_NE(o.said.find("c bpm, defaults: 0.00 s, cannot run this scenario\n"), std::string::npos)
        << o.said;
    EXPECT_NE(o.said.find("sdem, fast"), std::string::npos) << "the others go on\n" << o.said;
}

TEST_F(BenchProgram, BadInputIsExitTwo) {
    const std::string out = " --out " + (folder / "b").string();
    for (const auto& [options, said] :
         {std::pair<std::string, std::string>{"--quick --case three_walls", "it has four_walls"},
          {"--quick --method fem", "sdem, bpm, rigid_dem, mpm"},
          {"--quick --method bpm", "nothing to run is left"},
          {"--plan nowhere.toml", "nowhere.toml: there is no such plan file"},
          {"--quick --repeats 0", "--repeats"}}) {
        const Outcome o = bench_error(options + out);
        EXPECT_EQ(o.exit_code, 2) << options;
        EXPECT_NE(o.said.find(said), std::string::npos) << o.said;
    }
    std::ofstream(folder / "plan.toml") << content(fs::path(SOFTGRAIN_SOURCE) / "bench/error/quick.toml")
                                        << "[[knob]]\nmethod = \"sdem\"\nname = \"k\"\n"
                                           "set = \"sdem.laww=x\"\n";
    fs::create_directories(folder / "x" / "y");
    fs::rename(folder / "plan.toml", folder / "x" / "y" / "plan.toml");
    fs::create_directory_symlink(fs::path(SOFTGRAIN_SOURCE) / "scenarios", folder / "scenarios");
    const Outcome o = bench_error("--plan " + (folder / "x" / "y" / "plan.toml").string() + out);
    EXPECT_EQ(o.exit_code, 2) << o.said;
    EXPECT_NE(o.said.find("knob \"k\" on case four_walls"), std::string::npos) << o.said;
    EXPECT_NE(o.said.find("did you mean 'law'?"), std::string::npos) << o.said;
    EXPECT_FALSE(fs::exists(folder / "b" / "runs")) << "nothing was run";
}

}  // namespace
}  // namespace softgrain
