#include "viz/run_program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <sstream>

extern char** environ;

namespace softgrain {
namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Of all threads so far; 0 once the child is gone [s].
double cpu_time_of(pid_t child) {
    clockid_t clock{};
    timespec time{};
    if (::clock_getcpuclockid(child, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0.0;
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Ends a child that goes beyond its limits.
class Watch {
  public:
    Watch(pid_t child, const std::optional<ChildLimits>& limits)
        : child_(child), limits_(limits), begin_(now()) {
#ifndef __SANITIZE_ADDRESS__  // whose own map of the memory takes terabytes
        if (!limits_) return;
        const rlimit memory{limits_->memory, limits_->memory};
        ::prlimit(child, RLIMIT_AS, &memory, nullptr);
#endif
    }

    /// Until something can be read from the descriptor.
    void wait_for(int descriptor) {
        constexpr int milliseconds = 20;
        pollfd readable{descriptor, POLLIN, 0};
        while (limits_ && ::poll(&readable, 1, milliseconds) == 0) look();
    }
    bool asked_to_end() const {
        return asked_to_end_;
    }

  private:
    void look() {
        const double used =
            std::max(cpu_time_of(child_) / limits_->cpu_time, (now() - begin_) / limits_->wall_time);
        if (used < 1.0) return;
        if (!asked_to_end_) ::kill(child_, SIGTERM);
        asked_to_end_ = true;
        if (used > 2.0) ::kill(child_, SIGKILL);
    }

    pid_t child_;
    std::optional<ChildLimits> limits_;
    double begin_;
    bool asked_to_end_ = false;
};

std::string read_to_end(int descriptor, Watch& watch) {
    std::string text;
    std::array<char, 4096> buffer;
    for (;;) {
        watch.wait_for(descriptor);
        const ssize_t got = ::read(descriptor, buffer.data(), buffer.size());
        if (got > 0)
            text.append(buffer.data(), static_cast<std::size_t>(got));
        else if (got == 0 || errno != EINTR)
            break;
    }
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text;
}

ChildEnd not_started(std::string why) {
    return {.exit_code = -1, .messages = std::move(why)};
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& arguments, ChildOutput output,
                   const std::optional<ChildLimits>& limits) {
    std::array<int, 2> pipe_ends{};
    if (::pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
        return not_started(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    std::vector<char*> argv;
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDERR_FILENO);
    if (output == ChildOutput::read) posix_spawn_file_actions_adddup2(&actions, pipe_ends[1], STDOUT_FILENO);
    pid_t child = 0;
    const int spawned = ::posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(pipe_ends[1]);
    if (spawned != 0) {
        ::close(pipe_ends[0]);
        return not_started(fmt::format("cannot start {}: {}", arguments[0], std::strerror(spawned)));
    }
    Watch watch(child, limits);
    ChildEnd end;
    end.messages = read_to_end(pipe_ends[0], watch);
    ::close(pipe_ends[0]);
    int status = 0;
    rusage usage{};
    while (::wait4(child, &status, 0, &usage) < 0)
        if (errno != EINTR)
            return not_started(fmt::format("cannot wait for {}: {}", arguments[0], std::strerror(errno)));
    end.asked_to_end = watch.asked_to_end();
    end.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    end.cpu_time = seconds(usage.ru_utime) + seconds(usage.ru_stime);
    return end;
}

std::optional<std::string> failure_of(const ChildEnd& end, const std::string& program) {
    if (end.exit_code == 0) return std::nullopt;
    if (!end.messages.empty()) return end.messages;
    const std::string how = end.signal != 0 ? fmt::format("ended by signal {}", end.signal)
                                            : fmt::format("exit code {}", end.exit_code);
    return fmt::format("{}: {}", std::filesystem::path(program).filename().string(), how);
}

std::optional<std::string> run_program(const std::vector<std::string>& arguments, ChildOutput output) {
    return failure_of(run_child(arguments, output), arguments[0]);
}

std::filesystem::path find_on_path(std::string_view name) {
    const char* path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');) {
        const std::filesystem::path program = std::filesystem::path(folder) / name;
        if (::access(program.c_str(), X_OK) == 0) return program;
    }
    return {};
}

}  // namespace softgrain
