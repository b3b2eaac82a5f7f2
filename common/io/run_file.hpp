#pragma once
// run.h5: the history by column, and the checkpoint that the run can go on from.
#include <filesystem>
#include <string>
#include <string_view>

#include "common/checkpoint.hpp"
#include "common/errors.hpp"
#include "common/run_state.hpp"

namespace softgrain {

/// A file that is cut off, or of which some bit is another than was written.
class DamagedFileError : public InputError {
    using InputError::InputError;
};

struct RunFile {
    std::string version;  ///< of softgrain
    std::string method;
    std::string scenario;  ///< the resolved scenario's text
    RunState state;
    Checkpoint solver;
    double wall_time = 0.0;  ///< spent so far [s]
    double cpu_time = 0.0;   ///< [s]
};

/// Of the layout of run.h5, as its first line says. A file of another one is refused.
inline constexpr int run_file_format = 2;

/// Written whole, atomically. A head of 512 bytes, which HDF5 skips, holds format, size and checksum of all
/// that follows; besides, every array carries a Fletcher-32 checksum, which HDF5 tests when it is read. With
/// `old_file_to` a file that was there is renamed to it. Throws OutputError.
void write_run_file(const std::filesystem::path& path, const RunFile& content,
                    const std::filesystem::path& old_file_to = {});

/// Throws DamagedFileError if the file is not as it was written, InputError if it is not there or of another
/// format.
RunFile read_run_file(const std::filesystem::path& path);

}  // namespace softgrain
