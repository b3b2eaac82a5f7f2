#pragma once
// The last two checkpoints of a run: run.h5, and run_previous.h5 from before it.
#include <filesystem>
#include <string>

#include "common/io/run_file.hpp"

namespace softgrain {

/// The newest checkpoint that can be used.
struct FoundCheckpoint {
    RunFile file;
    std::filesystem::path path;
    std::string said;  ///< what is wrong with run.h5 if the older one is used, else empty
};

bool has_checkpoint(const std::filesystem::path& folder);

/// Throws InputError if neither file can be used; a run.h5 of another format is refused, and not passed over.
FoundCheckpoint read_checkpoint(const std::filesystem::path& folder);

/// The checkpoint that is there becomes the older one. Throws OutputError; both files then stay as they are.
void write_checkpoint(const std::filesystem::path& folder, const RunFile& content);

/// Renames a damaged run.h5 to run_damaged.h5, so that it does not take the place of the older one. Throws
/// std::filesystem::filesystem_error.
void put_damaged_checkpoint_aside(const std::filesystem::path& folder);

/// Throws std::filesystem::filesystem_error.
void remove_checkpoints(const std::filesystem::path& folder);

}  // namespace softgrain
