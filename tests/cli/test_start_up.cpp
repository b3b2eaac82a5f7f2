// What starting the program costs: no library that draws, and no time.
#include <gtest/gtest.h>
#include <stdio.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <string>

namespace softgrain {
namespace {

std::string output_of(const std::string& command) {
    std::string text;
    FILE* pipe = ::popen(command.c_str(), "r");
    if (pipe == nullptr) return text;
    std::array<char, 4096> buffer;
    while (const std::size_t got = ::fread(buffer.data(), 1, buffer.size(), pipe))
        text.append(buffer.data(), got);
    ::pclose(pipe);
    return text;
}

TEST(StartUp, TheSolversProgramLinksNoLibraryThatDraws) {
    const std::string libraries = output_of("ldd " SOFTGRAIN_EXECUTABLE);
    ASSERT_NE(libraries.find("libvtkIOXML"), std::string::npos) << "ldd lists nothing:\n" << libraries;
    for (const char* drawing : {"libvtkRendering", "libvtkCharts", "libGL", "libEGL", "libOpenGL", "libX11",
                                "libGLEW", "libfreetype"})
        EXPECT_EQ(libraries.find(drawing), std::string::npos) << drawing << " in\n" << libraries;
}

/// 20 ms by itself; the best of ten on a crowded machine, five times slower under sanitizers.
TEST(StartUp, HelpComesAtOnce) {
    double best = 1e9;
    for (int k = 0; k < 10; ++k) {
        const auto begin = std::chrono::steady_clock::now();
        ASSERT_EQ(std::system(SOFTGRAIN_EXECUTABLE " --help > /dev/null"), 0);
        best =
            std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    EXPECT_LT(best, 0.25) << "[s]";
}

}  // namespace
}  // namespace softgrain
