#pragma once
// `softgrain bench` as its users run it.
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace softgrain {

namespace fs = std::filesystem;

struct Outcome {
    int exit_code;
    std::string said;  ///< both outputs
};

inline std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

class BenchFolder : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_bench_" + std::to_string(::getpid()));
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    static Outcome bench(const std::string& arguments) {
        const std::string command =
            "cd " SOFTGRAIN_SOURCE " && " SOFTGRAIN_EXECUTABLE " bench " + arguments + " 2>&1";
        FILE* pipe = ::popen(command.c_str(), "r");
        if (pipe == nullptr) return {-1, "cannot start it"};
        std::string said;
        std::array<char, 4096> buffer;
        while (const std::size_t got = ::fread(buffer.data(), 1, buffer.size(), pipe))
            said.append(buffer.data(), got);
        const int status = ::pclose(pipe);
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, said};
    }

    fs::path folder;
};

}  // namespace softgrain
