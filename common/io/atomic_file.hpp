#pragma once
// Files that are either complete or not there: written aside, synced, renamed, folder synced.
#include <filesystem>
#include <functional>
#include <string_view>

namespace softgrain {

/// Calls `write` with a temporary path beside `path`, then syncs and renames it. Throws OutputError.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

/// Makes a folder and its parents. Throws OutputError.
void make_folder(const std::filesystem::path& path);

}  // namespace softgrain
