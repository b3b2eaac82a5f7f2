// Two checkpoints: every damage is recognised, and the older one is used.
#include <gtest/gtest.h>

#include <csignal>
#include <random>

#include "common/io/checkpoint_ring.hpp"
#include "common/observables/observable.hpp"
#include "tests/reliability/runs.hpp"

namespace softgrain {
namespace {

using namespace testing;

RunFile at_step(long long step) {
    RunFile file{"1.2.3", "sdem", "title = \"x\"\n", {}, {}, 0.0, 0.0};
    file.state.step = step;
    file.state.history = {std::vector<double>(observables().size(), 0.25)};
    file.state.state_hashes = {-7};
    file.state.watch.broken[2] = 3.0;
    file.solver.put("x", std::vector<double>(500, 1.0 / 3.0));
    return file;
}

void put(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

class CheckpointRing : public ReliabilityTest {
  protected:
    void SetUp() override {
        ReliabilityTest::SetUp();
        write_checkpoint(folder, at_step(1));
        write_checkpoint(folder, at_step(2));
        newest = content(folder / "run.h5");
    }
    std::string newest;
};

TEST_F(CheckpointRing, KeepsTheLastTwo) {
    EXPECT_EQ(read_checkpoint(folder).file.state.step, 2);
    EXPECT_EQ(read_checkpoint(folder).said, "");
    EXPECT_EQ(read_run_file(folder / "run_previous.h5").state.step, 1);
    write_checkpoint(folder, at_step(3));
    EXPECT_EQ(read_run_file(folder / "run_previous.h5").state.step, 2);
    EXPECT_EQ(read_checkpoint(folder).file.state.state_hashes, std::vector<std::int64_t>{-7});
    EXPECT_EQ(read_checkpoint(folder).file.state.watch.broken[2], 3.0);
    remove_checkpoints(folder);
    EXPECT_FALSE(has_checkpoint(folder));
    EXPECT_THROW(read_checkpoint(folder), InputError);
}

/// Any bit and any length: the head, HDF5's own structure, texts, numbers.
TEST_F(CheckpointRing, AnyDamageIsRecognisedAndTheOlderIsUsed) {
    std::mt19937 random(1);
    for (int k = 0; k < 400; ++k) {
        std::string damaged = newest;
        const std::size_t at = k < 150 ? static_cast<std::size_t>(k) : random() % newest.size();
        damaged[at] = static_cast<char>(damaged[at] ^ (1 << (random() % 8)));
        if (k % 10 == 9) damaged.resize(at);
        put(folder / "run.h5", damaged);
        const FoundCheckpoint found = read_checkpoint(folder);
        ASSERT_EQ(found.file.state.step, 1) << "a bit of byte " << at << " went unnoticed";
        ASSERT_NE(found.said.find("run.h5: damaged"), std::string::npos) << found.said;
    }
}

TEST_F(CheckpointRing, ADamagedOneDoesNotPushTheOlderOut) {
    put(folder / "run.h5", newest.substr(0, 700));
    put_damaged_checkpoint_aside(folder);
    EXPECT_TRUE(fs::exists(folder / "run_damaged.h5"));
    EXPECT_EQ(read_checkpoint(folder).file.state.step, 1) << "as after a kill between two renames";
    write_checkpoint(folder, at_step(4));
    EXPECT_EQ(read_run_file(folder / "run_previous.h5").state.step, 1);
    EXPECT_EQ(read_checkpoint(folder).file.state.step, 4);
}

TEST_F(CheckpointRing, BothDamagedIsOneClearLine) {
    for (const char* name : {"run.h5", "run_previous.h5"})
        put(folder / name, newest.substr(0, newest.size() - 1));
    try {
        read_checkpoint(folder);
        FAIL() << "read a damaged file";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("no checkpoint is left to go on from, start anew with --force"),
                  std::string::npos)
            << text;
        EXPECT_EQ(text.find('\n'), std::string::npos);
    }
}

TEST_F(CheckpointRing, AnotherFormatIsRefusedAndNotTakenForDamage) {
    put(folder / "run.h5", newest.substr(512));  // without the head, as format 1 was
    try {
        read_checkpoint(folder);
        FAIL() << "read another format";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("is of format 1, this program knows 2"), std::string::npos)
            << error.what();
    }
}

/// As a user sees it: the newest checkpoint of a stopped run is damaged, and --resume ends with the same
/// bits.
TEST_F(CheckpointRing, ARunGoesOnFromTheOlderOneWithTheSameBits) {
    for (const std::string method : {"sdem", "bpm", "rigid_dem", "mpm"}) {
        const fs::path whole = folder / (method + "_whole"), out = folder / method;
        ASSERT_EQ(softgrain(run_of(method, whole)).exit_code, 0);
        const pid_t child = start(run_of(method, out));
        wait_for_rows(out / "history.csv", 4);
        for (int k = 0; k < 1000 && !fs::exists(out / "run_previous.h5"); ++k)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        ::kill(child, SIGKILL);
        ASSERT_EQ(wait_for(child).exit_code, -SIGKILL) << "too fast, the test shows nothing";
        ASSERT_TRUE(fs::exists(out / "run_previous.h5"));
        std::string bytes = content(out / "run.h5");
        bytes[bytes.size() / 2] = static_cast<char>(~bytes[bytes.size() / 2]);
        put(out / "run.h5", bytes);
        const Outcome outcome = softgrain(run_of(method, out, {"--resume"}));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find("run.h5: damaged"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("going on from run_previous.h5, step "), std::string::npos) << outcome.err;
        fs::remove(out / "run_damaged.h5");
        EXPECT_TRUE(same_results(whole, out)) << method;

        for (const char* name : {"run.h5", "run_previous.h5"}) put(out / name, "nothing");
        const Outcome refused = softgrain(run_of(method, out, {"--resume"}));
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
}

}  // namespace
}  // namespace softgrain
