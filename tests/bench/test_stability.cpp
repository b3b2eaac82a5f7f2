// Bisection on a closed form, random scenarios, children with limits, values that are not finite, plans.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "app/bench/stability/draw.hpp"
#include "app/bench/stability/finite_files.hpp"
#include "app/bench/stability/largest_stable.hpp"
#include "app/bench/stability/plan.hpp"
#include "app/bench/stability/tables.hpp"
#include "app/methods.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

/// Leap-frog of a mass on a spring is stable up to 2 / omega.
TEST(LargestStable, OfASpringIsTwoOverOmega) {
    const double omega = 3.7;
    for (const double predicted : {0.1 / omega, 2.0 / omega, 9.0 / omega}) {
        const double factor = largest_stable([&](double f) {
            double x = 1e-9, v = 0.0;
            for (int k = 0; k < 5000; ++k) {
                v -= omega * omega * x * f * predicted;
                x += v * f * predicted;
            }
            return std::abs(x) < 1e-6;
        });
        EXPECT_LE(factor * predicted * omega, 2.0);
        EXPECT_GE(factor * predicted * omega, 2.0 / 1.02 * 0.999) << "to the resolution";
    }
}

TEST(LargestStable, EndsWhereNothingOrAllIsStable) {
    EXPECT_EQ(largest_stable([](double) { return true; }), FactorSearch{}.most);
    EXPECT_EQ(largest_stable([](double) { return false; }), FactorSearch{}.least);
}

TEST(RandomScenarios, AreAcceptedAndTheOthersRefusedLineByLine) {
    std::size_t refused = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        for (const Method& method : methods()) {
            const DrawnScenario drawn = draw_scenario(seed, method.name);
            EXPECT_NO_THROW(parse_scenario(drawn.text, "again.toml", {}, method_keys())) << drawn.text;
            EXPECT_EQ(draw_scenario(seed, method.name).text, drawn.text) << "the same for the same seed";
            refused += drawn.refused.size();
            for (const std::string& message : drawn.refused) {
                std::istringstream lines(message);
                for (std::string line; std::getline(lines, line);)
                    EXPECT_TRUE(line.starts_with("drawn.toml:")) << line;
            }
        }
    EXPECT_GT(refused, 0U) << "what is refused was looked at";
}

TEST(Children, AreAskedToEndAndThenEnded) {
    const ChildLimits short_time{0.1, 0.2, std::uint64_t{1} << 33U};
    const ChildEnd sleeping = run_child({"/bin/sleep", "60"}, ChildOutput::read, short_time);
    EXPECT_TRUE(sleeping.asked_to_end);
    EXPECT_EQ(sleeping.signal, SIGTERM);
    const ChildEnd deaf =
        run_child({"/bin/sh", "-c", "trap '' TERM; while :; do :; done"}, ChildOutput::read, short_time);
    EXPECT_TRUE(deaf.asked_to_end);
    EXPECT_EQ(deaf.signal, SIGKILL);
    const ChildEnd good = run_child({"/bin/sh", "-c", "echo why >&2; exit 3"}, ChildOutput::read, short_time);
    EXPECT_FALSE(good.asked_to_end);
    EXPECT_EQ(good.exit_code, 3);
    EXPECT_EQ(good.messages, "why");
    const ChildEnd nothing = run_child({"/nowhere"}, ChildOutput::read);
    EXPECT_EQ(nothing.exit_code, -1);
    EXPECT_NE(nothing.messages.find("cannot start"), std::string::npos);
}

class Folder : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_stability_" + std::to_string(::getpid()));
        fs::create_directories(folder / "measures");
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

TEST_F(Folder, ValuesThatAreNotFiniteAreFound) {
    const Method& sdem = find_method("sdem");
    std::ofstream(folder / "history.csv")
        << "inertial_number,contact_penetration,kinetic_energy\nnan,nan,0\n0,nan,1\n";
    std::ofstream(folder / "measures" / "tessellation_000000.csv") << "void_ratio,strain_xx\n1,nan\n";
    EXPECT_EQ(not_finite_in_run(folder, sdem), std::nullopt) << "what is not given or not defined may be nan";
    EXPECT_EQ(not_finite_in_run(folder, find_method("mpm")), "history.csv: contact_penetration, row 1");
    std::ofstream(folder / "measures" / "grains_000000.csv") << "x\n0\ninf\n";
    EXPECT_EQ(not_finite_in_run(folder, sdem), "grains_000000.csv: x, row 2");
    std::ofstream(folder / "history.csv") << "inertial_number,kinetic_energy\n0,0\n0,nan\n";
    EXPECT_EQ(not_finite_in_run(folder, sdem), "history.csv: kinetic_energy, row 2");
}

/// A point with a value, by their bytes.
std::string vtp_with(const char* value) {
    return std::string(
               "<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\" "
               "header_type=\"UInt32\"><PolyData><Piece NumberOfPoints=\"1\"><PointData><DataArray "
               "type=\"Float64\" Name=\"speed\" format=\"binary\">") +
           value +
           "</DataArray></PointData><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
           "format=\"binary\">GAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==</DataArray></Points></Piece></"
           "PolyData></VTKFile>\n";
}

TEST_F(Folder, ValuesThatAreNotFiniteAreFoundInVtkFiles) {
    const Method& sdem = find_method("sdem");
    std::ofstream(folder / "grains_000000.vtp") << vtp_with("CAAAAAAAAAAAAPA/");
    EXPECT_EQ(not_finite_in_run(folder, sdem), std::nullopt);
    std::ofstream(folder / "grains_000000.vtp") << vtp_with("CAAAAAAAAAAAAPh/");
    EXPECT_EQ(not_finite_in_run(folder, sdem), "grains_000000.vtp: speed");
}

TEST_F(Folder, PlansAreReadAndTheirErrorsHaveALine) {
    const auto read = [&](const std::string& text) {
        std::ofstream(folder / "p.toml") << text;
        return read_stability_plan(folder / "p.toml");
    };
    const StabilityPlan plan = read(
        "[random]\nscenarios = 3\n[[map]]\nname = \"m\"\nmethod = \"sdem\"\nphi = \"0.8, 0.9\"\n"
        "damping = \"a.b=1 c.d=2, e.f=3\"\n[[long]]\nname = \"l\"\nkind = \"rest\"\nmethod = \"bpm\"\n");
    EXPECT_EQ(plan.random.scenarios, 3);
    EXPECT_EQ(plan.maps.at(0).phi, (std::vector<double>{0.8, 0.9}));
    EXPECT_EQ(plan.maps[0].damping, (std::vector<std::string>{"a.b=1 c.d=2", "e.f=3"}));
    EXPECT_EQ(plan.long_runs.at(0).kind, LongKind::rest);
    for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
             {"[radnom]\n", "p.toml:1:"},
             {"[random]\nscenario = 3\n", "p.toml:2:1: unknown key 'scenario'"},
             {"[[map]]\nname = \"m\"\nmethod = \"fem\"\n", "p.toml:3:10: map.0.method must be one of sdem"},
             {"[[map]]\nname = \"m\"\nmethod = \"sdem\"\nphi = \"0.8; 0.9\"\n", "map.0.phi must be numbers"},
             {"[[extreme]]\nname = \"e\"\nscenario = \"no.toml\"\n",
              "p.toml:3:12: extreme.0.scenario there is no"},
             {"[[long]]\nname = \"A b\"\nmethod = \"sdem\"\n", "long.0.name must be of small letters"}}) {
        try {
            read(text);
            ADD_FAILURE() << "accepted: " << text;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        }
    }
    for (const char* name : {"plan.toml", "quick.toml"})
        EXPECT_FALSE(read_stability_plan(fs::path(SOFTGRAIN_SOURCE) / "bench/stability" / name).maps.empty());
}

TEST(StabilityTables, CountWhatFailsAndSayWhere) {
    MapPlan plan;
    plan.name = "m";
    plan.method = "sdem";
    plan.damping = {"d"};
    StabilityResults results;
    results.map = {{.plan = &plan, .cell = {0.9, 0.3, 1.5, 1.0, "d"}, .largest = 0.4, .safety = 0.8},
                   {.plan = &plan, .cell = {0.8, 0.3, 1.5, 1.0, "d"}, .largest = 2.0, .safety = 0.8},
                   {.plan = &plan, .cell = {0.7, 0.3, 1.5, 1.0, "d"}, .not_measured = "refused"}};
    results.random = {{1, "sdem", 2, {.ending = Ending::crashed, .exit_code = -1, .reason = "signal 11"}},
                      {2, "sdem", 0, {.ending = Ending::diverged, .exit_code = 3, .reason = "why\nnot"}}};
    EXPECT_EQ(failures_of(results), 1U);
    const std::string text = stability_markdown(results);
    for (const char* said : {"over 2 scenes: **0.50** (m: phi 0.9", "unstable in 1 of them",
                             "a factor 2 in 1.", "the reader refused 2 others"})
        EXPECT_NE(text.find(said), std::string::npos) << said << "\n" << text;
    EXPECT_NE(map_csv(results.map).find(",,,,\"refused\"\n"), std::string::npos) << map_csv(results.map);
    EXPECT_NE(random_csv(results.random).find("diverged,3,0,0,\"why not\"\n"), std::string::npos)
        << random_csv(results.random);
}

/// It used to end with "0 steps, ... results in FOLDER", where nothing was.
TEST_F(Folder, AMethodThatRefusesSaysSoInOneLine) {
    std::ofstream(folder / "s.toml") << "[material]\ncohesion = 0.1\n[packing]\ncount = 3\n[[loading]]\n"
                                        "kind = \"hold\"\nduration = 1.0\n";
    const ChildEnd end = run_child({SOFTGRAIN_EXECUTABLE, "run", (folder / "s.toml").string(), "--method",
                                    "mpm", "--out", (folder / "out").string()},
                                   ChildOutput::read);
    EXPECT_EQ(end.exit_code, 2);
    EXPECT_TRUE(end.messages.starts_with("mpm: cannot run this scenario: material.cohesion")) << end.messages;
    EXPECT_EQ(end.messages.find('\n'), std::string::npos) << end.messages;
    EXPECT_FALSE(fs::exists(folder / "out"));
}

/// As its users run it.
TEST_F(Folder, AQuickBenchEndsWellAndIsNotReplaced) {
    const std::string command = "cd " SOFTGRAIN_SOURCE " && " SOFTGRAIN_EXECUTABLE
                                " bench stability --quick --out " +
                                (folder / "b").string() + " > " + (folder / "said").string() + " 2>&1";
    const auto exit_code = [&](const std::string& more) {
        const int status = std::system((command + more).c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    };
    std::ifstream said(folder / "said");
    EXPECT_EQ(exit_code(""), 0) << said.rdbuf();
    for (const char* name :
         {"map.csv", "long.csv", "extremes.csv", "random.csv", "stability.md", "map_rigid_dem.svg"})
        EXPECT_TRUE(fs::exists(folder / "b" / name)) << name;
    std::ifstream csv(folder / "b" / "random.csv");
    std::string line;
    std::getline(csv, line);
    EXPECT_TRUE(line.starts_with("# softgrain ")) << line;
    EXPECT_EQ(exit_code(""), 2) << "results are there";
}

}  // namespace
}  // namespace softgrain::bench
