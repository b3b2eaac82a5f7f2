#pragma once
// The program as its users run it, in a folder of the test's own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace softgrain::testing {

namespace fs = std::filesystem;

struct Outcome {
    int exit_code;
    std::string out, err;
};

inline std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

class ProgramTest : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) /
                 ("softgrain_cli_" + std::to_string(::getpid()) + "_" +
                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// Starts softgrain with these arguments; both outputs go to files.
    pid_t start(std::vector<std::string> arguments) const {
        const pid_t child = ::fork();
        if (child != 0) return child;
        const auto redirect = [](const fs::path& to, int descriptor) {
            ::dup2(::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644), descriptor);
        };
        redirect(folder / "out.txt", STDOUT_FILENO);
        redirect(folder / "err.txt", STDERR_FILENO);
        arguments.insert(arguments.begin(), SOFTGRAIN_EXECUTABLE);
        std::vector<char*> argv;
        for (std::string& a : arguments) argv.push_back(a.data());
        argv.push_back(nullptr);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    Outcome wait_for(pid_t child) const {
        int status = 0;
        ::waitpid(child, &status, 0);
        const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
        return {code, content(folder / "out.txt"), content(folder / "err.txt")};
    }
    Outcome softgrain(const std::vector<std::string>& arguments) const { return wait_for(start(arguments)); }

    /// Until the history has so many rows (or ten seconds have passed).
    static void wait_for_rows(const fs::path& history, int rows) {
        for (int k = 0; k < 1000; ++k) {
            const std::string text = content(history);
            if (std::count(text.begin(), text.end(), '\n') > rows) return;
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
    }

    fs::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return folder / name;
    }

    fs::path folder;
};

}  // namespace softgrain::testing
