#pragma once
// Another program as a child process.
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softgrain {

/// What becomes of a child's stdout: passed on, or read as its messages are.
enum class ChildOutput { passed_on, read };

/// What a child may use. Beyond the times it is asked to end (SIGTERM), and ended (SIGKILL) if it does not
/// within as much again; beyond the memory its allocations fail.
struct ChildLimits {
    double cpu_time;       ///< [s]
    double wall_time;      ///< [s]
    std::uint64_t memory;  ///< address space [bytes]
};

struct ChildEnd {
    int exit_code = 0;  ///< -1 if it ended by a signal or did not start
    int signal = 0;
    bool asked_to_end = false;  ///< it went beyond a limit
    double cpu_time = 0.0;      ///< [s]
    std::string messages;       ///< without white space at the end
};

/// Runs a program, given with its arguments, to its end with its messages read from stderr.
ChildEnd run_child(const std::vector<std::string>& arguments, ChildOutput output,
                   const std::optional<ChildLimits>& limits = std::nullopt);

/// Why a program failed, if it did: its messages, or how it ended.
std::optional<std::string> failure_of(const ChildEnd& end, const std::string& program);

/// run_child without limits and failure_of.
std::optional<std::string> run_program(const std::vector<std::string>& arguments,
                                       ChildOutput output = ChildOutput::passed_on);

/// The first program of this name in the folders of $PATH; empty if there is none.
std::filesystem::path find_on_path(std::string_view name);

}  // namespace softgrain
