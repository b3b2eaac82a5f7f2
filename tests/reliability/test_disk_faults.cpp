// A disk that is full at any write, a folder that cannot be written or that is removed, two runs in one
// folder.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include <csignal>
#include <cstdint>

#include "tests/reliability/runs.hpp"

namespace softgrain {
namespace {

using namespace testing;

/// A disk of its own, seen by this process and its children only.
class SmallDisk {
  public:
    /// is_mounted() is false without the right to mount.
    SmallDisk(const fs::path& place, std::uintmax_t bytes) : place_(place) {
        fs::create_directories(place);
        mounted_ = ::unshare(CLONE_NEWNS) == 0 &&
                   ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                   ::mount("tmpfs", place.c_str(), "tmpfs", 0, size(bytes).c_str()) == 0;
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        if (mounted_) ::umount2(place_.c_str(), MNT_DETACH);
    }
    bool is_mounted() const { return mounted_; }
    void grow_to(std::uintmax_t bytes) const {
        ASSERT_EQ(::mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT, size(bytes).c_str()), 0);
    }
    void make_read_only() const {
        ASSERT_EQ(::mount("tmpfs", place_.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, nullptr), 0);
    }
    std::uintmax_t used() const {
        const fs::space_info space = fs::space(place_);
        return space.capacity - space.free;
    }

  private:
    static std::string size(std::uintmax_t bytes) { return "size=" + std::to_string(bytes); }

    fs::path place_;
    bool mounted_ = false;
};

constexpr std::uintmax_t roomy = std::uintmax_t{64} << 20U;

class DiskFaults : public ReliabilityTest {};

TEST_F(DiskFaults, AFullDiskAtAnyWriteIsSaidAndTheRunGoesOnWhenThereIsRoom) {
    const fs::path place = folder / "disk", out = place / "run", whole = folder / "whole";
    ASSERT_EQ(softgrain(run_of("rigid_dem", whole)).exit_code, 0);
    std::uintmax_t needed = 0;
    {
        const SmallDisk disk(place, roomy);
        if (!disk.is_mounted()) GTEST_SKIP() << "a small disk needs the right to mount (root)";
        ASSERT_EQ(softgrain(run_of("rigid_dem", out)).exit_code, 0);
        needed = disk.used();
    }
    constexpr std::uintmax_t tries = 12, page = 4096;
    int full = 0;
    for (std::uintmax_t k = 1; k <= tries; ++k) {
        const SmallDisk disk(place, std::max(page, needed * k / tries / page * page));
        const Outcome outcome = softgrain(run_of("rigid_dem", out));
        if (outcome.exit_code != 0) {
            ++full;
            EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
            EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
            EXPECT_NE(outcome.err.find("No space left on device; make room on the disk"), std::string::npos)
                << outcome.err;
            EXPECT_EQ(outcome.err.find(out.string()), 0U) << "no file is named: " << outcome.err;
        }
        disk.grow_to(roomy);
        const Outcome on = softgrain(run_of("rigid_dem", out, {"--resume"}));
        EXPECT_EQ(on.exit_code, 0) << on.err;
        EXPECT_TRUE(same_results(whole, out)) << k << " of " << tries << " of the room needed";
    }
    EXPECT_GE(full, static_cast<int>(tries) / 2) << "the disk was hardly ever full";
}

TEST_F(DiskFaults, AFolderThatCannotBeWritten) {
    const SmallDisk disk(folder / "disk", roomy);
    if (disk.is_mounted())
        disk.make_read_only();
    else
        fs::permissions(folder / "disk", fs::perms::owner_read | fs::perms::owner_exec);
    const Outcome outcome = softgrain(run_of("rigid_dem", folder / "disk" / "run"));
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_NE(outcome.err.find("choose a folder that can be written"), std::string::npos) << outcome.err;
}

TEST_F(DiskFaults, AFolderThatIsRemovedWhileTheRunGoesOn) {
    for (const std::string method : {"rigid_dem", "bpm"}) {
        const fs::path out = folder / "run";
        const pid_t child = start(run_of(method, out));
        wait_for_rows(out / "history.csv", 2);
        fs::rename(out, folder / "elsewhere");  // in one step, before the program makes another file in it
        const Outcome outcome = wait_for(child);
        EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
        EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("the folder was removed"), std::string::npos) << outcome.err;
        EXPECT_FALSE(fs::exists(out)) << "it was made again";
        fs::remove_all(folder / "elsewhere");
    }
}

TEST_F(DiskFaults, ASecondRunInTheSameFolderIsRefused) {
    const fs::path out = folder / "run";
    const pid_t first = start(run_of("rigid_dem", out));
    wait_for_rows(out / "history.csv", 2);
    const fs::path aside = folder / "second";
    fs::create_directories(aside);
    for (const std::string flag : {"--force", "--resume"}) {
        const Outcome second = softgrain(run_of("rigid_dem", out, {flag}));
        EXPECT_EQ(second.exit_code, 2) << second.err;
        EXPECT_NE(second.err.find("another run is writing into this folder"), std::string::npos)
            << second.err;
    }
    ::kill(first, SIGKILL);
    ASSERT_EQ(wait_for(first).exit_code, -SIGKILL) << "too fast, the test shows nothing";
    EXPECT_EQ(softgrain(run_of("rigid_dem", out, {"--resume"})).exit_code, 0) << "the lock outlived the run";
}

TEST_F(DiskFaults, AComparisonThatIsRefusedChangesNoFile) {
    const fs::path out = folder / "c";
    run_of("rigid_dem", out);  // writes the scenario
    const std::vector<std::string> command{"compare",   (folder / "rigid_dem.toml").string(),
                                           "--methods", "rigid_dem",
                                           "--out",     out.string(),
                                           "--quiet",   "--no-pictures",
                                           "--set",     "loading.0.strain_rate=1e-3"};
    ASSERT_EQ(softgrain(command).exit_code, 0);
    const std::string packing = content(out / "initial_packing.csv");
    auto other = command;
    other.insert(other.end(), {"--set", "random.seed=2"});
    EXPECT_EQ(softgrain(other).exit_code, 2);
    EXPECT_EQ(content(out / "initial_packing.csv"), packing);
}

}  // namespace
}  // namespace softgrain
