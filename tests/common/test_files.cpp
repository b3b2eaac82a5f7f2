#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/history_csv.hpp"
#include "common/io/run_file.hpp"
#include "common/observables/observable.hpp"

namespace softgrain {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_files_" + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
    fs::path folder;
};

RunFile example() {
    RunFile file{"1.2.3", "sdem", "title = \"x\"\n", {}, {}, 12.5, 20.25};
    file.state.step = 77;
    file.state.time = 0.1;
    file.state.rate = 1.0 / 3.0;
    file.state.box.position = {0.1, 0.9, -1.0, 1.0 / 3.0};
    file.state.frame_times = {0.0, 0.25};
    file.state.ended = "left its range";
    for (int r = 0; r < 3; ++r) {
        std::vector<double> row;
        for (std::size_t c = 0; c < observables().size(); ++c)
            row.push_back(r + static_cast<double>(c) / 7.0);
        file.state.history.push_back(row);
    }
    file.solver.put("x", std::vector<Vec2>{{1.0, 2.0}, {3.0, 1.0 / 3.0}});
    file.solver.put("ids", std::vector<int>{4, 5, 6});
    file.solver.put("empty", std::vector<double>{});
    return file;
}

TEST_F(Files, RunFileComesBackWithTheSameBits) {
    const RunFile written = example();
    write_run_file(folder / "run.h5", written);
    const RunFile read = read_run_file(folder / "run.h5");
    EXPECT_EQ(read.version, written.version);
    EXPECT_EQ(read.method, written.method);
    EXPECT_EQ(read.scenario, written.scenario);
    EXPECT_EQ(read.wall_time, written.wall_time);
    EXPECT_EQ(read.state.history, written.state.history);
    EXPECT_EQ(read.state.box.position, written.state.box.position);
    EXPECT_EQ(read.state.rate, written.state.rate);
    EXPECT_EQ(read.state.ended, written.state.ended);
    EXPECT_EQ(read.solver.numbers, written.solver.numbers);
    EXPECT_EQ(read.solver.integers, written.solver.integers);
}

TEST_F(Files, DamagedRunFileIsRefusedByName) {
    const fs::path path = folder / "run.h5";
    write_run_file(path, example());
    const auto size = fs::file_size(path);
    for (const double part : {0.3, 0.9}) {
        const fs::path cut = folder / "cut.h5";
        fs::copy_file(path, cut, fs::copy_options::overwrite_existing);
        fs::resize_file(cut, static_cast<std::uintmax_t>(part * static_cast<double>(size)));
        try {
            read_run_file(cut);
            FAIL() << "read a truncated file";
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("cut.h5"), std::string::npos);
        }
    }
    EXPECT_THROW(read_run_file(folder / "none.h5"), InputError);
}

TEST_F(Files, HistoryComesBackWithTheSameBits) {
    const RunFile content = example();
    const std::vector<std::vector<double>> first(content.state.history.begin(),
                                                 content.state.history.end() - 1);
    HistoryWriter writer(folder / "history.csv", first);
    Sample sample;
    sample.row = content.state.history.back();
    writer.observe({}, sample);
    const History history = read_history(folder / "history.csv");
    ASSERT_EQ(history.rows(), 3U);
    for (std::size_t c = 0; c < observables().size(); ++c)
        for (std::size_t r = 0; r < 3; ++r)
            EXPECT_EQ(history.column(observables()[c].name)[r], content.state.history[r][c]);
    EXPECT_THROW(history.column("nothing"), InputError);
}

/// Found by a soak: each reading kept 1.8 MB.
TEST_F(Files, ReadingACheckpointClosesItsFile) {
    const fs::path path = folder / "run.h5";
    write_run_file(path, example());
    const auto open_files = [] {
        return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
    };
    read_run_file(path);
    const auto before = open_files();
    for (int k = 0; k < 3; ++k) read_run_file(path);
    EXPECT_EQ(open_files(), before);
}

TEST_F(Files, BrokenHistoryNamesTheLine) {
    const std::vector<std::pair<std::string, std::string>> cases{
        {"# comment\na,b\n1,2\n3,x\n", "h.csv:4: 'x' is not a number"},
        {"a,b\n1,2,3\n", "h.csv:2: 3 values, expected 2"},
        {"# comment\na,b,a\n1,2,3\n", "h.csv:2: two columns are named 'a'"},
        {"a,,b\n1,2,3\n", "h.csv:1: a column has no name"},
        {"# comment\n", "h.csv:2: expected a line of column names"},
    };
    for (const auto& [text, message] : cases) {
        std::ofstream(folder / "h.csv") << text;
        try {
            read_history(folder / "h.csv");
            ADD_FAILURE() << "was read: " << text;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
        }
    }
}

TEST_F(Files, AFullDiskLeavesTheOldFileAndSaysSo) {
    const fs::path path = folder / "run.h5";
    write_run_file(path, example());
    const auto before = fs::file_size(path);
    const auto write_with_little_room = [&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1024, 1024};
        setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_run_file(path, example());
        } catch (const OutputError& error) {
            std::exit(std::string(error.what()).find("run.h5") != std::string::npos ? 7 : 8);
        }
        std::exit(9);
    };
    EXPECT_EXIT(write_with_little_room(), ::testing::ExitedWithCode(7), "");
    EXPECT_EQ(fs::file_size(path), before);
    EXPECT_EQ(read_run_file(path).state.step, 77);
    EXPECT_FALSE(fs::exists(folder / "run.h5.part"));
}

TEST_F(Files, FolderThatCannotBeMade) {
    std::ofstream(folder / "file") << "x";
    EXPECT_THROW(make_directories(folder / "file" / "below"), OutputError);
    EXPECT_THROW(write_file_atomically(folder / "nowhere" / "a.txt", "text"), OutputError);
}

}  // namespace
}  // namespace softgrain
