#pragma once
// Files that a run wrote complete, looked at again before it goes on.
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace softgrain {

/// "missing", "empty", "cut off or overwritten", or nothing if the file begins and ends with these bytes.
/// What is between is not looked at.
std::string_view damage_at_ends(const std::filesystem::path& path, std::string_view begin,
                                std::string_view end);

/// Those of one kind that are lost, for one line.
class LostFiles {
  public:
    /// Nothing if `damage` is empty.
    void add(const std::filesystem::path& path, std::string_view damage);
    /// Adds the line, with the first file and a cure, if any is lost.
    void say(std::vector<std::string>& lines) const;

  private:
    std::string first_;
    std::size_t count_ = 0;
};

}  // namespace softgrain
