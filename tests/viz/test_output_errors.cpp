#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "hand_made_grains.hpp"
#include "viz/render/run_reader.hpp"
#include "viz/render/vtk_errors.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

std::string output_error(const std::function<void()>& action) {
    try {
        action();
    } catch (const OutputError& error) {
        return error.what();
    }
    return "no OutputError";
}

TEST(OutputErrors, AFileInPlaceOfTheFolder) {
    const TemporaryFolder folder;
    std::ofstream(folder.path() / "run") << "a file";
    const HandMadeGrains grains(2, 0.1, 1.0);
    WallWriter writer(folder.path() / "run");
    const std::string text = output_error([&] { writer.observe(grains.view(), frame_sample(0)); });
    EXPECT_NE(text.find((folder.path() / "run").string()), std::string::npos) << text;
}

TEST(OutputErrors, AFolderThatCannotBeMade) {
    WallWriter writer("/proc/no-such-folder");
    const HandMadeGrains grains(2, 0.1, 1.0);
    EXPECT_NE(
        output_error([&] { writer.observe(grains.view(), frame_sample(0)); }).find("/proc/no-such-folder"),
        std::string::npos);
}

TEST(OutputErrors, AFolderRemovedWhileRunning) {
    const TemporaryFolder folder;
    const HandMadeGrains grains(2, 0.1, 1.0);
    WallWriter writer(folder.path());
    writer.observe(grains.view(), frame_sample(0));
    fs::remove_all(folder.path() / "walls");
    const std::string text = output_error([&] { writer.observe(grains.view(), frame_sample(1)); });
    EXPECT_NE(text.find("walls_000001.vtp: cannot create the file: No such file or directory"),
              std::string::npos)
        << text;
}

/// In a process of its own: no file may grow beyond `limit` bytes, as on a disk that is full.
[[noreturn]] void write_frames_within(const fs::path& run, rlim_t limit) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{limit, limit};
    ::setrlimit(RLIMIT_FSIZE, &small);
    const HandMadeGrains grains(6, 0.1, 1.0);
    GrainWriter writer(run, Need::all);
    const std::string text = output_error([&] {
        for (int k = 0; k < 100; ++k) writer.observe(grains.view(), frame_sample(k));
    });
    std::fprintf(stderr, "%s\n", text.c_str());
    const bool clean = !fs::exists(run / "grains/grains_000000.vtp.part");
    ::_exit(text != "no OutputError" && clean ? 7 : 1);
}

TEST(OutputErrorsDeathTest, AFullDiskIsAnErrorAndLeavesNoHalfFile) {
    const TemporaryFolder folder;
    EXPECT_EXIT(write_frames_within(folder.path(), 2000), testing::ExitedWithCode(7),
                "grains_000000.vtp: cannot write: File too large");
    EXPECT_FALSE(fs::exists(folder.path() / "grains/grains_000000.vtp"));
    EXPECT_FALSE(fs::exists(folder.path() / "grains.pvd"));
}

TEST(OutputErrors, AtomicWriteReplacesAndKeepsTheOldFileOnFailure) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "text";
    write_file_atomically(file, "one");
    write_file_atomically(file, "three");
    EXPECT_EQ(fs::file_size(file), 5U);
    fs::create_directory(folder.path() / "text.part");
    EXPECT_THROW(write_file_atomically(file, "four"), OutputError);
    EXPECT_EQ(fs::file_size(file), 5U);
}

class ReadingErrors : public testing::Test {
  protected:
    void SetUp() override {
        collect_vtk_errors();
        write_hand_made_run(folder.path(), 5, 2);
    }
    TemporaryFolder folder;
    fs::path frame = folder.path() / "grains/grains_000001.vtp";
};

TEST_F(ReadingErrors, GoodFilesAreRead) {
    EXPECT_EQ(read_vtp(frame)->GetNumberOfPolys(), 25);
    EXPECT_EQ(read_vtp(folder.path() / "walls/walls_000000.vtp")->GetNumberOfLines(), 4);
    const auto frames = read_pvd(folder.path() / "grains.pvd");
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[1].time, 20.0);
    EXPECT_EQ(frames[1].path, frame);
}

TEST_F(ReadingErrors, AFrameWithoutContactsIsNotAnError) {
    HandMadeGrains apart(3, 0.0, 0.0);
    apart.contacts.clear();
    ContactWriter(folder.path() / "apart").observe(apart.view(), frame_sample(0));
    const auto data = read_vtp(folder.path() / "apart/contacts/contacts_000000.vtp");
    EXPECT_EQ(data->GetNumberOfLines(), 0);
    EXPECT_EQ(data->GetNumberOfPoints(), 0);
}

TEST_F(ReadingErrors, ATruncatedFrameIsNamed) {
    const auto size = fs::file_size(frame);
    for (const auto shorter : {size - 12, size / 2, size / 8, static_cast<std::uintmax_t>(0)}) {
        fs::resize_file(frame, shorter);
        const std::string text = output_error([&] { read_vtp(frame); });
        EXPECT_NE(text.find("grains_000001.vtp: is cut short"), std::string::npos) << text;
    }
}

TEST_F(ReadingErrors, ADamagedFrameIsNamed) {
    const auto size = fs::file_size(frame);
    std::fstream file(frame, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(static_cast<std::streamoff>(size / 2));
    for (int k = 0; k < 400; ++k) file.put('\x5a');
    file.close();
    const std::string text = output_error([&] { read_vtp(frame); });
    EXPECT_NE(text.find("grains_000001.vtp: is damaged"), std::string::npos) << text;
}

TEST_F(ReadingErrors, AMissingFrameIsNamed) {
    fs::remove(frame);
    const RunReader run("a", folder.path());
    const std::string text = output_error([&] { run.read(1); });
    EXPECT_NE(text.find("grains_000001.vtp: cannot be read"), std::string::npos) << text;
}

TEST_F(ReadingErrors, AFolderWithoutRunIsBadInput) {
    EXPECT_THROW(RunReader("a", folder.path() / "nowhere"), InputError);
}

TEST_F(ReadingErrors, FramesAreChosenByFractionAndPackingFraction) {
    const RunReader run("a", folder.path());
    EXPECT_EQ(run.frame_at_fraction(0.0), 0U);
    EXPECT_EQ(run.frame_at_fraction(1.0), 1U);
    const double first = HandMadeGrains(5, 0.0, 0.0).packing_fraction();
    const double last = HandMadeGrains(5, 0.2, 0.0).packing_fraction();
    EXPECT_EQ(run.frame_at_packing_fraction(0.6 * first + 0.4 * last), 0U);
    EXPECT_EQ(run.frame_at_packing_fraction(0.4 * first + 0.6 * last), 1U);
    const Frame frame_read = run.read(1);
    EXPECT_EQ(frame_read.time, 20.0);
    EXPECT_DOUBLE_EQ(frame_read.packing_fraction, last);
    EXPECT_DOUBLE_EQ(frame_read.mean_stress, HandMadeGrains(5, 0.2, 0.0).mean_stress());
    fs::remove(folder.path() / "history.csv");
    EXPECT_THROW(RunReader("a", folder.path()).frame_at_packing_fraction(0.8), InputError);
}

}  // namespace
}  // namespace softgrain
