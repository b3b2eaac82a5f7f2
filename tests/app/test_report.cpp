// The report of a comparison: errors, words, tables, and that no text gets into the page as markup.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "app/methods.hpp"
#include "app/report/curve_error.hpp"
#include "app/report/curves.hpp"
#include "app/report/energy.hpp"
#include "app/report/force_plots.hpp"
#include "app/report/html.hpp"
#include "app/report/limits.hpp"
#include "app/report/page.hpp"
#include "app/report/pictures.hpp"
#include "app/report/tables.hpp"
#include "app/report/verdict.hpp"
#include "app/report/words.hpp"
#include "common/packing/make_packing.hpp"

namespace softgrain::report {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A run with stress = factor * (phi - 0.8), Z = 4, of 100 J of work.
MethodResult run(const std::string& method, double factor, double last_phi, double cpu_time) {
    MethodResult result;
    result.report.method = method;
    result.report.ended = "loading done";
    result.report.grains = 20;
    result.report.steps = 12345;
    result.report.cpu_time = result.report.wall_time = cpu_time;
    result.report.finished = "2024-05-01 12:00 UTC";
    result.history.emplace();
    const int samples = 20;
    for (int k = 0; k <= samples; ++k) {
        const double share = static_cast<double>(k) / samples, phi = 0.8 + (last_phi - 0.8) * share;
        for (const auto& [name, value] : std::map<std::string, double>{{"time", share},
                                                                       {"packing_fraction", phi},
                                                                       {"mean_stress", factor * (phi - 0.8)},
                                                                       {"deviatoric_stress", 0.0},
                                                                       {"coordination_number", 4.0},
                                                                       {"external_work", 100.0 * share},
                                                                       {"elastic_energy", 60.0 * share},
                                                                       {"kinetic_energy", 1.0 * share},
                                                                       {"dissipated_energy", 38.0 * share},
                                                                       {"plastic_energy", 30.0 * share},
                                                                       {"energy_residual", 1.0 * share},
                                                                       {"fragments", std::nan("")},
                                                                       {"unconverged_steps", 0.0}})
            result.history->columns[name].push_back(value);
    }
    return result;
}

Scenario small_scenario(const std::string& more = "") {
    const fs::path file =
        fs::path(::testing::TempDir()) / ("softgrain_report_" + std::to_string(::getpid()) + ".toml");
    std::ofstream(file) << "title = \"<script>alert(1)</script> & \\\"more\\\"\"\n[packing]\nsize_law = "
                           "\"single\"\ncount = 4\n"
                           "[[loading]]\nuntil_strain = 0.02\nstrain_rate = 2e-2\n"
                        << more;
    const Scenario scenario = read_scenario(file, {}, method_keys());
    fs::remove(file);
    return scenario;
}

TEST(CurveErrors, AreRelativeL2OverTheCommonRange) {
    const MethodResult a = run("sdem", 1.1, 0.9, 1.0), truth = run("mpm", 1.0, 1.0, 9.0);
    const auto error = curve_error(*a.history, *truth.history);
    ASSERT_TRUE(error);
    EXPECT_NEAR(error->stress, 0.1, 1e-9);  // ten per cent everywhere
    EXPECT_NEAR(*error->coordination, 0.0, 1e-12);
    EXPECT_NEAR(error->share, 0.5, 1e-9);
    EXPECT_DOUBLE_EQ(error->over.high, 0.9);
    EXPECT_NEAR(error->worst_at, 0.9, 1e-9);
    EXPECT_NEAR(error->worst, 0.1, 1e-9);
    EXPECT_FALSE(curve_error(*run("sdem", 1.0, 0.8005, 1.0).history, *truth.history)) << "hardly a range";
    MethodResult broken = a;
    broken.history->columns["mean_stress"][7] = std::nan("");
    EXPECT_FALSE(curve_error(*broken.history, *truth.history));
    broken = a;
    broken.history->columns.erase("coordination_number");
    EXPECT_FALSE(curve_error(*broken.history, *truth.history)->coordination);
}

TEST(CurveErrors, TheGivenReferenceComesBeforeMpm) {
    const std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0), run("mpm", 1.0, 0.9, 1.0)};
    EXPECT_EQ(find_truth(results, std::nullopt)->run, &results[1]);
    const std::optional<Reference> given{{"given", *results[0].history}};
    EXPECT_EQ(find_truth(results, given)->name, "given");
    EXPECT_EQ(find_truth(results, given)->run, nullptr);
    EXPECT_FALSE(find_truth({results[0]}, std::nullopt));
}

TEST(Verdict, NamesTheNearestItsPriceAndWhatFailed) {
    std::vector<MethodResult> results{run("sdem", 0.9, 1.0, 1.0), run("rigid_dem", 1.01, 0.85, 0.5),
                                      run("bpm", 2.0, 1.0, 4.0), run("mpm", 1.0, 1.0, 10.0)};
    results[1].report.ended = "left its range of validity: too deep";
    results[2].history->columns["energy_residual"].back() = -5.0;
    const auto said = verdict(results, find_truth(results, std::nullopt));
    EXPECT_EQ(said[0],
              "Against mpm, the resolved method among those compared and therefore the reference, sdem is "
              "nearest: its mean "
              "stress differs by 10 % (relative L2) over packing fractions 0.800 to 1.000, most at 1.000, "
              "where it is 10 % "
              "lower; bpm differs by 100 % and rigid_dem by 1.0 % over 25 % of the range only.");
    EXPECT_EQ(said[1],
              "sdem took 1.00 s of CPU time, 10 times less than mpm (10.0 s) and 2.0 times more than "
              "rigid_dem (the "
              "cheapest, 0.50 s).");
    EXPECT_EQ(said[2],
              "sdem, bpm and mpm did the whole loading; rigid_dem ended at packing fraction 0.850 (left its "
              "range of "
              "validity: too deep); the energy residual of the work is \u22125.0 % of bpm, more than 2 %.");
}

TEST(Verdict, ClaimsNoErrorWithoutAReference) {
    const std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0), run("bpm", 2.0, 0.9, 4.0)};
    const auto said = verdict(results, std::nullopt);
    EXPECT_TRUE(has(said[0], "no error is claimed")) << said[0];
    EXPECT_TRUE(has(said[0], "between 0.1 N/m (sdem) and 0.2 N/m (bpm)")) << said[0];
    EXPECT_FALSE(has(said[0], "%")) << said[0];
    EXPECT_EQ(said[1],
              "sdem took 1.00 s of CPU time, 4.0 times less than bpm (the most expensive, 4.00 s); nothing "
              "was cheaper.");
    EXPECT_EQ(said[2], "All 2 methods did the whole loading.");
}

TEST(Verdict, OfMethodsThatDidNotRun) {
    MethodResult refused;
    refused.report.method = "bpm";
    refused.report.exit_code = 2;
    refused.report.ended = "cannot run this scenario: no";
    const auto said = verdict({refused}, std::nullopt);
    EXPECT_EQ(said[1], "No method made a step.");
    EXPECT_EQ(said[2], "bpm did not run (cannot run this scenario: no).");
}

TEST(ReportTables, ShowErrorsCostAndFlags) {
    std::vector<MethodResult> results{run("sdem", 1.1, 1.0, 1.0), run("mpm", 1.0, 1.0, 10.0)};
    results[0].report.ended = "diverged <at> 5";
    results[0].report.exit_code = 3;
    const std::string text = methods_table(results, find_truth(results, std::nullopt));
    EXPECT_TRUE(has(text, "CPU time / mpm"));
    EXPECT_TRUE(has(text, "<td class=\"number\">10 %</td><td class=\"number\">0 %</td>")) << text;
    EXPECT_TRUE(has(text, "<td class=\"number\">0.10</td>")) << text;
    EXPECT_TRUE(has(text, "12\u202f345")) << text;
    EXPECT_TRUE(has(text, "<strong class=\"flag\">! diverged &lt;at&gt; 5</strong>")) << text;
    EXPECT_FALSE(has(methods_table(results, std::nullopt), "error of stress"));
}

TEST(ReportTables, EnergyIsSharesOfTheWork) {
    std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0), run("bpm", 1.0, 0.9, 1.0)};
    const auto energy = energy_shares(*results[0].history);
    ASSERT_TRUE(energy);
    EXPECT_NEAR(energy->elastic + energy->kinetic + energy->dissipated + energy->residual, 1.0, 1e-12);
    EXPECT_FALSE(energy->is_flagged());
    EXPECT_FALSE(has(energy_table(results), "class=\"flag\""));
    results[1].history->columns["energy_residual"].back() = 3.0;
    EXPECT_TRUE(has(energy_table(results), "<strong class=\"flag\">! 3.0 %</strong>"));
    results[1].history->columns["external_work"].assign(21, 0.0);
    EXPECT_FALSE(energy_shares(*results[1].history));
}

TEST(ReportWords, AreShortAndTrue) {
    EXPECT_EQ(percent(0.01234), "1.2 %");
    EXPECT_EQ(percent(-0.0004), "\u22120.04 %");
    EXPECT_EQ(percent(1e-7), "0 %");
    EXPECT_EQ(percent(1.5), "150 %");
    EXPECT_EQ(percent(std::nan("")), no_number);
    EXPECT_EQ(whole(999), "999");
    EXPECT_EQ(whole(1234567), "1\u202f234\u202f567");
    EXPECT_EQ(times_less(2.0, 24.0), "12 times less than");
    EXPECT_EQ(times_less(24.0, 2.0), "12 times more than");
    EXPECT_EQ(times_less(2.0, 2.1), "about the same as");
    EXPECT_EQ(listed({"a", "b", "c"}), "a, b and c");
    EXPECT_EQ(base64("Man"), "TWFu");
    EXPECT_EQ(base64("Ma"), "TWE=");
    EXPECT_EQ(base64(std::string("\xff\x00", 2)), "/wA=");
}

TEST(Limits, EveryRefusedFeatureIsNamed) {
    const Scenario scenario = small_scenario("[material]\nyield_stress = 0.1\ncohesion = 0.01\n");
    const Packing packing = make_packing(scenario);
    MethodResult refused;
    refused.report.method = "bpm";
    refused.report.exit_code = 2;
    const auto lines = limits(refused, scenario, packing);
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    const Method& bpm = find_method("bpm");
    EXPECT_EQ(lines.size(),
              static_cast<std::size_t>(std::ranges::count_if(bpm.refusals,
                                                             [](const Refusal& r) {
                                                                 return r.feature == Feature::yield_stress ||
                                                                        r.feature == Feature::cohesion;
                                                             })))
        << all;
    EXPECT_TRUE(has(all, "is not for bpm")) << all;
    const auto of_run = limits(run("sdem", 1.0, 0.9, 1.0), small_scenario(), packing);
    ASSERT_EQ(of_run.size(), 1U);
    EXPECT_EQ(of_run[0], "Columns of the history without a number: fragments.");
}

TEST(Curves, TheReferenceIsDashedWithItsBand) {
    const std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0)};
    std::optional<Reference> reference{{"fine", *run("", 1.1, 0.9, 1.0).history}};
    reference->history.columns["mean_stress_error"].assign(21, 0.01);
    const PlotSpec plot = curve_plot("t", results, reference, "mean_stress", "y", true);
    ASSERT_EQ(plot.series.size(), 2U);
    EXPECT_TRUE(plot.series[0].upper.empty());
    EXPECT_EQ(plot.series[1].line, LineStyle::dashed);
    EXPECT_NEAR(plot.series[1].upper[20], 0.11 + 0.01, 1e-12);
    EXPECT_NEAR(plot.series[1].lower[20], 0.11 - 0.01, 1e-12);
    EXPECT_FALSE(has_deviatoric_stress(results));
    EXPECT_TRUE(std::isnan(plot.series[1].upper[0])) << "no band where there is no curve";
}

TEST(Curves, AreOverShearWhereThePackingFractionHardlyChanges) {
    std::vector<MethodResult> results{run("sdem", 1.0, 0.81, 1.0)};
    for (int k = 0; k <= 20; ++k) {
        results[0].history->columns["axial_strain"].push_back(0.0);
        results[0].history->columns["shear_strain"].push_back(0.01 * k);
    }
    const PlotSpec sheared = curve_plot("t", results, std::nullopt, "mean_stress", "y", false);
    EXPECT_EQ(sheared.x.label, "shear strain");
    EXPECT_NEAR(sheared.series[0].x[20], 0.2, 1e-12);
    const PlotSpec compacted =
        curve_plot("t", {run("sdem", 1.0, 0.9, 1.0)}, std::nullopt, "mean_stress", "y", false);
    EXPECT_EQ(compacted.x.label, "packing fraction");
}

TEST(Forces, TheNearestFrameIsReadAndItsBinsKeepTheirSum) {
    const fs::path folder =
        fs::path(::testing::TempDir()) / ("softgrain_forces_" + std::to_string(::getpid()));
    const fs::path measures = folder / "sdem/measures";
    fs::create_directories(measures);
    std::ofstream(measures / "forces_000000.csv") << "# time 0 s\nforce_over_mean,probability_density\n";
    std::ofstream(measures / "forces_000001.csv")
        << "# time 0.5 s\nforce_over_mean,probability_density\n0.05,10\n";
    std::ofstream(measures / "forces_000002.csv")
        << "# time 1 "
           "s\nforce_over_mean,probability_density\n0.05,4\n0.15,0\n0.25,0\n0.35,0\n0.45,0\n0.55,6\n";
    const MethodResult result = run("sdem", 1.0, 0.9, 1.0);
    const auto frame = force_frame(result, folder, 1.0);
    ASSERT_TRUE(frame);
    EXPECT_DOUBLE_EQ(frame->packing_fraction, 0.9);
    ASSERT_EQ(frame->density.size(), 2U);  // five fine bins in one: 40 contacts
    EXPECT_NEAR(frame->density[0], 4.0 / 5.0, 1e-12);
    EXPECT_NEAR(frame->density[1], 6.0 / 5.0, 1e-12);
    EXPECT_NEAR(frame->force[1], 0.75, 1e-12);
    EXPECT_NEAR(force_frame(result, folder, 0.0)->packing_fraction, 0.85, 1e-12) << "the first has no forces";
    EXPECT_FALSE(force_frame(run("bpm", 1.0, 0.9, 1.0), folder, 0.9));
    fs::remove_all(folder);
}

/// In place of softgrain-render: writes as many bytes as a picture is wide, for two methods and nine stages.
constexpr const char* counting_renderer = R"sh(#!/bin/sh
while [ $# -gt 0 ]; do
    case $1 in --out) out=$2 ;; --width) width=$2 ;; esac
    shift
done
mkdir -p "$out"
for method in sdem bpm; do for stage in 1 2 3 4 5 6 7 8 9; do
    head -c "$width" /dev/zero >"$out/${method}_$stage.png"
done; done
)sh";

TEST(Pictures, AreDrawnSmallerThenFewerUntilTheyFit) {
    const fs::path folder = fs::path(testing::TempDir()) / fmt::format("pictures_{}", getpid());
    fs::create_directories(folder);
    const fs::path renderer = folder / "renderer.sh";
    std::ofstream(renderer) << counting_renderer;
    fs::permissions(renderer, fs::perms::owner_all);
    setenv("SOFTGRAIN_RENDER_EXE", renderer.c_str(), 1);
    const std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0), run("bpm", 1.0, 0.85, 1.0)};
    struct Expected {
        std::size_t most_bytes, stages, width;
    };
    for (const auto& [most_bytes, stages, width] :
         {Expected{2 * 7 * 720, 7, 720}, Expected{2 * 7 * 720 - 1, 7, 480}, Expected{2 * 7 * 480 - 1, 4, 480},
          Expected{2 * 4 * 480 - 1, 2, 400}, Expected{1, 2, 400}}) {
        const Pictures pictures = draw_pictures(results, folder, false, most_bytes);
        EXPECT_EQ(pictures.failure, "");
        ASSERT_EQ(pictures.stages.size(), stages) << most_bytes;
        for (const PictureStage& stage : pictures.stages)
            for (const std::string& png : stage.png) EXPECT_EQ(png.size(), width) << most_bytes;
        EXPECT_EQ(pictures.stages.back().note[0], "");
        EXPECT_EQ(pictures.stages.back().note[1], "ended at packing fraction 0.850; its last frame");
    }
    std::ofstream(renderer) << "#!/bin/sh\necho no display >&2\nexit 4\n";
    EXPECT_TRUE(has(draw_pictures(results, folder, false, 1).failure, "no display"));
    unsetenv("SOFTGRAIN_RENDER_EXE");
    fs::remove_all(folder);
}

TEST(Page, EscapesItsTextsAndSaysWhyThereAreNoPictures) {
    const Scenario scenario = small_scenario();
    const Packing packing = make_packing(scenario);
    const std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0)};
    const std::optional<Reference> reference{{"<b>", *results[0].history}};
    PageContent content{
        scenario, packing, "/none", results, reference, {"a <note>"}, Pictures{{}, "no <display>"}};
    const std::string text = page(content);
    EXPECT_FALSE(has(text, "<script>alert"));
    EXPECT_TRUE(has(text, "<h1>&lt;script&gt;alert(1)&lt;/script&gt; &amp; &quot;more&quot;</h1>"));
    EXPECT_TRUE(has(text, "a &lt;note&gt;"));
    EXPECT_TRUE(has(text, "&lt;b&gt;"));
    EXPECT_FALSE(has(text, "<b>"));
    EXPECT_TRUE(has(text, "No pictures: no &lt;display&gt;"));
    for (const char* outside : {"src=\"http", "href=", "@import", "url("})
        EXPECT_FALSE(has(text, outside)) << outside;
    content.pictures.reset();
    EXPECT_FALSE(has(page(content), "No pictures"));
}

TEST(Page, TellsTheRateOfAMethodWhereTheScenarioNamesNone) {
    Scenario scenario = small_scenario();
    const Packing packing = make_packing(scenario);
    const std::vector<MethodResult> results{run("sdem", 1.0, 0.9, 1.0)};
    const auto text = [&] { return page({scenario, packing, "/none", results, {}, {}, {}}); };
    EXPECT_FALSE(has(text(), "sdem: inertial number 0.01"));
    scenario.loading[0].strain_rate.reset();
    scenario.loading[0].inertial_number.reset();
    EXPECT_TRUE(has(text(), "sdem: inertial number 0.01"));
}

}  // namespace
}  // namespace softgrain::report
