#pragma once
// The subcommands of `softgrain bench`.
#include <CLI/CLI.hpp>

#include <functional>

namespace softgrain::bench {

/// Adds them. The one that the command line names is put into `chosen`, which returns the exit code.
void add_commands(CLI::App& bench, std::function<int()>& chosen);

}  // namespace softgrain::bench
