#pragma once
// Another program as a child process.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softgrain {

/// What becomes of a child's stdout: passed on, or read as its messages are.
enum class ChildOutput { passed_on, read };

/// Runs a program, given with its arguments, to its end with its messages read from stderr. Returns why it
/// failed, if it did. `messages`: if given, what was read, also of a program that did not fail.
std::optional<std::string> run_program(const std::vector<std::string>& arguments,
                                       ChildOutput output = ChildOutput::passed_on,
                                       std::string* messages = nullptr);

/// The first program of this name in the folders of $PATH; empty if there is none.
std::filesystem::path find_on_path(std::string_view name);

}  // namespace softgrain
