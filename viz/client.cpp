#include "viz/client.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"

extern char** environ;

namespace softgrain {
namespace fs = std::filesystem;
namespace {

constexpr const char* renderer_name = "softgrain-render";

std::string read_to_end(int descriptor) {
    std::string text;
    std::array<char, 4096> buffer;
    for (;;) {
        const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
        if (got > 0)
            text.append(buffer.data(), static_cast<std::size_t>(got));
        else if (got == 0 || errno != EINTR)
            break;
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

/// Runs a program to its end with its messages read from stderr. Returns why it failed, if it did.
std::optional<std::string> run_program(const std::vector<std::string>& arguments) {
    std::array<int, 2> pipe_ends{};
    if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
        return fmt::format("cannot make a pipe: {}", std::strerror(errno));
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    pid_t child = 0;
    const int spawned = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe_ends[1]);
    const std::string messages = spawned == 0 ? read_to_end(pipe_ends[0]) : std::string();
    ::close(pipe_ends[0]);
    if (spawned != 0) return fmt::format("cannot start {}: {}", arguments[0], std::strerror(spawned));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return fmt::format("cannot wait for {}: {}", arguments[0], std::strerror(errno));
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return std::nullopt;
    const std::string how = WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                                                : fmt::format("exit code {}", WEXITSTATUS(status));
    return messages.empty() ? fmt::format("{}: {}", renderer_name, how) : messages;
}

std::optional<std::string> run_renderer(std::vector<std::string> arguments) {
    const fs::path renderer = find_renderer();
    if (renderer.empty())
        return fmt::format("{} was not found beside the executable; set SOFTGRAIN_RENDER_EXE to its path",
                           renderer_name);
    arguments.insert(arguments.begin(), renderer.string());
    return run_program(arguments);
}

std::string join(const std::vector<double>& values) {
    return fmt::format("{}", fmt::join(values, ","));
}

}  // namespace

fs::path find_renderer() {
    std::error_code error;
    if (const char* given = std::getenv("SOFTGRAIN_RENDER_EXE"); given != nullptr && *given != '\0')
        return fs::exists(given, error) ? fs::path(given) : fs::path();
    const fs::path here = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (error) return {};
    for (const fs::path& place : {here, here / "../libexec/softgrain", here / "../libexec"})
        if (fs::exists(place / renderer_name, error)) return place / renderer_name;
    return {};
}

std::optional<std::string> render_frames(const FramesSpec& spec) {
    std::vector<std::string> arguments{
        "frames", "--field", spec.field, "--out", spec.out.string(), "--width", std::to_string(spec.width)};
    for (const FramesSpec::Run& run : spec.runs) {
        arguments.emplace_back("--run");
        arguments.push_back(run.label + "=" + run.directory.string());
    }
    if (spec.at_packing_fraction.empty())
        arguments.insert(arguments.end(), {"--at", join(spec.at)});
    else
        arguments.insert(arguments.end(), {"--at-phi", join(spec.at_packing_fraction)});
    if (spec.range) arguments.push_back(fmt::format("--range={},{}", spec.range->first, spec.range->second));
    if (spec.parts) arguments.emplace_back("--parts");
    if (spec.window)
        arguments.insert(arguments.end(), {"--window", fmt::format("{}", fmt::join(*spec.window, ","))});
    return run_renderer(std::move(arguments));
}

std::optional<std::string> render_plot(const PlotSpec& spec, const fs::path& out) {
    try {
        const fs::path folder = fs::absolute(out).parent_path();
        PlotSpec beside = spec;
        for (PlotSeries& series : beside.series)
            if (!series.csv.empty()) series.csv = fs::proximate(fs::absolute(series.csv), folder);
        fs::path spec_file = out;
        spec_file.replace_extension(".json");
        make_directories(folder);
        write_file_atomically(spec_file, plot_spec_to_json(beside));
        return run_renderer({"plot", spec_file.string(), "--out", out.string()});
    } catch (const std::exception& error) {
        return error.what();
    }
}

}  // namespace softgrain
