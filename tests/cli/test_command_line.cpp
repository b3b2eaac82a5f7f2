// The program as its users run it: exit codes, messages, files, stopping and going on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <csignal>

#include "common/io/history_csv.hpp"
#include "common/io/run_file.hpp"
#include "tests/support/program.hpp"

namespace softgrain {
namespace {

using namespace testing;

class CommandLine : public ProgramTest {
  protected:
    /// Six grains, a few seconds at most; `more` is added at the end.
    fs::path small_scenario(const std::string& rate = "2e-2", const std::string& more = "") const {
        return write("small.toml",
                     "title = \"small\"\n[packing]\nsize_law = \"single\"\ncount = 6\nradius_mean = 1.0\n"
                     "[[loading]]\nkind = \"isotropic\"\nuntil_strain = 0.02\nstrain_rate = " +
                         rate +
                         "\n[sampling]\nstrain_interval = 0.004\nframe_every = 2\n[bpm]\n"
                         "discs_per_grain = 30\n" +
                         more);
    }
};

TEST_F(CommandLine, HelpAndVersionAndList) {
    for (const std::string command : {"run", "compare", "fan", "calibrate", "validate", "list", "info"}) {
        const Outcome help = softgrain({command, "--help"});
        EXPECT_EQ(help.exit_code, 0) << command;
        EXPECT_NE(help.out.find("Example:"), std::string::npos) << command;
    }
    EXPECT_EQ(softgrain({"--version"}).out.rfind("softgrain ", 0), 0U);
    const Outcome list = softgrain({"list"});
    for (const char* word : {"sdem", "bpm", "rigid_dem", "energy_residual"})
        EXPECT_NE(list.out.find(word), std::string::npos) << word;
    EXPECT_NE(softgrain({"list", "--keys"}).out.find("youngs_modulus"), std::string::npos);
}

/// Methods without a cell are named and left out, the others go on; mixed grains, shear and its columns.
TEST_F(CommandLine, AShearedCellOfMixedGrains) {
    const fs::path cell = write("cell.toml",
                                "[packing]\nsize_law = \"single\"\ncount = 30\n[box]\nperiodic = true\n"
                                "[[grain_class]]\nname = \"soft\"\n[[grain_class]]\nname = \"stiff\"\n"
                                "youngs_modulus = 5\n"
                                "[[loading]]\nuntil_strain = 0.01\nstrain_rate = 2e-3\n"
                                "[[loading]]\nkind = \"shear\"\nuntil_shear = 0.04\nstrain_rate = 2e-3\n"
                                "[sampling]\nstrain_interval = 0.005\nframe_every = 3\n");
    const Outcome o = softgrain({"compare", cell.string(), "--methods", "bpm,rigid_dem", "--out",
                                 (folder / "c").string(), "--quiet", "--no-pictures"});
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_NE(o.err.find("box.periodic = true is not for bpm"), std::string::npos) << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
    const History h = read_history(folder / "c" / "rigid_dem" / "history.csv");
    ASSERT_EQ(h.rows(), 1U + 2U + 8U);
    EXPECT_NEAR(h.column("shear_strain").back(), 0.04, 1e-10);
    EXPECT_NEAR(h.column("axial_strain").back(), 0.01, 1e-10);
    EXPECT_GT(h.column("mean_stress").back(), 0.0);
    EXPECT_LT(h.column("stress_xy").back(), 0.0);
    EXPECT_NE(content(folder / "c" / "initial_packing.csv").find("box.periodic = true\nx,y,r,class\n"),
              std::string::npos);
    EXPECT_NE(content(folder / "c" / "rigid_dem" / "grains" / "grains_000000.vtp").find("grain_class"),
              std::string::npos);
    EXPECT_TRUE(fs::exists(folder / "c" / "rigid_dem" / "walls.pvd"));

    // The packing written there, read as a file, is the same packing.
    const fs::path again = write("again.toml", content(folder / "c" / "rigid_dem" / "scenario.toml"));
    const std::string comment = content(folder / "c" / "initial_packing.csv");
    const auto number_after = [&](const std::string& key) {
        const auto at = comment.find(key) + key.size();
        return comment.substr(at, comment.find_first_of(",\n", at) - at);
    };
    const Outcome from_file =
        softgrain({"run", again.string(), "--method", "rigid_dem", "--out", (folder / "f").string(),
                   "--quiet", "--set", "packing.path=" + (folder / "c" / "initial_packing.csv").string(),
                   "--set", "box.width=" + number_after("box.width = "), "--set",
                   "box.height=" + number_after("box.height = ")});
    ASSERT_EQ(from_file.exit_code, 0) << from_file.err;
    EXPECT_EQ(content(folder / "f" / "history.csv"), content(folder / "c" / "rigid_dem" / "history.csv"));
}

TEST_F(CommandLine, AStageThatTurnsOutToBeginBeyondItsEndIsBadInput) {
    const fs::path back = small_scenario("2e-2", "[[loading]]\nuntil_strain = 0.001\nstrain_rate = 1e-2\n");
    const Outcome known = softgrain({"validate", back.string()});
    EXPECT_EQ(known.exit_code, 2);
    EXPECT_NE(known.err.find("loading.1.until_strain must be above 0.02"), std::string::npos) << known.err;
    const Outcome o = softgrain({"run", back.string(), "--method", "rigid_dem", "--out",
                                 (folder / "b").string(), "--quiet", "--set", "loading.0.until_stress=1e-3"});
    EXPECT_EQ(o.exit_code, 2);
    EXPECT_NE(o.out.find("loading.1.until_strain = 0.001 is below the 0.0"), std::string::npos) << o.out;
    EXPECT_NE(content(folder / "b" / "run.json").find("\"exit_code\": 2"), std::string::npos);
}

TEST_F(CommandLine, BadInputIsExitTwoWithThePlace) {
    const fs::path bad = write("bad.toml",
                               "[material]\nyoungs_modulus = -1\npoison_ratio = 0.3\n[[loading]]\n"
                               "kind = \"isotropic\"\nstrain_rate = 1\nuntil_strain = 0.1\n");
    const Outcome validate = softgrain({"validate", bad.string()});
    EXPECT_EQ(validate.exit_code, 2);
    EXPECT_NE(validate.err.find("bad.toml:2:"), std::string::npos) << validate.err;
    EXPECT_NE(validate.err.find("bad.toml:3:1"), std::string::npos) << "all errors in one go\n"
                                                                    << validate.err;
    EXPECT_NE(validate.err.find("poisson_ratio"), std::string::npos) << "with a suggestion";
    EXPECT_EQ(softgrain({"validate", "nowhere.toml"}).exit_code, 2);
    EXPECT_EQ(softgrain({"run", small_scenario().string()}).exit_code, 2) << "--method and --out are missing";
    const Outcome method =
        softgrain({"run", small_scenario().string(), "--method", "fem", "--out", (folder / "x").string()});
    EXPECT_EQ(method.exit_code, 2);
    EXPECT_NE(method.err.find("sdem, bpm, rigid_dem"), std::string::npos);
    EXPECT_EQ(softgrain({"info", folder.string()}).exit_code, 2);
}

TEST_F(CommandLine, ARunLeavesItsFilesAndIsNotOverwritten) {
    for (const std::string method : {"sdem", "bpm", "rigid_dem"}) {
        const fs::path out = folder / method;
        const std::vector<std::string> command{
            "run", small_scenario().string(), "--method", method, "--out", out.string()};
        const Outcome run = softgrain(command);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        for (const char* name : {"history.csv", "run.h5", "run.json", "scenario.toml", "grains.pvd",
                                 "contacts.pvd", "walls.pvd"})
            EXPECT_TRUE(fs::exists(out / name)) << name;
        const History history = read_history(out / "history.csv");
        EXPECT_EQ(history.rows(), 6U);
        EXPECT_EQ(read_run_file(out / "run.h5").state.history.size(), 6U);
        EXPECT_EQ(softgrain({"validate", (out / "scenario.toml").string()}).exit_code, 0)
            << "the resolved scenario";
        EXPECT_EQ(softgrain({"info", out.string()}).exit_code, 0);

        const std::string before = content(out / "run.json");
        const Outcome again = softgrain(command);
        EXPECT_EQ(again.exit_code, 2);
        EXPECT_NE(again.err.find("--resume"), std::string::npos) << again.err;
        EXPECT_EQ(content(out / "run.json"), before);
        auto forced = command;
        forced.insert(forced.end(), {"--force", "--set", "sampling.contacts=false"});
        EXPECT_EQ(softgrain(forced).exit_code, 0);
        EXPECT_FALSE(fs::exists(out / "contacts.pvd")) << "those of the run before";
    }
}

/// Stopped by SIGTERM or SIGINT at some moment, gone on with --resume: the same bits as a run that was left
/// alone.
TEST_F(CommandLine, StoppedAndResumedEndsWithTheSameBits) {
    for (const std::string method : {"sdem", "bpm", "rigid_dem"}) {
        const std::string rate = method == "bpm"    ? "4e-4"
                                 : method == "sdem" ? "1e-6"
                                                    : "2e-7";  // about a second
        const std::vector<std::string> base{
            "run",      small_scenario(rate).string(),
            "--method", method,
            "--set",    "sampling.parts=true",
            "--set",    "sampling.measures=forces,chains,pair_correlation,tessellation"};
        const auto into = [&](const std::string& name, bool resume) {
            auto command = base;
            command.insert(command.end(), {"--out", (folder / name).string()});
            if (resume) command.emplace_back("--resume");
            return command;
        };
        const std::string straight = method + "_straight";
        const std::string broken = method + "_broken";
        ASSERT_EQ(softgrain(into(straight, false)).exit_code, 0);

        int stops = 0;
        for (const int signal : {SIGTERM, SIGINT}) {
            const pid_t child = start(into(broken, stops > 0));
            wait_for_rows(folder / broken / "history.csv", stops == 0 ? 2 : 4);
            ::kill(child, signal);
            const Outcome stopped = wait_for(child);
            if (stopped.exit_code == 0) break;  // it was done before the signal came
            ASSERT_EQ(stopped.exit_code, 128 + signal) << stopped.err;
            ++stops;
        }
        ASSERT_EQ(stops, 2) << method << ": too fast to be stopped, the test shows nothing";
        ASSERT_EQ(softgrain(into(broken, true)).exit_code, 0);

        EXPECT_EQ(content(folder / broken / "history.csv"), content(folder / straight / "history.csv"))
            << method;
        const RunFile a = read_run_file(folder / straight / "run.h5");
        const RunFile b = read_run_file(folder / broken / "run.h5");
        EXPECT_EQ(a.solver.numbers, b.solver.numbers) << method;
        EXPECT_EQ(a.solver.integers, b.solver.integers) << method;
        for (const char* series : {"grains", "contacts", "walls", "parts", "part_contacts", "measures"}) {
            const bool of_parts = std::string_view(series).starts_with("part");
            ASSERT_EQ(fs::exists(folder / straight / series), method == "bpm" || !of_parts)
                << "grains of " << method << " have no parts";
            if (!fs::exists(folder / straight / series)) continue;
            EXPECT_EQ(content(folder / broken / (std::string(series) + ".pvd")),
                      content(folder / straight / (std::string(series) + ".pvd")));
            for (const auto& frame : fs::directory_iterator(folder / straight / series))
                EXPECT_EQ(content(folder / broken / series / frame.path().filename()), content(frame.path()))
                    << frame.path();
        }
    }
}

TEST_F(CommandLine, ResumeOfAnotherScenarioIsRefused) {
    const fs::path scenario = small_scenario();
    const std::string out = (folder / "run").string();
    ASSERT_EQ(softgrain({"run", scenario.string(), "--method", "sdem", "--out", out}).exit_code, 0);
    const Outcome other = softgrain({"run", scenario.string(), "--method", "sdem", "--out", out, "--resume",
                                     "--set", "material.poisson_ratio=0.2"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("scenario"), std::string::npos);
}

/// Walls that close in faster than the grains can follow must not end in silence.
TEST_F(CommandLine, DivergenceIsExitThreeAndNamesTheGrain) {
    const fs::path scenario = small_scenario("500.0");
    const Outcome run = softgrain({"run", scenario.string(), "--method", "sdem", "--out",
                                   (folder / "d").string(), "--set", "loading.0.until_strain=0.9"});
    EXPECT_EQ(run.exit_code, 3) << run.out << run.err;
    EXPECT_NE((run.out + run.err).find("of grain "), std::string::npos) << run.out << run.err;
    std::string history = content(folder / "d" / "history.csv");
    const std::string not_given = ",nan,nan,nan,nan,";  // columns next to each other that SDEM does not give
    for (std::size_t at = 0; (at = history.find(not_given)) != std::string::npos;)
        history.erase(at, not_given.size() - 1);
    EXPECT_EQ(history.find("nan"), std::string::npos);
    EXPECT_NE(content(folder / "d" / "run.json").find("diverged"), std::string::npos);
}

TEST_F(CommandLine, AFolderThatCannotBeWrittenIsExitFour) {
    write("file", "not a folder");
    const Outcome run = softgrain(
        {"run", small_scenario().string(), "--method", "sdem", "--out", (folder / "file/x").string()});
    EXPECT_EQ(run.exit_code, 4) << run.err;
    EXPECT_NE(run.err.find("file/x"), std::string::npos);
}

TEST_F(CommandLine, CompareRunsEveryMethodFromOnePacking) {
    const std::string out = (folder / "comparison").string();
    const std::vector<std::string> command{"compare", small_scenario().string(), "--out", out,
                                           "--no-pictures"};
    const Outcome first = softgrain(command);
    ASSERT_EQ(first.exit_code, 0) << first.err;
    for (const char* word : {"| sdem", "| bpm", "| rigid_dem", "mean stress", "CPU time"})
        EXPECT_NE(first.out.find(word), std::string::npos) << word;
    std::vector<double> strain;
    for (const char* method : {"sdem", "bpm", "rigid_dem"}) {
        const History h = read_history(fs::path(out) / method / "history.csv");
        if (strain.empty()) strain = h.column("axial_strain");
        ASSERT_EQ(h.rows(), strain.size());
        for (std::size_t k = 0; k < strain.size(); ++k)
            EXPECT_NEAR(h.column("axial_strain")[k], strain[k], 1e-9);
    }
    EXPECT_TRUE(fs::exists(fs::path(out) / "stress.svg"));
    EXPECT_FALSE(fs::exists(fs::path(out) / "stress.png"));
    // Everything is there already: --resume only makes the table and the report again.
    const std::string report = content(fs::path(out) / "report.html");
    EXPECT_NE(report.find("Against mpm, "), std::string::npos);
    EXPECT_NE(report.find("Last common packing fraction"), std::string::npos);
    EXPECT_EQ(report.find("<img"), std::string::npos);
    fs::remove(fs::path(out) / "report.html");
    auto again = command;
    again.emplace_back("--resume");
    const Outcome second = softgrain(again);
    EXPECT_EQ(second.exit_code, 0);
    EXPECT_EQ(second.out, first.out);
    EXPECT_EQ(content(fs::path(out) / "report.html"), report);
    EXPECT_EQ(softgrain(command).exit_code, 2) << "results are not overwritten without --force";
}

TEST_F(CommandLine, AFailedRendererIsSaidInTheReport) {
    const fs::path out = folder / "comparison";
    ::setenv("SOFTGRAIN_RENDER_EXE", "/no/such/renderer", 1);
    const Outcome run =
        softgrain({"compare", small_scenario().string(), "--methods", "rigid_dem", "--out", out.string()});
    ::unsetenv("SOFTGRAIN_RENDER_EXE");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_NE(run.err.find("no picture: "), std::string::npos) << run.err;
    const std::string report = content(out / "report.html");
    EXPECT_NE(report.find("<p>No pictures: softgrain-render was not found"), std::string::npos);
    EXPECT_NE(report.find("no error is claimed"), std::string::npos);
}

TEST_F(CommandLine, AMethodThatCannotRunTheScenarioSaysSoAndTheOthersRun) {
    const fs::path out = folder / "plastic";
    const Outcome run =
        softgrain({"compare", small_scenario().string(), "--methods", "sdem,rigid_dem", "--out", out.string(),
                   "--no-pictures", "--set", "material.yield_stress=0.1"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.out.find("- rigid_dem: cannot run this scenario: "), std::string::npos) << run.out;
    EXPECT_NE(run.out.find("- sdem: loading done"), std::string::npos) << run.out;
    EXPECT_FALSE(fs::exists(out / "rigid_dem"));
    EXPECT_TRUE(fs::exists(out / "sdem" / "history.csv"));
    const std::string report = content(out / "report.html");
    EXPECT_NE(report.find("rigid_dem did not run"), std::string::npos);
    EXPECT_NE(report.find("material.yield_stress = 0.1 is not for rigid_dem"), std::string::npos);
    // For ParaView: the methods side by side, and each run alone.
    EXPECT_NE(content(out / "view.py").find("\nRUNS = [\"sdem\",\"rigid_dem\"] "), std::string::npos);
    EXPECT_NE(content(out / "sdem" / "view.py").find("\nRUNS = [\".\"] "), std::string::npos);
}

/// The number behind a word.
double number_after(const std::string& text, const std::string& word) {
    const auto at = text.find(word);
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + word.size()));
}

/// Small probes of a frictionless packing: an elastic response, the opposite for the opposite direction, all
/// from one state; a repeat with --resume changes nothing.
TEST_F(CommandLine, AFanOfProbesFromOneState) {
    const std::string text =
        "[packing]\ncount = 60\n[[loading]]\nkind = \"stress\"\npressure = 5e-3\ninertial_number = 1e-3\n"
        "until_unbalanced = 1e-4\n";
    const fs::path fan =
        write("fan.toml", text +
                              "[[loading]]\nkind = \"probe\"\nstress_amplitude = 5e-5\ndirection = 0\n"
                              "inertial_number = 1e-4\nuntil_unbalanced = 1e-4\n");
    const std::vector<std::string> command{
        "fan",     fan.string(),    "--methods",    "rigid_dem", "--out", (folder / "f").string(),
        "--quiet", "--no-pictures", "--directions", "4"};
    const Outcome o = softgrain(command);
    ASSERT_EQ(o.exit_code, 0) << o.err;
    const std::string response = content(folder / "f" / "response.csv");
    EXPECT_EQ(std::count(response.begin(), response.end(), '\n'), 5);
    const fs::path run = folder / "f" / "rigid_dem";
    const History state = read_history(run / "state" / "history.csv");
    const auto strain = [&](const std::string& probe) {
        const History h = read_history(run / probe / "history.csv");
        EXPECT_DOUBLE_EQ(h.column("strain_xx").front(), state.column("strain_xx").back());
        EXPECT_EQ(h.column("time").front(), state.column("time").back());
        return h.column("strain_xx").back() - h.column("strain_xx").front();
    };
    const double onward = strain("probe_000.0"), back = strain("probe_180.0"), across = strain("probe_090.0");
    EXPECT_GT(onward, 0.0);
    EXPECT_NEAR(back / onward, -1.0, 0.1);  // contacts that open or close: strains are not infinitely small
    EXPECT_LT(across, 0.0);                 // Poisson's effect

    std::vector<std::string> again = command;
    again.push_back("--resume");
    EXPECT_EQ(softgrain(again).exit_code, 0);
    EXPECT_EQ(content(folder / "f" / "response.csv"), response);

    const Outcome none = softgrain({"fan", write("none.toml", text).string(), "--methods", "rigid_dem",
                                    "--out", (folder / "n").string()});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_NE(none.err.find("kind = \"probe\""), std::string::npos) << none.err;
    std::vector<std::string> unknown = command;
    unknown[3] = "rigid_dem,rigid";
    unknown[5] = (folder / "u").string();
    EXPECT_EQ(softgrain(unknown).exit_code, 2);
    EXPECT_FALSE(fs::exists(folder / "u")) << "it had begun before it looked at all methods";
}

TEST_F(CommandLine, CalibrateFindsTheAttractionAndSaysHowWell) {
    const fs::path curve = folder / "curve.csv";
    const Outcome o = softgrain({"calibrate", small_scenario().string(), "--plateau", "0.05", "--seeds", "3",
                                 "--out", curve.string()});
    ASSERT_EQ(o.exit_code, 0) << o.err;
    const double stress = number_after(o.out, "attraction_stress = ");
    const double measured = number_after(o.out, "measured "), reached = number_after(o.out, "reached ");
    EXPECT_NEAR(stress * measured, 0.05, 1e-4);  // of printed digits
    // A single grain of 30 discs scatters by 20 %.
    EXPECT_NEAR(reached, 0.05, 0.02);
    EXPECT_NE(o.out.find("seeds 4 to 6"), std::string::npos) << o.out;
    const std::string csv = content(curve);
    EXPECT_NE(csv.find("strain,mean,seed_4,seed_5,seed_6\n0.0025,"), std::string::npos) << csv;
    EXPECT_GE(std::count(csv.begin(), csv.end(), '\n'), 60);

    const std::string file = small_scenario().string();
    for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
             {"calibrate", file},
             {"calibrate", file, "--plateau", "1", "--modulus", "1"},
             {"calibrate", file, "--plateau", "-1"},
             {"calibrate", file, "--plateau", "nan"},
             {"calibrate", file, "--modulus", "1", "--seeds", "1"},
             {"calibrate", file, "--plateau", "1", "--set", "bpm.discs_per_grain=3"}}) {
        const Outcome refused = softgrain(wrong);
        EXPECT_EQ(refused.exit_code, 2) << wrong.back();
        EXPECT_FALSE(refused.err.empty());
    }
}

TEST_F(CommandLine, CompareCanMatchTheYieldStress) {
    const std::string file = small_scenario().string();
    const std::string out = (folder / "matched").string();
    const std::vector<std::string> command{"compare",
                                           file,
                                           "--methods",
                                           "sdem,bpm",
                                           "--out",
                                           out,
                                           "--quiet",
                                           "--no-pictures",
                                           "--calibrate",
                                           "--set",
                                           "material.yield_stress=0.04"};
    const Outcome o = softgrain(command);
    ASSERT_EQ(o.exit_code, 0) << o.err;
    const double stress = number_after(o.out, "bpm.attraction_stress ");
    EXPECT_NE(o.out.find("= material.yield_stress, asked 0.04 N/m, reached "), std::string::npos) << o.out;
    EXPECT_NE(content(fs::path(out) / "comparison.md").find("- bpm.attraction_stress "), std::string::npos);
    // Each method's own scenario says what it ran with.
    const std::string bpm = content(fs::path(out) / "bpm" / "scenario.toml");
    EXPECT_NEAR(number_after(bpm, "\nattraction_stress = ") / stress, 1.0, 1e-3);
    EXPECT_NE(content(fs::path(out) / "sdem" / "scenario.toml").find("\nyield_stress = 0.04"),
              std::string::npos);

    auto given = command;
    given.back() = "bpm.attraction_stress=0.3";
    given.emplace_back("--force");
    EXPECT_NE(softgrain(given).err.find("leave one of them out"), std::string::npos);
    auto elastic = command;
    elastic.back() = "bpm.grain=elastic";
    elastic.emplace_back("--force");
    const Outcome refused = softgrain(elastic);
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_NE(refused.err.find("bpm.bond_stiffness with `softgrain calibrate --modulus`"), std::string::npos)
        << refused.err;
    auto without = command;
    without[3] = "sdem";
    EXPECT_EQ(softgrain(without).exit_code, 2);
}

}  // namespace
}  // namespace softgrain
