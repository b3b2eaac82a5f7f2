#pragma once
// Another program as a child process.
#include <optional>
#include <string>
#include <vector>

namespace softgrain {

/// What becomes of a child's stdout: passed on, or read as its messages are.
enum class ChildOutput { passed_on, read };

/// Runs a program, given with its arguments, to its end with its messages read from stderr. Returns why it
/// failed, if it did.
std::optional<std::string> run_program(const std::vector<std::string>& arguments,
                                       ChildOutput output = ChildOutput::passed_on);

}  // namespace softgrain
