#pragma once
// run.h5: the history by column, and the checkpoint that the run can go on from.
#include <filesystem>
#include <optional>
#include <string>

#include "common/checkpoint.hpp"
#include "common/time_loop.hpp"

namespace softgrain {

struct RunFile {
    std::string version;  ///< of softgrain
    std::string method;
    std::string scenario;  ///< the resolved scenario's text
    RunState state;
    Checkpoint solver;
    double wall_time = 0.0;  ///< spent so far [s]
    double cpu_time = 0.0;   ///< [s]
};

/// Written whole, atomically; every data set carries a Fletcher-32 checksum. Throws OutputError.
void write_run_file(const std::filesystem::path& path, const RunFile& content);

/// Throws InputError if the file is damaged or not a run file.
RunFile read_run_file(const std::filesystem::path& path);

}  // namespace softgrain
