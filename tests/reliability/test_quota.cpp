// A quota that is reached at any write: that of a btrfs of the test's own, which binds root too.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>

#include <cstdint>
#include <cstdlib>
#include <set>

#include "tests/reliability/runs.hpp"

namespace softgrain {
namespace {

using namespace testing;

/// Seen by this process and its children only.
class DiskWithQuota {
  public:
    /// is_mounted() is false without the right to mount, a loop device or btrfs-progs.
    DiskWithQuota(const fs::path& image, fs::path place) : place_(std::move(place)) {
        fs::create_directories(place_);
        const std::string disk = "'" + image.string() + "'", at = "'" + place_.string() + "'";
        mounted_ = ::unshare(CLONE_NEWNS) == 0 &&
                   ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                   done("truncate -s 256M " + disk + " && mkfs.btrfs -q " + disk + " && mount -o loop " +
                        disk + " " + at);
        has_quota_ = mounted_ && done("btrfs quota enable " + at + " && btrfs quota rescan -w " + at);
    }
    DiskWithQuota(const DiskWithQuota&) = delete;
    DiskWithQuota& operator=(const DiskWithQuota&) = delete;
    ~DiskWithQuota() {
        if (mounted_) ::umount2(place_.c_str(), 0);
    }
    bool has_quota() const { return has_quota_; }
    /// A number of bytes, or "none".
    void limit_to(const std::string& bytes) const {
        ASSERT_TRUE(done("sync -f '" + place_.string() + "' && btrfs qgroup limit " + bytes + " '" +
                         place_.string() + "'"));
    }

  private:
    static bool done(const std::string& commands) {
        return std::system(("(" + commands + ") >/dev/null 2>&1").c_str()) == 0;
    }

    fs::path place_;
    bool mounted_ = false, has_quota_ = false;
};

class Quota : public ReliabilityTest {};

TEST_F(Quota, ReachedAtAnyWriteIsSaidAndTheRunGoesOnWithinIt) {
    const fs::path place = folder / "disk", out = place / "run", whole = folder / "whole";
    ASSERT_EQ(softgrain(run_of("rigid_dem", whole)).exit_code, 0);
    std::uintmax_t needed = 0;
    for (const auto& entry : fs::recursive_directory_iterator(whole))
        if (entry.is_regular_file()) needed += entry.file_size();
    const DiskWithQuota disk(folder / "image", place);
    if (!disk.has_quota()) GTEST_SKIP() << "needs the right to mount (root), a loop device and btrfs-progs";
    // The file system takes more than the bytes of the files: the last tries have room enough.
    constexpr std::uintmax_t tries = 12, enough = 6;
    int reached = 0;
    std::set<std::string> files;
    for (std::uintmax_t k = 1; k <= tries; ++k) {
        disk.limit_to(std::to_string(needed * k / enough));
        const Outcome outcome = softgrain(run_of("rigid_dem", out));
        if (outcome.exit_code != 0) {
            ++reached;
            EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
            EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
            EXPECT_NE(outcome.err.find("Disk quota exceeded; make room within your quota"), std::string::npos)
                << outcome.err;
            EXPECT_EQ(outcome.err.find(out.string()), 0U) << "no file is named: " << outcome.err;
            files.insert(outcome.err.substr(0, outcome.err.find(": ")));
        }
        disk.limit_to("none");
        const Outcome on = softgrain(run_of("rigid_dem", out, {"--resume"}));
        EXPECT_EQ(on.exit_code, 0) << on.err;
        EXPECT_TRUE(same_results(whole, out)) << k << " of " << enough << " of the bytes of its files";
        fs::remove_all(out);
    }
    std::printf("the quota was reached in %d of %d runs, at %zu different files\n", reached,
                static_cast<int>(tries), files.size());
    EXPECT_GE(reached, static_cast<int>(tries) / 3) << "the quota was hardly ever reached";
}

}  // namespace
}  // namespace softgrain
