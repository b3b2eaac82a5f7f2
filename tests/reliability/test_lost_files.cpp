// Frames and measures that are removed or damaged after they were written.
#include <gtest/gtest.h>

#include <csignal>
#include <map>

#include "tests/reliability/runs.hpp"

namespace softgrain {
namespace {

using namespace testing;

class LostFiles : public ReliabilityTest {
  protected:
    /// Stopped in the middle, with frames that the checkpoint counts.
    void stop_in_the_middle(const fs::path& out) const {
        const pid_t child = start(run_of("bpm", out));
        wait_for_rows(out / "history.csv", 5);
        ::kill(child, SIGTERM);
        ASSERT_EQ(wait_for(child).exit_code, 128 + SIGTERM) << "too fast, the test shows nothing";
    }
    static void damage(const fs::path& path, const std::string& how) {
        ASSERT_TRUE(fs::exists(path)) << path;
        const auto size = fs::file_size(path);
        if (how == "removed") fs::remove(path);
        if (how == "emptied") fs::resize_file(path, 0);
        if (how == "cut") fs::resize_file(path, size - 20);
        if (how == "zeroed") std::ofstream(path, std::ios::binary) << std::string(size, '\0');
    }
};

TEST_F(LostFiles, AreSaidByResumeAndTheRestIsAsIfNothingHadBeen) {
    const fs::path whole = folder / "whole", stopped = folder / "stopped", out = folder / "out";
    ASSERT_EQ(softgrain(run_of("bpm", whole)).exit_code, 0);
    stop_in_the_middle(stopped);
    const std::map<std::string, std::string> said{{"removed", "missing"},
                                                  {"emptied", "empty"},
                                                  {"cut", "cut off or overwritten"},
                                                  {"zeroed", "cut off or overwritten"}};
    const std::vector<std::string> files{
        "grains/grains_000001.vtp",         "walls/walls_000000.vtp",
        "contacts/contacts_000001.vtp",     "parts/parts_000001.vtp",
        "measures/forces_000001.csv",       "measures/centres_000000.csv",
        "measures/tessellation_000001.csv", "part_contacts/part_contacts_000000.vtp"};
    for (const std::string& file : files)
        for (const auto& [how, what] : said) {
            if (file != files[0] && how != "cut") continue;
            SCOPED_TRACE(file + " " + how);
            fs::copy(stopped, out, fs::copy_options::recursive);
            damage(out / file, how);
            const Outcome outcome = softgrain(run_of("bpm", out, {"--resume"}));
            EXPECT_EQ(outcome.exit_code, 0);
            const std::string line =
                (out / file).string() + ": " + what +
                "; the run goes on without, start it anew with --force to have all files\n";
            EXPECT_EQ(outcome.err, line + "warning: " + line);
            EXPECT_EQ(softgrain({"info", out.string()}).err, "warning: " + line);
            fs::copy(whole / file, out / file, fs::copy_options::overwrite_existing);
            EXPECT_TRUE(same_results(whole, out));
            fs::remove_all(out);
        }
}

TEST_F(LostFiles, AWholeSeriesIsOneLine) {
    const fs::path out = folder / "out";
    stop_in_the_middle(out);
    fs::remove_all(out / "walls");
    const Outcome outcome = softgrain(run_of("bpm", out, {"--resume"}));
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(lines(outcome.err), 2) << outcome.err;
    EXPECT_NE(outcome.err.find("walls_000000.vtp: missing (and "), std::string::npos) << outcome.err;
}

/// Strains of a tessellation are those since the last frame.
TEST_F(LostFiles, CentresThatTheNextFrameRefersToAreNeeded) {
    const fs::path whole = folder / "whole", stopped = folder / "stopped", out = folder / "out";
    ASSERT_EQ(softgrain(run_of("bpm", whole)).exit_code, 0);
    stop_in_the_middle(stopped);
    const std::size_t frames = read_run_file(stopped / "run.h5").state.frame_times.size();
    const std::string last = "measures/centres_00000" + std::to_string(frames - 1) + ".csv";
    for (const std::string how : {"removed", "emptied", "cut", "zeroed", "a line less"}) {
        SCOPED_TRACE(how);
        fs::copy(stopped, out, fs::copy_options::recursive);
        damage(out / last, how);
        if (how == "a line less") {
            const std::string text = content(out / last);
            fs::resize_file(out / last, text.rfind('\n', text.size() - 2) + 1);
        }
        const Outcome outcome = softgrain(run_of("bpm", out, {"--resume"}));
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE((outcome.err + outcome.out).find((out / last).string()), std::string::npos)
            << outcome.out << outcome.err;
        fs::copy(whole / last, out / last, fs::copy_options::overwrite_existing);
        EXPECT_EQ(softgrain(run_of("bpm", out, {"--resume"})).exit_code, 0);
        EXPECT_TRUE(same_results(whole, out));
        fs::remove_all(out);
    }
}

}  // namespace
}  // namespace softgrain
