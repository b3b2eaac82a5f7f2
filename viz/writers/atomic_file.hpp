#pragma once
// Files that are either complete or absent: written aside, flushed to the disk, then renamed.
#include <filesystem>
#include <string_view>

namespace softgrain {

/// Replaces `path` with `bytes`. Throws OutputError naming the file and the system's reason (full disk, no
/// permission, missing folder); the old file then stays as it was and nothing is left aside.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and its parents. Throws OutputError.
void make_directories(const std::filesystem::path& path);

}  // namespace softgrain
