// What starting the program costs: no library that draws, and no time.
#include <gtest/gtest.h>
#include <stdio.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
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

double cpu_time_of_children() {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// 20 ms by itself; three times that on a crowded machine.
TEST(StartUp, HelpComesAtOnce) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the sanitizer's own start takes longer";
#endif
    double best = 1e9;
    for (int k = 0; k < 10; ++k) {
        const double before = cpu_time_of_children();
        ASSERT_EQ(std::system(SOFTGRAIN_EXECUTABLE " --help > /dev/null"), 0);
        best = std::min(best, cpu_time_of_children() - before);
    }
    EXPECT_LT(best, 0.1) << "[s] of CPU time";
}

}  // namespace
}  // namespace softgrain
