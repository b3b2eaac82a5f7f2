#include "common/io/lost_files.hpp"

#include <fmt/format.h>

#include <fstream>

namespace softgrain {

std::string_view damage_at_ends(const std::filesystem::path& path, std::string_view begin,
                                std::string_view end) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return std::filesystem::exists(path) ? "cannot be read" : "missing";
    const auto size = static_cast<std::size_t>(file.tellg());
    if (size == 0) return "empty";
    const auto has = [&](std::size_t at, std::string_view expected) {
        std::string bytes(expected.size(), '\0');
        file.seekg(static_cast<std::streamoff>(at));
        file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        return file && bytes == expected;
    };
    const bool whole = size >= begin.size() + end.size() && has(0, begin) && has(size - end.size(), end);
    return whole ? "" : "cut off or overwritten";
}

void LostFiles::add(const std::filesystem::path& path, std::string_view damage) {
    if (damage.empty()) return;
    if (count_ == 0) first_ = fmt::format("{}: {}", path.string(), damage);
    ++count_;
}

void LostFiles::say(std::vector<std::string>& lines) const {
    if (count_ == 0) return;
    lines.push_back(fmt::format("{}{}; the run goes on without, start it anew with --force to have all files",
                                first_,
                                count_ > 1 ? fmt::format(" (and {} more of its kind)", count_ - 1) : ""));
}

}  // namespace softgrain
