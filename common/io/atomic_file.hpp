#pragma once
// Files that are either complete or absent: written aside, flushed to the disk, then renamed.
#include <filesystem>
#include <string_view>

namespace softgrain {

/// Replaces `path` with `bytes`. Throws OutputError naming the file, the system's reason (full disk, no
/// permission, missing folder) and a cure; the old file then stays as it was and nothing is left aside. With
/// `old_file_to`, in the same folder, the old file is renamed to it: one of the two is there at any moment.
void write_file_atomically(const std::filesystem::path& path, std::string_view bytes,
                           const std::filesystem::path& old_file_to = {});

/// What a user can do about an error of the system when a file is written: "make room on the disk". Empty if
/// there is no more to say than the error does.
std::string_view cure_of(int error);

/// Makes a folder and its parents. Throws OutputError.
void make_directories(const std::filesystem::path& path);

}  // namespace softgrain
